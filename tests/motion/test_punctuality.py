"""When a move that promised a time is reported as late: by more than 2 ms, once a standstill."""

import pytest

from rapidgen.motion.events import TIME_NOT_MET
from rapidgen.motion.legs import JointPath, Leg
from rapidgen.motion.moves import Measure
from rapidgen.motion.pieces import AxisLimits
from rapidgen.motion.timing_monitor import TimingMonitor


@pytest.fixture
def passed(cell, joint):
    """A leg that took so long, and promised a second."""
    limits = AxisLimits([1.0] * 6, [1.0] * 6, 0.8)

    def make(took: float, promised: float | None = 1.0) -> Leg:
        move = joint(10, time=promised)
        path = JointPath(
            cell.group.positions(), move.target, 1.0, (Measure(), 0.0), limits, 1.0, [1.0]
        )
        return Leg(move, path, 0.0, 1.0, began=5.0, passed_at=5.0 + took)

    return make


@pytest.mark.parametrize(
    ("took", "reported"), [(0.9, 0), (1.0, 0), (1.0019, 0), (1.0021, 1), (1.5, 1)]
)
def test_late_by_more_than_two_milliseconds(cell, passed, took, reported):
    punctuality = TimingMonitor()
    punctuality.finished(passed(took), None, cell.group.motion)
    punctuality.report(cell.log, "rob1")
    assert cell.events(TIME_NOT_MET) == reported


def test_one_report_sums_up_the_late_moves_since_the_last_one(cell, passed):
    punctuality = TimingMonitor()
    for took in (1.25, 1.001, 1.5):
        punctuality.finished(passed(took), None, cell.group.motion)
    punctuality.finished(passed(9.0, promised=None), None, cell.group.motion)
    punctuality.report(cell.log, "rob1")
    punctuality.report(cell.log, "rob1")
    (event,) = cell.log
    assert event.texts[0] == "rob1: 2 moves with \\T took 0.750 s longer"
