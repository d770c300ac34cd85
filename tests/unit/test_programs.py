"""The page runs blocks as Python runs the node that it makes of them: failures, and what random programs seldom do."""

import pytest
from browser.programs import block, calculate, chain, drive, let, num, plug, program, set_motion, show, var, wait
from differential import difference
from javascript import needs_node
from program_node import run_python, translate

pytestmark = needs_node
INFINITY = plug("math_constant", {"CONSTANT": "INFINITY"})
TEXT = plug("text", {"TEXT": "a"})


def call(name):
    """Return an input with a call of a function without parameters."""
    return {"block": {"type": "procedures_callreturn", "extraState": {"name": name}}}


def define(name, *blocks, value):
    """Return a function of these statements, which returns this."""
    return {"type": "procedures_defreturn", "fields": {"NAME": name}, "inputs": {
        **({"STACK": chain(*blocks)} if blocks else {}), "RETURN": value}}


def count(start, end, step, *blocks):
    """Return a loop that counts by x."""
    return block("controls_for", {"VAR": {"id": "x"}}, FROM=start, TO=end, BY=step, DO=chain(*blocks))


def check(number, name):
    return plug("math_number_property", {"PROPERTY": name}, NUMBER_TO_CHECK=num(number))


def nested(loops):
    """Return so many loops in each other."""
    return block("controls_repeat_ext", TIMES=num(1), DO=chain(nested(loops - 1) if loops > 1 else show(num(1))))


PROGRAMS = {
    "nothing": program(),
    "twenty loops in each other": program(nested(20)),
    "drives": program(
        drive(0.5, 1), block("robot_turn", {"SIDE": "RIGHT"}, Z=num(0.2), SECONDS=num(0.5)), wait(1),
        set_motion(0.3, 0.1), wait(0.5), block("robot_stop"), wait(0.3),
        block("robot_wheels", LEFT=num(0.2), RIGHT=num(0.4)), wait(1)),
    "no time": program(set_motion(0.1, 0), wait(0), wait(-1), drive(0.5, 0), drive(0.5, -1), wait(0.2),
                       set_motion(0.2, 0), wait(1e-9), wait(0.1)),
    "a bound that changes its start": program(
        let("x", num(1)), count(var("x"), call("f"), num(1), show(var("x"))),
        functions=(define("f", let("x", num(5)), value=num(7)),), variables="x"),
    "a z that drives": program(
        set_motion(0.1, 0.2), wait(0.1), block("robot_set", X=num(0.5), Z=call("f")), wait(0.3),
        functions=(define("f", wait(0.2), set_motion(0.3, 0.3), wait(0.1), value=num(0.4)),)),
    "primes, halves, and numbers of many digits": program(
        *(show(plug("math_round", {"OP": "ROUND"}, NUM=num(number))) for number in (0.5, 2.5, 3.5, -1.5)),
        *(show(check(number, "PRIME")) for number in (-7, 0, 1, 2, 2.5, 9, 91, 97)),
        *map(show, map(num, (1234567, 123456.789, 0.1234567, 1e-7)))),
}

ROUNDED = plug("math_round", {"OP": "ROUND"}, NUM=INFINITY)
FAILING = {  # and what the page says
    "division": (program(show(calculate("DIVIDE", num(1), num(0)))), "This block divides by 0."),
    "rest": (program(show(plug("math_modulo", DIVIDEND=num(1)))), "This block divides by 0."),
    "divisible": (program(show(check(6, "DIVISIBLE_BY"))), "This block divides by 0."),
    "root": (program(show(plug("math_single", {"OP": "ROOT"}, NUM=num(-4)))), "This calculation has no result."),
    "power": (program(show(calculate("POWER", num(-8), num(0.5)))), "This calculation has no result."),
    "rounded": (program(show(ROUNDED)), "∞ cannot be rounded."),
    "compared": (program(show(plug("logic_compare", {"OP": "LT"}, A=num(2), B=TEXT))),
                 "2 and the text “a” cannot be compared."),
    "count by 0": (program(count(num(0.5), num(2), num(0))), "This loop counts by 0, and never arrives."),
    "recursion": (program(show(call("f")), functions=(define("f", show(num(1)), value=call("f")),)),
                  "Functions call each other more than 998 deep. Does one call itself for ever?"),
    "22 loops": (program(nested(22)), "Python allows 20 loops in each other, not more."),
}


@pytest.fixture(scope="module")
def done():
    """What the page does with all programs, and their Python."""
    return translate("given", programs={**PROGRAMS, **{name: failing for name, (failing, _) in FAILING.items()}})


@pytest.mark.parametrize("name", PROGRAMS)
def test_blocks_print_and_command_what_their_python_does(name, done):
    assert done[name]["error"] == ""
    assert difference(done[name], run_python(done[name]["python"])) == ""


@pytest.mark.parametrize("name", FAILING)
def test_a_program_fails_at_the_same_block_in_the_page_and_in_python(name, done):
    assert done[name]["error"] == FAILING[name][1]
    assert difference(done[name], run_python(done[name]["python"])) == ""
