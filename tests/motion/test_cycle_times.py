"""Durations and limits of moves: they add up, and relaxing a limit shortens its move."""

import json
from types import SimpleNamespace

import pytest

from rapidgen.cli.app import main
from rapidgen.config import load_config
from rapidgen.motion.active_limits import Ceilings, active_limit
from rapidgen.motion.cycle_times import CycleTimes
from rapidgen.motion.pieces import AxisLimits, Piece
from rapidgen.motion.system import MotionSystem
from tools import motion_campaign as campaign

ACCELERATION = "acceleration of "


@pytest.fixture
def watched(monkeypatch):
    """Cycle times of all groups that are made."""
    times = []
    make = MotionSystem.__init__

    def made(self, scheduler, *arguments, **options):
        make(self, scheduler, *arguments, **options)
        times.extend(CycleTimes(scheduler, group) for group in self.groups.values())

    monkeypatch.setattr(MotionSystem, "__init__", made)
    return times


@pytest.mark.parametrize("kind", ["joint", "brakes", "cartesian"])
@pytest.mark.parametrize("seed", range(3))
def test_times_add_up_with_stops_and_overrides(watched, kind, seed):
    campaign.run(seed, kind)
    (times,) = watched
    times.finish()
    stood = sum(end - begin for begin, end in times.standing)
    moved = sum(move.duration for move in times.moves)
    assert moved + stood == pytest.approx(times.end - times.start, abs=1e-6)
    for move in times.moves:
        assert sum(move.limits.values()) == pytest.approx(move.duration, abs=1e-9)
        assert min(move.limits.values(), default=0.0) >= 0.0


@pytest.mark.parametrize(
    ("corner", "bend", "acceleration", "expected"),
    [
        (True, 0.8, 0.1, "corner"),
        (True, 0.1, 0.8, "acceleration of axis 1"),
        (False, 0.8, 0.1, "acceleration of axis 1"),
    ],
)
def test_limit_where_path_bends_and_speed_changes(corner, bend, acceleration, expected):
    """Axis 1 has the acceleration 1 and needs 0.9 of it, for its bend or for the speed."""
    piece = Piece(0.0, 1.0, lambda p: (p + bend * (p - 0.5) ** 2 / 2, p / 10), (9.0, ()), 0.0)
    piece.corner = corner
    way = SimpleNamespace(limits=AxisLimits((9.0, 9.0), (1.0, 1.0), 0.9))
    joints = load_config("irb120").groups[0].joints[:2]
    state = 0.5, 1.0, acceleration
    assert active_limit(piece, SimpleNamespace(way=way), state, joints, Ceilings(1.0)) == expected


def seconds_of(tmp_path, move, accelerations):
    """(duration, limits) of the second move of a program; accelerations by joint."""
    joints = [f"  {name}: {{acceleration: {a}}}\n" for name, a in accelerations.items()]
    (tmp_path / "robot.yaml").write_text("model: irb120\njoints:\n" + "".join(joints))
    (tmp_path / "p.mod").write_text(
        "MODULE p\n PROC main()\n"
        "  MoveAbsJ [[20,10,5,0,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]], vmax, fine, tool0;\n"
        f"  {move}\n ENDPROC\nENDMODULE\n"
    )
    report = tmp_path / "report.json"
    words = ["run", str(tmp_path / "p.mod"), "--robot", str(tmp_path / "robot.yaml")]
    assert main([*words, "--cycle-report", str(report)]) == 0
    (robot,) = json.loads(report.read_text())["robots"]
    return robot["moves"][1]["seconds"], robot["moves"][1]["limits"]


@pytest.mark.parametrize(
    "move",
    [
        "MoveL Offs(CRobT(\\Tool:=tool0),0,0,-120), vmax, fine, tool0;",
        "MoveL Offs(CRobT(\\Tool:=tool0),0,-250,0), vmax, fine, tool0;",
        "MoveAbsJ [[-60,10,5,0,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]], vmax, fine, tool0;",
    ],
)
def test_only_the_limiting_axes_count(tmp_path, move):
    group = load_config("irb120").groups[0]
    usual = {joint.name: round(joint.acceleration * 57.29578, 1) for joint in group.joints}
    before, limits = seconds_of(tmp_path, move, usual)
    named = {limit.removeprefix(ACCELERATION) for limit in limits if limit.startswith(ACCELERATION)}
    others = [j for j in usual if j.replace("joint_", "axis ") not in named]
    same, _ = seconds_of(tmp_path, move, {**usual, **{j: 2 * usual[j] for j in others}})
    assert same == pytest.approx(before, rel=0.002)
    first = max(named, key=lambda axis: limits[ACCELERATION + axis]).replace("axis ", "joint_")
    faster, _ = seconds_of(tmp_path, move, {**usual, first: 1.3 * usual[first]})
    assert faster < before * 0.97
