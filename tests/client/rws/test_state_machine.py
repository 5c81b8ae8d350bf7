"""A RAPID program that waits for routines, as ABB's StateMachine add-in does, driven over RWS.

The program is written for this test. Like the add-in [code], it reads the cfg of its robot, books
an error, and leaves its idle loop by a RAISE in a TRAP; a client sets the routine's name and raises
a signal [code: abb_librws].
"""

import math
import time

import pytest

from rapidgen.client.rws import Controller
from rapidgen.servers.rws.server import serve_rws
from rapidgen.wire.rws.bodies import Generation
from tests.servers.rws.served import make_runner

PROGRAM = """MODULE MainModule
    CONST num IDLE := 0;
    CONST num RUNNING := 1;
    VAR num state := -1;
    VAR errnum CHANGE := -1;
    VAR intnum requested;
    VAR string routine := "";
    VAR jointtarget input_target;
    PERS bool modal := FALSE;
    VAR string joint{2};
    VAR num offsets{2} := [9, 9];

    PROC main()
        modal := GetModalPayloadMode() = 1;
        read_robot;
        BookErrNo CHANGE;
        input_target := CJointT();
        IDelete requested;
        CONNECT requested WITH on_request;
        ISignalDI diStart, high, requested;
        state := IDLE;
        WHILE TRUE DO
            IF state = RUNNING run_routine;
            WaitTime 0.01;
        ENDWHILE
    ERROR (CHANGE)
        TRYNEXT;
    ENDPROC

    PROC read_robot()
        VAR string path;
        path := "/MOC/ROBOT/" + GetMecUnitName(ROB_ID);
        ReadCfgData path, "use_joint_0", joint{1};
        ReadCfgData path, "use_joint_5", joint{2};
        ReadCfgData path, "base_frame_pos_z", offsets{1};
        ReadCfgData "/MOC/ARM/" + joint{1}, "cal_position", offsets{2};
    ENDPROC

    TRAP on_request
        IF routine <> "" AND state = IDLE THEN
            state := RUNNING;
            RAISE CHANGE;
        ENDIF
    ERROR (CHANGE)
        RAISE CHANGE;
    ENDTRAP

    PROC run_routine()
        TEST routine
        CASE "move":
            MoveAbsJ input_target, v1000, fine, tool0;
        DEFAULT:
            %routine%;
        ENDTEST
        routine := "";
        state := IDLE;
    ERROR
        routine := "failed";
        state := IDLE;
        RETURN;
    ENDPROC

    PROC home()
        MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
    ENDPROC
ENDMODULE
"""
TARGET = ((10.0, 5.0, 0.0, 0.0, 20.0, 0.0), (9e9,) * 6)


def wait_idle(controller):
    """Wait until the program has executed a routine."""
    deadline = time.monotonic() + 60
    while controller.symbol("T_ROB1/MainModule/state") != 0:
        assert time.monotonic() < deadline, "the program is not idle"


def run(controller, routine):
    """Run a routine as abb_librws does: set its name, pulse the signal."""
    controller.set_symbol("T_ROB1/MainModule/routine", routine)
    controller.set_signal("diStart", 0)
    controller.set_signal("diStart", 1)
    deadline = time.monotonic() + 60
    while controller.symbol("T_ROB1/MainModule/routine") == routine:
        assert time.monotonic() < deadline, f"{routine} does not end"
    wait_idle(controller)


def test_routines_are_run_by_name_and_signal(tmp_path):
    with make_runner(tmp_path, program=PROGRAM, clock="real", speed=60) as runner:
        runner.start()
        service = serve_rws(runner, Generation.ONE)
        address = f"rws://{service.host}:{service.port}"
        with Controller(address, password=service.password, pin_file=tmp_path / "pins") as one:
            one.pp_to_main()
            one.start()
            wait_idle(one)
            assert one.symbol("T_ROB1/MainModule/modal") is True
            assert one.symbol("T_ROB1/MainModule/joint") == ("rob1_1", "rob1_6")
            assert one.symbol("T_ROB1/MainModule/offsets") == (0, 0)
            one.set_symbol("T_ROB1/MainModule/input_target", TARGET)
            run(one, "move")
            run(one, "nothing_of_this_name")
            assert one.symbol("T_ROB1/MainModule/routine") == "failed"
            run(one, "home")
            assert one.execution().running
        service.close()
        (group,) = runner.controller.motion.groups.values()
        assert group.positions()[4] == pytest.approx(math.radians(30))
