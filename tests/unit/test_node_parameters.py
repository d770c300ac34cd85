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


@pytest.mark.parametrize("words, on_master, sentence", [
    *(([word], {}, f"The node does not understand {word}. Type it as {meant}") for word, meant in [
        ("i2c_bus:=fake", "_i2c_bus:=fake"), ("_i2c_bus=fake", "_i2c_bus:=fake"), ("--i2c-bus=fake", "_i2c_bus:=fake"),
        ("--board", "_board:=VALUE"), ("fake", "_NAME:=VALUE")]),
    (["_i2c_bus:=", "fake"], {}, "_i2c_bus:= and fake are two words. Type them as one: _i2c_bus:=fake"),
    ([], {"i2c_buss": "fake"}, "holds i2c_buss for .* Type: rosparam delete /red/node/i2c_buss")])
def test_what_is_mistyped_here_or_on_the_master_is_refused(monkeypatch, words, on_master, sentence):
    monkeypatch.setattr(sys, "argv", ["node.py", *words])
    with pytest.raises(InvalidValue, match=sentence):
        private_parameters("/red/node", on_master, NAMES)


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
