"""Switches for what the generated driver takes for granted and no manual settles, both ways."""

import pytest

from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.motion.settings import MotionSettings
from rapidgen.runtime.switches import Switches
from tests.runtime.booting import boot, system

SENDER = """
    VAR socketdev server;
    VAR socketdev client;
    VAR rawbytes data;
    VAR intnum alarm;
    VAR clock watch;

    PROC main()
        VAR num sent := 0;

        PackRawBytes 0, data, 1021 \\IntX:=DINT;
        SocketCreate server;
        SocketBind server, "10.0.0.1", 5000;
        SocketListen server;
        SocketAccept server, client;
        CONNECT alarm WITH on_alarm;
        ITimer \\Single, 1, alarm;
        ClkStart watch;
        WHILE TRUE DO
            SocketSend client \\RawData:=data;
        ENDWHILE
    ERROR
        TPWrite ValToStr(Round(ClkRead(watch)));
        EXIT;
    ENDPROC

    TRAP on_alarm
        SocketClose client;
    ENDTRAP
"""


@pytest.mark.parametrize(("attends", "seconds"), [(True, "1"), (False, "60")])
def test_a_trap_while_socket_send_waits(attends, seconds):
    controller, printed = boot(SENDER, dialect=Switches(send_attends=attends))
    controller.start_program()
    controller.run_for(0.1)
    controller.network.connect("10.0.0.1", 5000)
    controller.run_for(70)
    assert printed == [seconds]
    controller.close()


LISTENER = """
    VAR intnum event;

    PROC main()
        CONNECT event WITH on_event;
        IError COMMON_ERR, TYPE_ALL, event;
        ErrWrite \\I, "mine", "";
        WaitTime 2;
    ENDPROC

    TRAP on_event
        VAR trapdata data;
        VAR errdomain domain;
        VAR num number;
        VAR errtype type;
        VAR string title;

        GetTrapData data;
        ReadErrData data, domain, number, type \\Title:=title;
        TPWrite title;
    ENDTRAP
"""
OTHER = """
    PROC main()
        WaitTime 1;
        ErrWrite \\I, "theirs", "";
    ENDPROC
"""


@pytest.mark.parametrize(("reach", "found"), [("all", ["mine", "theirs"]), ("own", ["mine"])])
def test_whose_events_reach_ierror(reach, found):
    """Public loggers watch other tasks from one of their own [code: motion_program_exec]."""
    controller, printed = boot(LISTENER, OTHER, dialect=Switches(error_reach=reach))
    controller.start_program()
    controller.run_for(1.5)
    assert [line for line in printed if line in ("mine", "theirs")] == found
    controller.close()


ASKS = """
    PROC main()
        VAR num bound;

        ReadCfgData "/MOC/ARM/{arm}", "upper_joint_bound", bound;
        TPWrite NumToStr(bound, 3);
        EXIT;
    ERROR
        IF ERRNO = ERR_CFG_NOTFND TPWrite "not found";
        EXIT;
    ENDPROC
"""


@pytest.mark.parametrize(
    ("robot", "arm", "bound"),
    [
        # rob1_1 [backups], rob_R_7 and "MOC/ARM/rob_R_1" [code: a public YuMi server], an axis
        # named as its unit [backups: M7DM1].
        ("irb120", "rob1_1", "2.880"),
        ("irb14000", "rob_R_7", "2.941"),
        ("irb14000", "rob_L_3", "1.396"),
        ("irb120_track", "TRACK_1", "3.000"),
        ("irb910sc", "rob1_3", "0.000"),
    ],
)
def test_the_limits_of_the_axes(robot, arm, bound):
    groups = load_config(robot).groups
    for told in (True, False):
        controller, printed = boot(
            ASKS.replace("{arm}", arm), robots=groups, dialect=Switches(axis_limits_told=told)
        )
        controller.start_program()
        controller.run_for(1)
        assert printed == [bound if told else "not found"]
        controller.close()


MOVES = """
    PROC main()
        MoveAbsJ [[90,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;
        EXIT;
    ENDPROC
"""
STOPS = """
    PROC main()
        WaitTime 0.5;
        StopMove;
        WaitTime 60;
    ENDPROC
"""
STARTS = """
    PROC main()
        WaitTime 2;
        IF IsStopMoveAct(\\FromNonMoveTask) StartMove;
        WaitTime 60;
    ENDPROC
"""


@pytest.mark.parametrize(("owner", "moves"), [("kind", True), ("task", False)])
def test_whose_stop_start_move_takes_back(owner, moves):
    background = {"type": "SEMISTATIC", "trust": "NoSafety"}
    controller = VirtualController(
        system(
            {"T_ROB1": MOVES, "T_STOPS": STOPS, "T_STARTS": STARTS},
            T_ROB1={"motion": True},
            T_STOPS=background,
            T_STARTS=background,
        ),
        load_config("irb120").groups,
    )
    controller.motion.settings = MotionSettings(stop_owner=owner)
    group = controller.motion.group("rob1")
    controller.run_for(1.5)
    stopped_at = group.positions()[0]
    assert group.is_standing
    assert stopped_at > 0
    controller.run_for(20)
    assert (group.positions()[0] > stopped_at + 1) is moves
    controller.close()
