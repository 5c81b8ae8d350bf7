"""Sequences of events as saved logs of controllers have them, by release.

5.15: two IRB 120 (ManicZanic/ABB-IRB-120-Hanoi); 5.61 (MRixen/Scheideler_Miniflex_Test_Version);
6.03: two IRB 4600, MultiMove (kangoananya/gkr_timber). Each is `Elog_all*.txt` in HOME of a backup.
"""

from dataclasses import replace

import pytest

from rapidgen.controller import VirtualController
from tests.runtime.booting import system

ERRORS = {
    "procedure": '%"nowhere"%;',
    "data": 'GetDataVal "nowhere", n;',
}
BROKEN = """
  PROC main()
    VAR num n;
    {statement}
  ENDPROC
"""
IDLE = """
  PROC main()
    WHILE TRUE DO
      WaitTime 0.1;
    ENDWHILE
  ENDPROC
"""


def boot(*texts, release=(6, 15), specs=None):
    tasks = {f"T{number}": text for number, text in enumerate(texts, start=1)}
    made = replace(system(tasks, **(specs or {})), robotware=release)
    return VirtualController(made, autostart=False)


def sequence(controller, since=0):
    return [(e.type.name[0], e.code, e.arguments) for e in controller.log.since(since)]


def newest(controller):
    return max(event.sequence for event in controller.log)


@pytest.mark.parametrize("release", [(5, 61), (6, 3), (6, 15)])
def test_unhandled_error_from_561_on(release):
    """Lines 7171 to 7178 of the log of 5.61."""
    controller = boot(BROKEN.format(statement=ERRORS["procedure"]), release=release)
    with controller:
        before = newest(controller)
        controller.start_program()
        controller.run_for(1)
        assert sequence(controller, before) == [
            ("I", 10052, ("0",)),
            ("I", 10053, ("0",)),
            ("I", 10151, ("1", "T1")),
            ("W", 40168, ("T1", "nowhere")),
            ("E", 40168, ("T1", "nowhere")),
            ("E", 40228, ("T1", "40168")),
            ("I", 10020, ("1", "T1")),
            ("I", 10126, ("1", "T1")),
        ]


def test_unhandled_error_before_560():
    """Lines 870747 to 870750 of a log of 5.15: no warning, and 40223 without a number."""
    controller = boot(BROKEN.format(statement=ERRORS["procedure"]), release=(5, 15))
    with controller:
        controller.start_program()
        before = newest(controller)
        controller.run_for(1)
        assert sequence(controller, before) == [
            ("E", 40168, ("T1", "nowhere")),
            ("E", 40223, ("T1",)),
            ("I", 10020, ("1", "T1")),
            ("I", 10126, ("1", "T1")),
        ]


def test_start_after_error_tries_statement_again():
    """Lines 7182 to 7190 of the log of 5.61."""
    controller = boot(BROKEN.format(statement=ERRORS["procedure"]), release=(5, 61))
    with controller:
        controller.start_program()
        controller.run_for(1)
        before = newest(controller)
        controller.start_program()
        controller.run_for(1)
        assert sequence(controller, before) == [
            ("I", 10021, ("1", "T1")),
            ("I", 10052, ("0",)),
            ("I", 10053, ("0",)),
            ("I", 10156, ("1", "T1")),
            ("W", 40168, ("T1", "nowhere")),
            ("E", 40168, ("T1", "nowhere")),
            ("E", 40228, ("T1", "40168")),
            ("I", 10020, ("1", "T1")),
            ("I", 10126, ("1", "T1")),
        ]


def test_background_task_of_default_trust_fails():
    """The log of an IRB 120 with 5.15: the system fails, and the motion task stops."""
    controller = boot(
        IDLE,
        BROKEN.format(statement=ERRORS["procedure"]),
        specs={"T2": {"type": "SEMISTATIC", "trust": "SysFail"}},
        release=(5, 15),
    )
    with controller:
        before = newest(controller)
        controller.start_program()
        controller.run_for(1)
        assert sequence(controller, before)[3:] == [
            ("E", 40168, ("T2", "nowhere")),
            ("E", 40223, ("T2",)),
            ("I", 10020, ("2", "T2")),
            ("E", 10048, ("T2",)),
            ("E", 10082, ("T2",)),
            ("I", 10126, ("2", "T2")),
            ("I", 10014, ()),
            ("I", 10125, ("1", "T1")),
        ]
        assert not controller.start_program()


def test_emergency_stop_while_a_program_runs():
    """Lines 247678 to 247680 of a log of 5.15."""
    controller = boot(IDLE, release=(5, 15))
    with controller:
        controller.start_program()
        controller.run_for(1)
        before = newest(controller)
        controller.perform("e-stop")
        assert sequence(controller, before) == [
            ("I", 10012, ()),
            ("I", 10013, ()),
            ("I", 10125, ("1", "T1")),
        ]


@pytest.mark.parametrize(("release", "command"), [((5, 15), "142"), ((6, 3), "66")])
def test_start_with_motors_off(release, command):
    """Line 871601 of a log of 5.15, line 534136 of the log of 6.03."""
    controller = boot(IDLE, release=release)
    with controller:
        controller.perform("motors-off")
        before = newest(controller)
        assert not controller.start_program()
        assert sequence(controller, before) == [("E", 20072, (command,))]


def test_handled_error_is_a_warning_with_its_place():
    """W 41581 of the logs of 5.15: task, place, name of the error."""
    text = """
  PROC main()
    VAR socketdev s;
    SocketCreate s;
    SocketConnect s, "127.0.0.1", 1 \\Time:=1;
  ERROR
    TRYNEXT;
  ENDPROC
"""
    controller = boot(text)
    with controller:
        controller.start_program()
        controller.run_for(3)
        event = next(e for e in sequence(controller) if e[1] == 41581)
        assert event == ("W", 41581, ("T1", "/m/main/SocketConnect/6", "ERR_SOCK_TIMEOUT"))
