"""Hand of a YuMi: stops of its fingers, control by RAPID signals."""

import pytest

from rapidgen.machine.event_log import EventLog
from rapidgen.machine.io import IOSystem
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.machine.smart_gripper import AMBIENT, SUCKED, Command, Hands, HandState
from rapidgen.system.model import SignalSpec, System

OUTPUTS = {"CmdGripper": 5, "MaxPosition": 8, "MinPosition": 8, "MaxSpeed": 8, "HoldForce": 8}
INPUTS = {"SysState": 5, "ActualPosition": 8, "ActualSpeed": 8}
SIGNALS = (
    *(SignalSpec(f"hand_{name}_L", "GO", size=size) for name, size in OUTPUTS.items()),
    *(SignalSpec(f"hand_{name}_L", "GI", size=size) for name, size in INPUTS.items()),
    SignalSpec("hand_CmdVacuum1_L", "DO"),
    SignalSpec("hand_StatusVacuum1_L", "DI"),
    SignalSpec("hand_StatusCalibrated_L", "DI"),
)


class Cell:
    def __init__(self, *signals):
        self.scheduler = Scheduler()
        log = EventLog(lambda: 0.0)
        self.io = IOSystem(self.scheduler, log, System("s", (), signals=signals))
        self.hand = Hands(self.scheduler, self.io)["L"]

    def wait(self, seconds):
        self.scheduler.advance(self.scheduler.now + round(seconds * S))

    def set(self, name, value):
        self.io.set(self.io[f"hand_{name}_L"], value)

    def get(self, name):
        return self.io[f"hand_{name}_L"].value


@pytest.fixture
def opened():
    """A hand whose fingers are 20 mm apart, and go 10 mm/s."""
    cell = Cell()
    cell.hand.command(Command.CALIBRATE)
    cell.hand.max_position, cell.hand.max_speed = 20.0, 10.0
    cell.hand.command(Command.TO_MAX)
    cell.wait(2)
    assert (cell.hand.position, cell.hand.state) == (20.0, HandState.COMPLETED)
    return cell


def test_fingers_stop_at_part(opened):
    hand = opened.hand
    hand.part = 12.0
    hand.command(Command.AGILE_INWARD)
    opened.wait(0.5)
    assert (hand.position, hand.speed, hand.state) == (15.0, 10.0, HandState.AGILE_INWARD)
    assert hand.force == 0.0
    opened.wait(0.4)
    assert (hand.position, hand.speed, hand.state) == (12.0, 0.0, HandState.KEEP_OBJECT)
    assert hand.force == hand.hold_force


def test_fingers_stop_inside_of_a_ring(opened):
    opened.hand.ring = 22.0
    opened.hand.command(Command.FORCE_OUTWARD)
    opened.wait(1)
    assert (opened.hand.position, opened.hand.state) == (22.0, HandState.KEEP_OBJECT)


def test_move_stopped_by_part_is_an_error(opened):
    opened.hand.part = 12.0
    opened.hand.command(Command.TO_MIN)
    opened.wait(1)
    assert (opened.hand.position, opened.hand.state) == (12.0, HandState.ERROR)
    opened.hand.command(Command.READY)
    assert opened.hand.state is HandState.READY


def test_a_new_command_takes_the_fingers_where_they_are(opened):
    opened.hand.command(Command.JOG_CLOSE)
    opened.wait(0.5)
    opened.hand.command(Command.READY)
    opened.wait(3)
    assert (opened.hand.position, opened.hand.state) == (15.0, HandState.READY)
    opened.hand.command(Command.CALIBRATE)
    assert opened.hand.position == 0.0


def test_a_part_closes_the_cup(opened):
    hand = opened.hand
    hand.switch("vacuum", 0, True)
    assert hand.pressure(0) == AMBIENT
    hand.cups[0] = True
    assert (hand.pressure(0), hand.pressure(1)) == (SUCKED, AMBIENT)


def test_rapid_driver_moves_hand_by_signals():
    """Sequence of HandDriver.sys for Hand_MoveTo 15."""
    cell = Cell(*SIGNALS)
    cell.set("CmdGripper", Command.CALIBRATE)
    assert (cell.get("StatusCalibrated"), cell.get("SysState")) == (1, HandState.COMPLETED)
    cell.set("MaxSpeed", 100)
    cell.set("CmdGripper", Command.READY)
    cell.set("MaxPosition", 150)
    cell.set("CmdGripper", Command.TO_MAX)
    cell.wait(1)
    assert cell.get("SysState") == HandState.TO_MAX
    assert (cell.get("ActualPosition"), cell.get("ActualSpeed")) == (100, 100)
    cell.wait(1)
    assert cell.get("SysState") == HandState.COMPLETED
    assert (cell.get("ActualPosition"), cell.get("ActualSpeed")) == (150, 0)
    cell.set("CmdVacuum1", 1)
    assert cell.get("StatusVacuum1") == 1


def test_registers_start_with_signal_values():
    (known,) = (s for s in SIGNALS if s.name == "hand_MaxSpeed_L")
    hand = Cell(SignalSpec(known.name, "GO", size=8, default=55)).hand
    assert hand.max_speed == 5.5


# Numbers of hand_CmdGripper and hand_SysState: the module's docstring names their source.
@pytest.mark.parametrize(
    ("command", "moving", "after", "position"),
    [
        (1, 11, 11, 25.0), (2, 12, 12, 0.0), (3, 2, 6, 20.0), (4, 3, 6, 2.0), (5, 4, 6, 0.0),
        (6, 5, 6, 25.0), (7, 7, 9, 0.0), (8, 8, 9, 25.0), (9, 1, 1, 10.0), (10, 0, 0, 10.0),
        (11, 6, 6, 0.0), (15, 16, 9, 0.0), (16, 17, 9, 25.0), (12, 6, 6, 10.0), (17, 6, 6, 10.0),
    ],
)  # fmt: skip
def test_command_signal_carries_number(command, moving, after, position):
    cell = Cell(*SIGNALS)
    cell.hand.command(Command.CALIBRATE)
    cell.hand.max_position, cell.hand.min_position, cell.hand.max_speed = 10.0, 2.0, 20.0
    cell.hand.command(Command.TO_MAX)
    cell.wait(2)
    cell.hand.max_position = 20.0
    cell.set("CmdGripper", command)
    assert cell.get("SysState") == moving
    cell.wait(0.02)
    assert cell.get("SysState") == moving
    cell.wait(2)
    assert cell.get("SysState") == after
    assert cell.hand.position == pytest.approx(position)
    assert cell.get("ActualPosition") == round(position * 10)
