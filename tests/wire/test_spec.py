"""Message declarations against simple_message's figures and the page."""

from pathlib import Path

from rapidgen.wire.simple_message import messages, spec
from rapidgen.wire.simple_message.mapping import mapping_hash
from rapidgen.wire.simple_message.protocol_page import protocol_markdown
from rapidgen.wire.simple_message.rapid import rapid_constants

PAGE = Path(__file__).parents[2] / "docs" / "develop" / "protocol.md"


def test_lengths_of_the_standard_messages():
    # simple_message's headers: length = data + 12.
    assert {m.number: m.length for m in messages.MESSAGES if m.since == 0} == {
        1: 12,
        10: 56,
        11: 64,
        13: 40,
        14: 148,
        15: 144,
    }


def test_messages_are_declared_by_number():
    numbers = [message.number for message in messages.MESSAGES]
    assert numbers == sorted(set(numbers))


def test_replies_of_one_message_differ_in_code_or_length():
    for message in messages.MESSAGES:
        keys = [(r.code, sum(f.size for f in r.fields)) for r in message.replies]
        assert len(keys) == len(set(keys)), message.name


def test_numbers_of_our_own_lie_in_abbs_range():
    for message in messages.MESSAGES:
        assert (1300 <= message.number <= 1399) == (message.since > 0)
        assert message.length <= spec.MAX_LENGTH


def test_every_reason_has_a_text():
    texts = [reason.text for reason in spec.Reason]
    assert all(texts)
    assert len(set(texts)) == len(texts)
    # A string of RAPID holds 80 characters, and "ROS refused: " comes before it.
    assert max(map(len, texts)) <= 67


def test_error_codes():
    assert spec.error_code(spec.Reason.JOINT_LIMIT, 10) == 1004
    assert spec.split_error_code(1004) == (spec.Reason.JOINT_LIMIT, 10)
    assert spec.split_error_code(0) == (spec.Reason.NONE, 0)
    for foreign in (-1, 77, 1104, 40000):
        assert spec.split_error_code(foreign) == (None, 0)


def test_rapid_constants_are_legal_and_unique():
    constants = rapid_constants()
    names = [constant.name for constant in constants]
    assert len({name.lower() for name in names}) == len(names)
    # 32 characters: 3HAC16585-1, identifiers.
    assert all(len(name) <= 32 and name.isidentifier() and name.isascii() for name in names)
    by_name = {constant.name: constant.value for constant in constants}
    assert by_name["ROS_MSG_JOINT_TRAJ_PT"] == 11
    assert by_name["ROS_LEN_JOINT_TRAJ_PT"] == 64
    assert by_name["ROS_SEQ_STOP"] == -4
    assert by_name["ROS_REASON_CAPACITY"] == 1
    assert all(type(constant.value) is int for constant in constants)


def test_page_is_the_specification():
    assert PAGE.read_text() == protocol_markdown(), (
        "python -m rapidgen.wire.simple_message.protocol_page > docs/develop/protocol.md"
    )


def test_mapping_hash_sees_every_part():
    joints = [("joint_1", "rax_1", "revolute", 1, 0.0), ("track", "eax_a", "prismatic", 1, 0.5)]
    first = mapping_hash(joints, 0.0)
    assert len(first) == 12
    assert int(first, 16) >= 0
    others = [
        mapping_hash(joints[::-1], 0.0),
        mapping_hash(joints, 1.0),
        mapping_hash([("joint_2", *joints[0][1:]), joints[1]], 0.0),
        mapping_hash([("joint_1", "rax_2", "revolute", 1, 0.0), joints[1]], 0.0),
        mapping_hash([("joint_1", "rax_1", "prismatic", 1, 0.0), joints[1]], 0.0),
        mapping_hash([("joint_1", "rax_1", "revolute", -1, 0.0), joints[1]], 0.0),
        mapping_hash([("joint_1", "rax_1", "revolute", 1, 0.1), joints[1]], 0.0),
    ]
    assert first not in others
    assert len(set(others)) == len(others)
