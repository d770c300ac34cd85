"""The page for programs runs blocks as Python runs the node that it makes of them."""

import ast
import json

import pytest

from .conftest import ROBOT
from .programs import (
    block,
    calculate,
    chain,
    changes,
    drive,
    interpret,
    let,
    num,
    plug,
    program,
    python_of,
    run_python,
    set_motion,
    show,
    var,
    wait,
)

X_EQ = {"VAR": {"id": "x"}}


@pytest.fixture(scope="module")
def editor(world, browsers):
    """The page for programs in a browser."""
    page = browsers(1)
    page.screen(1024, 768)
    page.driver.get(f"{world.address}program")
    page.wait_for_link()
    page.choose(ROBOT)
    yield page
    page.leave()


def compare(operator, left, right):
    return plug("logic_compare", {"OP": operator}, A=left, B=right)


def single(kind, operator, value):
    return plug(kind, {"OP": operator}, NUM=num(value))


TRUE = plug("logic_boolean", {"BOOL": "TRUE"})


def either(operator, left=None, right=None):
    """Return a logic operation; an input without a value is empty."""
    return plug("logic_operation", {"OP": operator}, **{k: v for k, v in (("A", left), ("B", right)) if v})


def check(number, name):
    return plug("math_number_property", {"PROPERTY": name}, NUMBER_TO_CHECK=num(number))


COUNT = {"type": "procedures_defreturn", "fields": {"NAME": "count"},
         "extraState": {"params": [{"name": "n", "id": "n"}]},
         "inputs": {"STACK": chain(block("procedures_ifreturn", CONDITION=compare("LTE", var("n"), num(0)),
                                         VALUE=num(0)),
                                   let("x", calculate("ADD", var("x"), num(1)))),
                    "RETURN": calculate("ADD", var("n"), {"block": {
                        "type": "procedures_callreturn", "extraState": {"name": "count", "params": ["n"]},
                        "inputs": {"ARG0": calculate("MINUS", var("n"), num(1))}}})}}


def called(value):
    """Return a call of ``count`` with this input."""
    return {"block": {"type": "procedures_callreturn", "extraState": {"name": "count", "params": ["n"]},
                      "inputs": {"ARG0": value}}}


PROGRAMS = {
    "numbers": program(*[show(value) for value in (
        calculate("DIVIDE", num(7), num(2)), calculate("POWER", num(2), num(-1)), calculate("MINUS", num(2), num(-3)),
        plug("math_modulo", DIVIDEND=num(-7), DIVISOR=num(3)), single("math_round", "ROUND", 2.5),
        single("math_round", "ROUND", -1.5), single("math_round", "ROUNDUP", 1.2),
        single("math_round", "ROUNDDOWN", -1.2),
        single("math_single", "ROOT", 9), single("math_single", "NEG", 9), single("math_single", "POW10", 2),
        single("math_trig", "SIN", 30), single("math_trig", "ATAN", 1), num(1234567), num(123456.789),
        plug("math_constant", {"CONSTANT": "PI"}),
        plug("math_constrain", VALUE=num(7), LOW=num(-1), HIGH=num(1)))]),
    "logic": program(*[show(value) for value in (
        check(-3, "ODD"), check(2.5, "WHOLE"), check(4, "EVEN"),
        check(91, "PRIME"), check(97, "PRIME"), check(-1, "NEGATIVE"), compare("EQ", num(2), num(2)),
        compare("NEQ", num(2), plug("text", {"TEXT": "2"})), compare("LT", num(2), num(3)),
        plug("logic_operation", {"OP": "OR"}, A=compare("GT", num(1), num(2)),
             B=TRUE),
        plug("logic_negate", BOOL=TRUE),
        plug("logic_ternary", IF=compare("GTE", num(1), num(2)), THEN=num(1), ELSE=num(2)))]),
    "truths as numbers": program(
        let("x", num(3)), let("t", TRUE), *[show(value) for value in (
            either("OR", var("x"), TRUE), either("AND", var("x"), var("z")), either("AND", var("z"), TRUE),
            either("AND", var("x")), either("OR", None, var("z")), either("OR"), plug("logic_negate"),
            plug("logic_ternary"), calculate("ADD", var("t"), num(1)), compare("EQ", var("t"), num(1)),
            compare("LT", var("t"), num(2)), plug("math_modulo", DIVIDEND=num(1), DIVISOR=num(0.1)))],
        block("math_change", {"VAR": {"id": "t"}}, DELTA=num(1)), show(var("t")), variables="xtz"),
    "loops": program(
        block("controls_for", X_EQ, FROM=num(1), TO=num(10), BY=num(3), DO=chain(show(var("x")))),
        block("controls_for", X_EQ, FROM=num(3), TO=num(1), BY=num(1), DO=chain(
            block("controls_if", IF0=compare("EQ", var("x"), num(2)), DO0=chain(
                block("controls_flow_statements", {"FLOW": "CONTINUE"}))), show(var("x")))),
        block("controls_repeat_ext", TIMES=num(3), DO=chain(
            block("math_change", X_EQ, DELTA=num(2)), show(var("x")),
            block("controls_if", IF0=compare("GT", var("x"), num(4)), DO0=chain(
                block("controls_flow_statements", {"FLOW": "BREAK"}))))),
        block("controls_whileUntil", {"MODE": "UNTIL"}, BOOL=compare("LT", var("x"), num(0)), DO=chain(
            block("math_change", X_EQ, DELTA=num(-3)))), show(var("x")), variables="x"),
    "texts": program(show(plug("text", {"TEXT": "a'b\\n<b>\"\"\""})),
                     let("x", plug("text", {"TEXT": "#@1"})), show(var("x")),
                     show(plug("text_join", ADD0=plug("text", {"TEXT": "x"}), ADD1=num(2))), variables="x"),
    "functions": program(let("x", num(0)), show(called(num(4))), show(var("x")), functions=(COUNT,), variables="xn"),
    "drives": program(
        drive(0.5, 1), block("robot_turn", {"SIDE": "RIGHT"}, Z=num(0.2), SECONDS=num(0.5)), wait(1),
        set_motion(0.3, 0.1), wait(0.5), block("robot_stop"),
        wait(0.3), block("robot_wheels", LEFT=num(0.2), RIGHT=num(0.4)),
        wait(1)),
    "10 Hz": program(let("x", num(0)), block("robot_loop", DO=chain(
        block("robot_set", X=calculate("DIVIDE", var("x"), num(10)), Z=num(0.1)),
        block("math_change", X_EQ, DELTA=num(1)),
        block("controls_if", IF0=compare("EQ", var("x"), num(5)), DO0=chain(wait(0.5))),
        block("controls_if", IF0=compare("GT", var("x"), num(8)), DO0=chain(
            block("controls_flow_statements", {"FLOW": "BREAK"}))))), variables="x"),
    "continue at 10 Hz": program(block("robot_loop", DO=chain(
        block("math_change", X_EQ, DELTA=num(1)),
        block("robot_set", X=calculate("DIVIDE", var("x"), num(10)), Z=num(0)),
        block("controls_if", IF0=compare("GT", var("x"), num(6)), DO0=chain(
            block("controls_flow_statements", {"FLOW": "BREAK"}))),
        block("controls_flow_statements", {"FLOW": "CONTINUE"}))), variables="x"),
    "nothing": program(),
}


@pytest.mark.parametrize("name", PROGRAMS)
def test_blocks_print_and_command_what_their_python_does(name, editor, monkeypatch):
    blocks = PROGRAMS[name]
    prints, commands = run_python(python_of(editor, blocks), monkeypatch)
    done = interpret(editor, blocks)
    assert done["error"] == ""
    assert done["prints"] == prints
    ended = [commands[-1][0], 0.0, 0.0]  # the node's last command, and the page's
    assert changes([*done["commands"], ended]) == changes(commands)
    assert prints or len(commands) > 3 or name == "nothing"


EXAMPLES = "import('/program/examples.js').then(({EXAMPLES}) => arguments[0](EXAMPLES))"
SENSES = {"here": {"X": 0.97}, "line": [0.3, 0, 1]}


def test_the_examples_drive_and_their_python_is_a_program(editor):
    for name, example in editor.driver.execute_async_script(EXAMPLES).items():
        done = interpret(editor, json.loads(example), SENSES)
        assert not done["error"] and done["commands"], name
        compile(python_of(editor, json.loads(example)), name, "exec")


FAULTS = {
    "This calculation has no result.": program(show(calculate("DIVIDE", num(1), num(0)))),
    "This calculation has no result": program(show(plug("math_constant", {"CONSTANT": "INFINITY"}))),
    "Functions call functions too deep": program(block("procedures_callnoreturn"), functions=(
        {"type": "procedures_defnoreturn", "fields": {"NAME": "again"}, "inputs": {"STACK": chain(
            {"type": "procedures_callnoreturn", "extraState": {"name": "again"}})}},)),
    "Here a number is needed, not a.": program(drive(1, 1), let("x", plug("text", {"TEXT": "a"})),
                                               block("robot_set", X=var("x")), variables="x"),
    "2 and a cannot be compared.": program(show(compare("LT", num(2), plug("text", {"TEXT": "a"})))),
    "This robot does not report where it is.": program(show(plug("robot_here", {"WHAT": "X"}))),
    "A text has at most 10000 characters.": program(let("x", plug("text", {"TEXT": "abc"})), block(
        "controls_repeat_ext", TIMES=num(50), DO=chain(let("x", plug("text_join", ADD0=var("x"), ADD1=var("x"))))),
        variables="x"),
    "This loop counts by 0": program(block("controls_for", X_EQ, FROM=num(1), TO=num(2), BY=num(0)), variables="x"),
}
FAULTS["Functions call functions too deep"]["blocks"]["blocks"][0]["next"]["block"]["extraState"] = {"name": "again"}


@pytest.mark.parametrize("sentence", FAULTS)
def test_what_cannot_be_run_is_named_in_a_sentence(sentence, editor):
    assert interpret(editor, FAULTS[sentence])["error"].startswith(sentence)


@pytest.mark.parametrize("root", [single("math_single", "ROOT", -4), calculate("POWER", num(-8), num(0.5))])
def test_a_root_of_a_negative_number_ends_the_program_and_its_python(root, editor, monkeypatch):
    blocks = program(show(root))
    assert interpret(editor, blocks)["error"] == "This calculation has no result."
    with pytest.raises(ValueError, match="math domain error"):
        run_python(python_of(editor, blocks), monkeypatch)


def test_no_text_ends_a_line_of_the_python(editor):
    source = python_of(editor, program(show(plug("text", {"TEXT": "a\rimport os\x0cb\nc"}))))
    imported = [each.names[0].name for each in ast.walk(ast.parse(source)) if isinstance(each, ast.Import)]
    assert imported == ["rospy"]


def test_a_loop_without_a_wait_lets_the_page_have_its_turn(editor):
    endless = program(block("controls_whileUntil", {"MODE": "WHILE"}, BOOL=plug("logic_boolean", {"BOOL": "TRUE"})))
    assert interpret(editor, endless)["steps"] > 20000


def test_a_long_calculation_lets_the_page_have_its_turn(editor):
    fibonacci = {**COUNT, "inputs": {"RETURN": plug(
        "logic_ternary", IF=compare("LT", var("n"), num(2)), THEN=var("n"),
        ELSE=calculate("ADD", *(called(calculate("MINUS", var("n"), num(less))) for less in (1, 2))))}}
    endless = program(show(called(num(40))), functions=(fibonacci,), variables="n")
    assert interpret(editor, endless)["steps"] > 20000


PULSES = """const [done] = arguments;
import("/program/motion.js").then(({ Motion }) => {
    const sent = [];
    const motion = new Motion((...command) => sent.push(command));
    for (let count = 0; count < 100; count += 1) {
        motion.set(1, 0);
        motion.set(0, 0);
    }
    done(sent);
})"""


def test_short_pulses_are_not_more_than_the_cockpit_takes(editor):
    sent = editor.driver.execute_async_script(PULSES)
    assert 2 <= len(sent) < 20 and sent[-1] == [0, 0]
