"""The proof of a key: whole, of one connection, of one side; nothing that is almost one."""

import functools

import pytest

from jetbot_cockpit.remote.key import HUB, ROBOT, new_key, proof, proves, read_key, robot_key

KEY = robot_key("A" * 26, "jetbot_07")
CHALLENGE = {"type": "challenge", "robot": "jetbot_07", "class": "7b", "nonce": 32 * "0", "instance": "1"}
ANSWER = {"type": "answer", "nonce": 32 * "a", "address": "10.0.0.7:8080"}
PROOF = proof(KEY, HUB, CHALLENGE, ANSWER)


def is_one(said, key=KEY, side=HUB, challenge=CHALLENGE, answer=ANSWER):
    return proves(said, key, side, challenge, answer)


def test_a_proof_is_whole_a_single_other_digit_a_cut_and_a_longer_one_are_none():
    assert is_one(PROOF) and len(PROOF) == 64
    other_digit = [f"{PROOF[:at]}{'0' if PROOF[at] != '0' else '1'}{PROOF[at + 1:]}" for at in range(len(PROOF))]
    cut = [PROOF[:at] for at in range(len(PROOF))]
    longer = [PROOF + "0", PROOF + PROOF, PROOF + "\0", f" {PROOF}", f"{PROOF} "]
    assert [said for said in [*other_digit, *cut, *longer, PROOF.upper()] if is_one(said)] == []


@pytest.mark.parametrize("said", [None, 7, True, [PROOF], {"proof": PROOF}, PROOF.encode(), "\ud800", "ä" * 64])
def test_what_is_no_text_of_digits_is_no_proof(said):
    assert not is_one(said)


@pytest.mark.parametrize("change", [
    {"key": robot_key("A" * 26, "jetbot_08")}, {"key": robot_key("B" * 26, "jetbot_07")}, {"side": ROBOT},
    *({"challenge": {**CHALLENGE, field: "x"}} for field in CHALLENGE), {"challenge": {**CHALLENGE, "more": 1}},
    *({"answer": {**ANSWER, field: "x"}} for field in ANSWER), {"answer": {**ANSWER, "more": 1}},
    {"challenge": ANSWER, "answer": CHALLENGE}], ids=str)
def test_a_proof_holds_for_its_key_its_side_and_all_that_was_said(change):
    assert not is_one(PROOF, **change)


def test_an_answer_that_is_too_deep_for_json_proves_nothing():
    deep = functools.reduce(lambda inner, _: [inner], range(100_000), [])
    assert not is_one(PROOF, answer={**ANSWER, "more": deep})


def test_an_answer_carries_its_proof_which_covers_all_else():
    assert is_one(PROOF, answer={**ANSWER, "proof": PROOF})


@pytest.mark.parametrize("typed, is_key", [
    (KEY, True), (KEY.lower(), True), ("-".join(KEY), True), (f" {KEY[:13]}\t{KEY[13:]}\n", True),
    (KEY[:-1], False), (KEY + "A", False), (KEY[:-1] + "1", False), (KEY[:-1] + "ä", False), ("", False)])
def test_a_key_is_typed_in_any_groups_and_is_as_long_as_one(typed, is_key):
    assert read_key(typed) == (KEY if is_key else None)


def test_keys_of_classes_and_of_robots_differ_from_their_first_letters_on():
    keys = [new_key() for _ in range(20)] + [robot_key("A" * 26, f"jetbot_{number:02d}") for number in range(20)]
    assert all(read_key(key) == key for key in keys) and len({key[:8] for key in keys}) == len(keys)
