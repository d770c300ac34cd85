"""The page runs blocks as Python runs the node that it makes of them."""

import pytest
from browser.programs import block, calculate, chain, drive, let, num, plug, program, set_motion, show, var, wait
from javascript import needs_node
from program_node import changes, run_python, translate

pytestmark = needs_node
X_EQ = {"VAR": {"id": "x"}}


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


@pytest.fixture(scope="module")
def done():
    """What the page does with all programs, and their Python."""
    return translate(PROGRAMS)


@pytest.mark.parametrize("name", PROGRAMS)
def test_blocks_print_and_command_what_their_python_does(name, done, monkeypatch):
    done = done[name]
    prints, commands = run_python(done["python"], monkeypatch)
    assert done["error"] == ""
    assert done["prints"] == prints
    ended = [commands[-1][0], 0.0, 0.0]  # the node's last command, and the page's
    assert changes([*done["commands"], ended]) == changes(commands)
    assert prints or len(commands) > 3 or name == "nothing"


def test_the_examples_are_programs_in_python_too():
    for name, example in translate(None).items():
        compile(example["python"], name, "exec")


@pytest.mark.parametrize("root", [single("math_single", "ROOT", -4), calculate("POWER", num(-8), num(0.5))])
def test_a_root_of_a_negative_number_ends_the_program_and_its_python(root, monkeypatch):
    done = translate({"root": program(show(root))})["root"]
    assert done["error"] == "This calculation has no result."
    with pytest.raises(ValueError, match="math domain error"):
        run_python(done["python"], monkeypatch)
