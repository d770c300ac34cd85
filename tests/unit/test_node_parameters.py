"""What is typed after a node's name: it wins over what the master holds, and is never put there."""

import sys

import pytest

from jetbot import InvalidValue
from jetbot.errors import BusError
from jetbot_ros import node_parameters
from jetbot_ros.node_parameters import from_master, parse_word, private_parameters, public_words

NAMES = ["board", "i2c_bus"]


@pytest.mark.parametrize("word, parameters", [
    ("_i2c_bus:=fake", {"i2c_bus": "fake"}), ("_i2c_bus:=fake:/tmp/x", {"i2c_bus": "fake:/tmp/x"}),
    ("_i2c_bus:=7", {"i2c_bus": 7}), ("_swap:=yes", {"swap": True}), ("_a:=b:=c", {"a": "b:=c"}), ("_board:=", {}),
    ("_config:=/a: b\x07.yaml", {"config": "/a: b\x07.yaml"}), ("_board:=[", {"board": "["}),
    ("_board:=" + "[" * 1000, {"board": "[" * 1000}),
    ("__ns:=red", {}), ("__log:=/tmp/log", {}), ("cmd_vel:=/red/cmd_vel", {}), ("/a:=/b", {})],
    ids=lambda value: ascii(value)[:30])
def test_a_word_of_the_command_line(word, parameters):
    assert parse_word(word, NAMES) == parameters


def test_an_unknown_name_on_the_master_is_refused_with_what_removes_it(monkeypatch):
    monkeypatch.setattr(sys, "argv", ["node.py"])
    with pytest.raises(InvalidValue, match="holds i2c_buss for .* Type: rosparam delete /red/node/i2c_buss"):
        private_parameters("/red/node", {"i2c_buss": "fake"}, NAMES)


@pytest.mark.parametrize("word, sentence", [
    ("i2c_bus:=fake", "The node does not understand i2c_bus:=fake. Type it as _i2c_bus:=fake"),
    ("_i2c_bus=fake", "The node does not understand _i2c_bus=fake. Type it as _i2c_bus:=fake"),
    ("--i2c-bus=fake", "The node does not understand --i2c-bus=fake. Type it as _i2c_bus:=fake"),
    ("--board", "The node does not understand --board. Type it as _board:=VALUE"),
    ("fake", "The node does not understand fake. Type it as _NAME:=VALUE")])
def test_a_mistyped_word_is_refused(word, sentence):
    with pytest.raises(InvalidValue) as error:
        parse_word(word, NAMES)
    assert str(error.value) == sentence


def test_a_space_after_the_equals_sign_is_named(monkeypatch):
    monkeypatch.setattr(sys, "argv", ["node.py", "_i2c_bus:=", "fake"])
    with pytest.raises(InvalidValue, match="_i2c_bus:= and fake are two words. Type them as one: _i2c_bus:=fake"):
        private_parameters("/node", {}, NAMES)


def test_what_is_typed_wins_over_the_master_and_does_not_go_there(monkeypatch):
    monkeypatch.setattr(sys, "argv", ["node.py", "_board:=sparkfun", "__ns:=red"])
    on_master = {"board": "adafruit", "i2c_bus": 1}
    assert private_parameters("/node", on_master, NAMES) == {"board": "sparkfun", "i2c_bus": 1}
    assert public_words() == ["node.py", "__ns:=red"]


@pytest.mark.parametrize("on_master, launched, parameters", [
    ({"board": "sparkfun", "i2c_bus": ""}, True, {"board": "sparkfun", "i2c_bus": ""}),
    ({"board": "sparkfun", "i2c_bus": ""}, False, {}), ({"board": "sparkfun"}, False, {"board": "sparkfun"}),
    (5, False, {}), ([""], True, {})])
def test_what_an_earlier_roslaunch_left_on_the_master_does_not_count(on_master, launched, parameters):
    assert from_master(on_master, launched) == parameters


@pytest.mark.parametrize("launched, advice", [(False, "add: _i2c_bus:=fake"), (True, "add: i2c_bus:=fake")])
def test_advice_is_what_its_reader_can_type(monkeypatch, launched, advice):
    monkeypatch.setattr(node_parameters, "LAUNCHED", launched)
    error = BusError("no bus", option="i2c_bus")
    assert error.text(node_parameters.fake_advice) == f"No bus. Without a robot, {advice}"
