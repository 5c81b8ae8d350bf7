"""Numbers that programs, clients and files use are those of the sources."""

import pytest

from rapidgen.machine.event_log import EventType
from rapidgen.machine.event_table import OWN_FIRST, OWN_LAST, Domain, domain_of
from rapidgen.machine.network.sockets import SocketStatus
from rapidgen.machine.smart_gripper import Command, HandState

NUMBERS = {
    # HandDriver.sys of the SmartGripper [code kth-ros-pkg/yumi].
    Command: (
        "JOG_OPEN 1, JOG_CLOSE 2, TO_MAX 3, TO_MIN 4, GRIP_INWARD 5, GRIP_OUTWARD 6, "
        "FORCE_INWARD 7, FORCE_OUTWARD 8, ERROR 9, READY 10, CALIBRATE 11, AGILE_INWARD 15, "
        "AGILE_OUTWARD 16"
    ),
    HandState: (
        "READY 0, ERROR 1, TO_MAX 2, TO_MIN 3, GRIP_INWARD 4, GRIP_OUTWARD 5, COMPLETED 6, "
        "FORCE_INWARD 7, FORCE_OUTWARD 8, KEEP_OBJECT 9, CALIBRATION 10, JOG_OPEN 11, "
        "JOG_CLOSE 12, AGILE_INWARD 16, AGILE_OUTWARD 17"
    ),
    # errtype TYPE_STATE, TYPE_WARN, TYPE_ERR, errdomain COMMON_ERR to CFG_ERR, and socketstatus
    # SOCKET_CREATED to SOCKET_CLOSED of the RAPID reference manual.
    EventType: "INFO 1, WARNING 2, ERROR 3",
    Domain: (
        "COMMON 0, OPERATIONAL 1, SYSTEM 2, HARDWARE 3, PROGRAM 4, MOTION 5, OPERATOR 6, IO 7, "
        "USER 8, SAFETY 9, INTERNAL 10, PROCESS 11, CONFIGURATION 12, PAINT 13"
    ),
    SocketStatus: "CREATED 1, CONNECTED 2, BOUND 3, LISTENING 4, CLOSED 5",
}


@pytest.mark.parametrize("kind", NUMBERS, ids=lambda kind: kind.__name__)
def test_numbers_are_those_of_the_source(kind):
    assert ", ".join(f"{member.name} {member.value}" for member in kind) == NUMBERS[kind]


@pytest.mark.parametrize(
    ("code", "domain"),
    [
        *((10_000 * domain + offset, domain) for domain in Domain for offset in (0, 9_999)
          if not OWN_FIRST <= 10_000 * domain + offset <= OWN_LAST),
        (OWN_FIRST, Domain.COMMON),
        (OWN_LAST, Domain.SAFETY),
        (195_901, Domain.MOTION),
    ],
)  # fmt: skip
def test_the_number_of_an_event_tells_its_domain(code, domain):
    assert domain_of(code) is domain


def test_a_number_beyond_the_domains_belongs_to_none():
    with pytest.raises(ValueError, match="14"):
        domain_of(140_000)
