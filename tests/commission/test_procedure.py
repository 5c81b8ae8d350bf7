"""Commissioning on the virtual clock: a correct robot, and robots that differ from their URDF.

The driver is always that of the configuration, as on a robot where it was deployed. Mechanics and
operator are those of another, true configuration: the operator sees how the true robot moves.
"""

import asyncio
import math
from dataclasses import replace
from functools import cache

import pytest

from rapidgen.axes import frames
from rapidgen.axes.kinematics import MovingFrame
from rapidgen.client import AsyncRobot
from rapidgen.client.address import Address
from rapidgen.commission import Checklist, Commissioning, run
from rapidgen.commission.controller_view import PanelState
from rapidgen.config import load_config
from rapidgen.controller.cell_setup import CellSetup
from rapidgen.controller.controller import VirtualController
from rapidgen.controller.faults import FaultPlan
from rapidgen.generate import build, make_system
from rapidgen.machine.network.fault_injection import NetworkRule
from rapidgen.testing.asyncio_clock import run as run_virtually

TRUE = load_config("irb120")

BENT = (0.2, 0.1, 0.1, 0.3, 0.6, -0.2)


@cache
def driver_of(group):
    """Return BUILD_ID and system of the driver that was deployed with a group's configuration."""
    config = replace(TRUE, groups=(group,))
    generated = build(config)
    return generated.build_id, make_system(config, generated)


def changed(**joints):
    """Return the true group with other joints: `joint_2=dict(sign=-1)`."""
    group = TRUE.groups[0]
    own = tuple(replace(joint, **joints.get(joint.name, {})) for joint in group.joints)
    order = [joint.axis for joint in group.joints]
    return replace(group, joints=tuple(sorted(own, key=lambda joint: order.index(joint.axis))))


class Bench:
    """A controller with true mechanics, its own view, and an operator who watches the robot."""

    assumed = False

    def __init__(
        self, believed=None, *, start=BENT, watches=True, faults=None, manual=True, answers=None
    ):
        self.believed = believed or TRUE.groups[0]
        self.config = replace(TRUE, groups=(self.believed,))
        self.build, system = driver_of(self.believed)
        self.controller = VirtualController(
            system, TRUE.groups, faults=faults, surroundings=CellSetup(starts={"rob1": start})
        )
        self.truth = MovingFrame.of(TRUE.groups[0], TRUE.groups[0].chain)
        self.watches = watches
        self.answers = answers or {}
        self.texts, self.asked = [], []
        self.peak = None
        self.controller.run_for(1.0)
        if manual:
            self.controller.set_mode("manual_reduced")
            self.controller.set_motors(True)
            self.controller.start_program()
        self.controller.run_for(2.0)

    # the controller's own view

    async def axes(self):
        return tuple(self.controller.positions().values())

    async def flange(self):
        return self.truth.pose(await self.axes())

    async def panel(self):
        mode = {"auto": "AUTO", "manual_reduced": "MANR"}[self.controller.mode]
        return PanelState(mode, 100, "7.6", True)

    # the operator

    def announce(self, text):
        self.texts.append(text)

    async def ask(self, question):
        self.asked.append(question.name)
        kind, _, joint = question.name.partition(".")
        if question.name in self.answers or kind in self.answers:
            return self.answers.get(question.name, self.answers.get(kind))
        if kind == "move":
            before, self.peak = await self.flange(), []
            self.axes_before = await self.axes()
            self.looking = asyncio.ensure_future(self._look(before))
        elif kind == "emergency":
            asyncio.get_running_loop().call_later(4.0, self.controller.set_e_stop, True)
        elif kind == "reset":
            self.controller.set_e_stop(False)
        elif kind == "restart":
            self.controller.set_motors(True)
            self.controller.start_program()
        elif kind == "direction" and self.watches:
            return self._saw(joint)
        return "yes"

    async def _look(self, before):
        for _ in range(40):
            await asyncio.sleep(0.05)
            self.peak.append(frames.compose(frames.invert(before), await self.flange()))

    def _saw(self, name):
        """Return which joint of the URDF would have moved the flange like this."""
        far = max(self.peak, key=lambda pose: frames.to_axis(pose[1])[1])
        turn, angle = frames.to_axis(far[1])
        model = MovingFrame.of(self.believed, self.believed.chain)
        wire = self.axes_before
        joints = self.believed.joints

        def miss(k, sense):
            moved = tuple(v + sense * angle * (n == k) for n, v in enumerate(wire))
            own = frames.compose(frames.invert(model.pose(wire)), model.pose(moved))
            return frames.distance(frames.to_axis(own[1])[0], turn) + 10 * frames.distance(
                own[0], far[0]
            )

        _, k, sense = min((miss(k, sense), k, sense) for k in range(6) for sense in (1, -1))
        at = self.axes_before[k]
        middle = (joints[k].lower + joints[k].upper) / 2
        if joints[k].name != name:
            return joints[k].name
        return "yes" if sense == (1 if at <= middle else -1) else "opposite"

    def connect(self, watch):
        ports = self.believed.ports
        return AsyncRobot(
            self.config,
            address=Address("controller", ports.motion, ports.state),
            watch=watch,
        )


def commissioning(bench, *, view=True, build_id=None):
    date = "2026-01-02T03:04:05+00:00"
    return Commissioning(
        bench.believed,
        bench.connect,
        bench,
        Checklist("cell", "IRB 120", "rob1", "sim", date, "0.1.0"),
        build_id or bench.build,
        view=bench if view else None,
    )


def commissioned(bench, **options):
    job = commissioning(bench, **options)
    with bench.controller:
        return run_virtually(bench.controller, run(job))


SIGN = changed(joint_2={"sign": -1})
ZERO = changed(joint_3={"offset": math.radians(10)})
SWAPPED = changed(joint_4={"axis": "rax_5"}, joint_5={"axis": "rax_4"})


def test_good_robot_passes_all_stages():
    bench = Bench()
    result = commissioned(bench)
    assert (result.end, result.failures) == ("complete", ())
    steps = {step.name: step for step in result.steps}
    assert {"values", "direction.joint_6", "model", "stop", "cable", "reset", "restored"} <= {
        *steps
    }
    stop, cable = steps["stop"].figures, steps["cable"].figures
    # A driver stops within two of its cycles; 10 joint messages a second show it.
    assert stop["stop_time_s"] <= 0.2
    assert 0.05 < stop["stop_way_deg"] < 1.0
    assert cable["stop_time_s"] <= 0.2
    assert cable["speed_deg_s"] == pytest.approx(2, abs=0.2)
    assert bench.controller.positions() == pytest.approx(
        {f"joint_{k}": value for k, value in enumerate(BENT, 1)},
        abs=1e-4,
    )


@pytest.mark.parametrize(
    ("believed", "watches", "view", "code", "text"),
    [
        (SIGN, True, False, "RG686", "joint_2 turns against the announced direction: its sign"),
        (SIGN, False, True, "RG686", "joint_2 turns against its controller axis rax_2: the sign"),
        (ZERO, True, True, "RG687", "the zero of joint_3 (rax_3) differs by -10.00 deg"),
        (SWAPPED, True, False, "RG686", "joint_4 moved instead of joint_5"),
        (SWAPPED, False, True, "RG686", "joint_5 and joint_4 are swapped: joint_5 is rax_5"),
    ],
)
def test_wrong_joint_map_is_named(believed, watches, view, code, text):
    result = commissioned(Bench(believed, watches=watches), view=view)
    (failure,) = result.failures
    assert (result.end, failure.code) == ("failed", code)
    assert text in failure.found
    assert failure.help


def test_late_stop_is_named():
    """Later by 0.1 s, and the client itself gives up its first motion (RG603)."""
    late = [NetworkRule("delay", port=port, direction="in", seconds=0.5) for port in (11000, 11001)]
    result = commissioned(Bench(faults=FaultPlan(network=tuple(late))))
    (failure,) = result.failures
    assert (failure.name, failure.code) == ("stop", "RG688")
    assert failure.figures["stop_time_s"] == pytest.approx(0.6, abs=0.1)
    assert failure.figures["limit_s"] < failure.figures["stop_time_s"]


@pytest.mark.parametrize(
    ("options", "job", "code", "text"),
    [
        ({"manual": False}, {}, "RG684", "not in manual mode with reduced speed: AUTO"),
        ({"start": (0.0,) * 6}, {}, "RG684", "joint_4 and joint_6 turn about the same line"),
        ({"start": (0.2, 0.1, 0.1, 0.3, 0.6, 0.0), "answers": {"area": "no"}}, {}, "RG684", "pre"),
        ({"answers": {"marks": "no"}}, {}, "RG687", "calibration marks"),
        ({}, {"build_id": "0" * 12}, "RG685", "the configuration gives 000000000000"),
    ],
)
def test_doubt_ends_before_any_motion(options, job, code, text):
    bench = Bench(**options)
    before = bench.controller.positions()
    result = commissioned(bench, **job)
    (failure,) = result.failures
    assert failure.code == code
    assert text in failure.found
    assert bench.controller.positions() == before
    assert not bench.texts


def test_no_move_without_consent():
    bench = Bench(answers={"move.joint_3": "no"})
    result = commissioned(bench)
    assert result.failures[0].code == "RG689"
    assert [step.name for step in result.steps][-2] == "direction.joint_2"
    assert len(bench.texts) == 3


def test_emergency_stop_not_pressed_fails():
    bench = Bench(answers={"emergency": "yes"})
    (failure,) = commissioned(bench).failures
    assert (failure.name, failure.code) == ("emergency", "RG688")


def test_robot_that_moves_by_itself_is_found():
    """After the emergency stop is released, the robot is moved."""
    bench = Bench()
    ask = bench.ask

    async def jogged(question):
        if question.name == "reset":
            group = bench.controller.motion.groups["rob1"]
            asyncio.get_running_loop().call_later(1.0, group.jump, (0.25, *BENT[1:]))
        return await ask(question)

    bench.ask = jogged
    (failure,) = commissioned(bench).failures
    assert failure.code == "RG688"
    assert "moved by itself after the emergency stop was released" in failure.found


def test_interruption_stops_the_robot_and_ends_the_checklist():
    bench = Bench()
    kept = []

    async def interrupted():
        job = commissioning(bench)
        job.changed = kept.append
        task = asyncio.ensure_future(run(job))
        while not bench.texts:
            await asyncio.sleep(0.05)
        await asyncio.sleep(0.4)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task
        at = bench.controller.positions()
        await asyncio.sleep(2)
        return at

    with bench.controller:
        at = run_virtually(bench.controller, interrupted())
        assert at["joint_1"] != pytest.approx(BENT[0], abs=1e-4)
        assert bench.controller.positions() == at
    assert kept[-1].end == "interrupted"
