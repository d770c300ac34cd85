"""The page runs blocks as Python runs the node that it makes of them."""

import pytest
from browser.programs import block, calculate, chain, drive, let, num, plug, program, set_motion, show, var, wait
from differential import difference
from javascript import needs_node
from program_node import run_python, translate

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


def call(name):
    """Return an input with a call of a function without parameters."""
    return {"block": {"type": "procedures_callreturn", "extraState": {"name": name}}}


def define(name, *blocks, **inputs):
    """Return a function of these statements. inputs: RETURN"""
    stack = {"STACK": chain(*blocks)} if blocks else {}
    return {"type": "procedures_defreturn", "fields": {"NAME": name}, "inputs": {**stack, **inputs}}


def count(start, end, step, *blocks):
    """Return a loop that counts by x."""
    return block("controls_for", X_EQ, FROM=start, TO=end, BY=step, DO=chain(*blocks))


def dice(start, end):
    return plug("math_random_int", FROM=start, TO=end)


def nested(loops):
    """Return so many loops in each other."""
    return block("controls_repeat_ext", TIMES=num(1), DO=chain(nested(loops - 1) if loops > 1 else show(num(1))))


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
    "curves": program(let("x", calculate("DIVIDE", num(1), num(4))),
                      block("robot_plot", NAME=plug("text", {"TEXT": "x"}), VALUE=var("x")),
                      block("robot_plot", NAME=num(2), VALUE=plug("text", {"TEXT": "a b"})),
                      block("robot_plot", VALUE=TRUE), block("robot_plot"), variables="x"),
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
    "an else-if behind an empty branch": program({
        **block("controls_if", IF0=compare("EQ", num(1), num(2)), IF1=compare("EQ", num(1), num(2)), IF2=TRUE,
                DO2=chain(show(num(2)))), "extraState": {"elseIfCount": 2}}, *map(show, map(num, range(3)))),
    "None": program(let("x", call("f")), show(var("x")), show(compare("EQ", var("x"), num(0))),
                    *map(show, map(num, range(2))), functions=(define("f"),), variables="x"),
    "a bound that changes its start": program(
        let("x", num(1)), count(var("x"), call("f"), num(1), show(var("x"))),
        functions=(define("f", let("x", num(5)), RETURN=num(7)),), variables="x"),
    "a z that drives": program(
        set_motion(0.1, 0.2), wait(0.1), block("robot_set", X=num(0.5), Z=call("f")), wait(0.3),
        functions=(define("f", wait(0.2), set_motion(0.3, 0.3), wait(0.1), RETURN=num(0.4)),)),
    "rounds": program(*[block("controls_repeat_ext", TIMES=num(times), DO=chain(show(num(times))))
                        for times in (2, 2.5, 1e-7, -1, 0)]),
    "no time": program(set_motion(0.1, 0), wait(0), wait(-1), drive(0.5, 0), drive(0.5, -1), wait(0.2),
                       set_motion(0.2, 0), wait(1e-9), wait(0.1)),
    "random numbers": program(*[show(dice(num(start), num(end))) for start, end in (
        (1, 6), (5, 1), (1.2, 1.8), (-0.5, 2.5), (3, 3))], show(plug("math_random_float"))),
    "constrained": program(show(plug("math_constrain", VALUE=num(7))), show(plug("math_constrain", VALUE=num(-7))),
                           let("x", TRUE), show(plug("math_constrain", VALUE=var("x"), HIGH=num(5))),
                           show(plug("math_constrain")), variables="x"),
    "infinity": program(let("x", plug("math_constant", {"CONSTANT": "INFINITY"})), show(var("x")),
                        show(calculate("MINUS", var("x"), var("x"))), show(compare("GT", var("x"), num(1e9))),
                        let("x", calculate("MINUS", var("x"), var("x"))), show(plug("logic_negate", BOOL=var("x"))),
                        variables="x"),
    "twenty loops in each other": program(nested(20), *map(show, map(num, range(3)))),
    "sines": program(*[show(plug("math_round", {"OP": "ROUND"}, NUM=single("math_trig", "SIN", angle)))
                        for angle in range(0, 720, 30)]),
    "nothing": program(),
}

FAILING = {  # and what the page says
    "division": (program(show(calculate("DIVIDE", num(1), num(0)))), "This block divides by 0."),
    "rest": (program(show(plug("math_modulo", DIVIDEND=num(1)))), "This block divides by 0."),
    "divisible": (program(show(check(6, "DIVISIBLE_BY"))), "This block divides by 0."),
    "root": (program(show(single("math_single", "ROOT", -4))), "This calculation has no result."),
    "power": (program(show(calculate("POWER", num(-8), num(0.5)))), "This calculation has no result."),
    "rounded": (program(show(plug("math_round", {"OP": "ROUND"}, NUM=plug("math_constant", {"CONSTANT": "INFINITY"})))),
                "∞ cannot be rounded."),
    "compared": (program(let("x", plug("text", {"TEXT": "a"})), show(compare("LT", num(2), var("x"))), variables="x"),
                 "2 and the text “a” cannot be compared."),
    "count by 0": (program(count(num(1), num(2), num(0))), "This loop counts by 0, and never arrives."),
    "count by a fraction of 0": (program(count(num(0.5), num(2), num(0))), "This loop counts by 0, and never arrives."),
    "recursion": (program(show(call("f")), functions=(define("f", show(num(1)), RETURN=call("f")),)),
                  "Functions call each other more than 998 deep. Does one call itself for ever?"),
    "22 loops": (program(nested(22)), "Python allows 20 loops in each other, not more."),
}

NAMES = ["__builtins__", "async", "await", "print", "motion", "counting", "سلام"]  # of variables


@pytest.fixture(scope="module")
def done():
    """What the page does with all programs, and their Python."""
    failing = {name: failing for name, (failing, _) in FAILING.items()}
    named = {name: {**program(let("x", num(7)), show(var("x"))), "variables": [{"name": name, "id": "x"}]}
             for name in NAMES}
    return translate("given", programs={**PROGRAMS, **failing, **named})


@pytest.mark.parametrize("name", PROGRAMS)
def test_blocks_print_and_command_what_their_python_does(name, done):
    done = done[name]
    python = run_python(done["python"])
    assert done["error"] == ""
    assert difference(done, python) == ""
    assert python.error is None
    assert len(python.trace) > 2 or name == "nothing"


@pytest.mark.parametrize("name", FAILING)
def test_a_program_fails_at_the_same_block_in_the_page_and_in_python(name, done):
    assert done[name]["error"] == FAILING[name][1]
    assert difference(done[name], run_python(done[name]["python"])) == ""


@pytest.mark.parametrize("name", NAMES)
def test_a_variable_has_any_name(name, done):
    assert run_python(done[name]["python"]).trace[0] == "7"
