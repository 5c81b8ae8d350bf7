"""A state machine of client and controller: random calls, losses and stops in any order.

The model is small: where the robot was last seen to stand, and whether a trajectory is under
way. What must hold whatever came before is in the rules and the invariants.
"""

import asyncio

import numpy as np
import pytest
from hypothesis import Phase, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

from rapidgen.client import (
    AsyncRobot,
    ConnectionLost,
    InvalidTrajectory,
    MotionFailed,
    MotionStopped,
    NotReady,
    RequestRefused,
    Trajectory,
)
from rapidgen.client.address import Address
from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.generate import build, make_system
from rapidgen.testing.asyncio_clock import VirtualLoop
from rapidgen.wire.simple_message.spec import Port, Reason

CONFIG = load_config("irb120")
SYSTEM = make_system(CONFIG, build(CONFIG))
GROUP = CONFIG.groups[0]
# The first task raises Python's recursion limit, which hypothesis does not want to see changed.
VirtualController(SYSTEM, CONFIG.groups).close()
STEPS = st.lists(st.floats(-0.2, 0.2), min_size=6, max_size=6)


class ClientAndController(RuleBasedStateMachine):
    """One AsyncRobot and one controller on the virtual clock."""

    def __init__(self):
        super().__init__()
        self.controller = VirtualController(SYSTEM, CONFIG.groups)
        self.controller.run_for(2.0)
        self.loop = VirtualLoop(self.controller)
        address = Address("controller", GROUP.ports.motion, GROUP.ports.state)
        self.robot = AsyncRobot(CONFIG, address=address, reconnect=5)
        self.do(self.robot.connect())
        self.execution = None
        self.held = 0.0
        self.asked = []
        """Where the robot may be: the ends of what was asked, from where it then stood."""

    def do(self, coroutine):
        return self.loop.run_until_complete(coroutine)

    def teardown(self):
        self.do(self.robot.close())
        self.do(asyncio.sleep(0.1))
        self.loop.close()
        self.controller.close()

    @property
    def under_way(self):
        return self.execution is not None and not self.execution.is_over

    def path(self, steps, seconds):
        here = np.array(self.robot.state.joints)
        goal = np.clip(here + steps, -0.5, 0.5)
        return Trajectory.from_points([here, (here + goal) / 2, goal], seconds=seconds)

    @rule(steps=STEPS, seconds=st.sampled_from([0.3, 0.5, 1.0]))
    def execute(self, steps, seconds):
        path = self.path(steps, seconds)
        if self.under_way:
            with pytest.raises(NotReady):
                self.do(self.robot.execute(path))
            return
        self.execution = self.do(self.robot.execute(path))
        self.held = 0.0
        self.asked = [path.positions.min(axis=0) - 2e-3, path.positions.max(axis=0) + 2e-3]

    def points(self, start, steps, count):
        goal = np.clip(start + np.array(steps), -0.5, 0.5)
        return np.linspace(start, goal, count)

    @rule(steps=STEPS, count=st.sampled_from([2, 5, 40, 200]))
    def stream(self, steps, count):
        points = self.points(np.array(self.robot.state.joints), steps, count)
        stream = self.robot.stream()
        begin = stream.append(np.arange(count) * 0.2, points)
        if self.under_way:
            with pytest.raises(NotReady):
                self.do(begin)
            return
        self.do(begin)
        self.execution = stream
        self.asked = [points.min(axis=0) - 2e-3, points.max(axis=0) + 2e-3]
        self.last = points[-1]

    @precondition(lambda self: self.is_streaming)
    @rule(steps=STEPS, count=st.sampled_from([1, 5, 40]), flush=st.booleans())
    def append(self, steps, count, flush):
        points = self.points(self.last, steps, count + 1)[1:]
        self.last = points[-1]
        self.asked[0] = np.minimum(self.asked[0], points.min(axis=0) - 2e-3)
        self.asked[1] = np.maximum(self.asked[1], points.max(axis=0) + 2e-3)
        times = self.execution.time + 0.2 * np.arange(1, count + 1)
        self.do(self.execution.append(times, points))
        if flush:
            self.do(self.execution.flush())

    @property
    def is_streaming(self):
        feed = getattr(self.execution, "_job", None)
        return feed is not None and self.under_way and not feed.is_ended

    @precondition(lambda self: self.under_way and self.has_control)
    @rule(seconds=st.floats(0.1, 3), percent=st.sampled_from([10, 50, 100]))
    def hold(self, seconds, percent):
        try:
            self.held += 2 * seconds + 2
            self.do(self.robot.pause())
            self.do(asyncio.sleep(1 + seconds))
            joints = self.robot.state.joints
            self.do(asyncio.sleep(seconds))
            assert self.robot.state.joints == pytest.approx(joints, abs=2e-3)
            self.do(self.robot.resume())
            self.do(self.robot.set_speed(percent))
        except RequestRefused as error:
            assert error.reason is Reason.IDLE  # noqa: PT017 - it may have ended meanwhile

    @property
    def has_control(self):
        return self.robot._core.ports[Port.CONTROL].is_open

    @rule(column=st.integers(0, 5), value=st.sampled_from([9.0, -9.0, float("nan")]))
    def execute_what_is_wrong(self, column, value):
        goal = np.array(self.robot.state.joints)
        goal[column] = value
        bad = Trajectory([0, 5], [self.robot.state.joints, goal])
        with pytest.raises((NotReady, InvalidTrajectory)):
            self.do(self.robot.execute(bad))

    @rule()
    def stop(self):
        state = self.do(self.robot.stop())
        self.do(asyncio.sleep(0.5))
        assert self.robot.state.joints == pytest.approx(state.joints, abs=2e-3)
        assert not self.under_way

    @rule(seconds=st.floats(0, 0.7))
    def wait(self, seconds):
        self.do(asyncio.sleep(seconds))

    @precondition(lambda self: self.execution is not None)
    @rule()
    def result(self):
        was_over = self.execution.is_over
        try:
            result = self.do(self.execution.result())
        except (MotionStopped, MotionFailed, ConnectionLost):
            assert was_over, "nothing ended it since the last step"
            return
        assert result.deviation < 1e-3
        if result.mode == "download" and self.robot._core.override == 1:
            assert result.seconds < 4 * result.planned_seconds + 2 + self.held

    @precondition(lambda self: self.under_way)
    @rule()
    def cancel(self):
        self.do(self.execution.cancel())
        try:
            # It may have arrived before the STOP did.
            assert self.do(self.execution.result()).deviation < 1e-3
        except MotionStopped as error:
            assert error.reason is Reason.STOPPED  # noqa: PT017 - either way is right
        assert self.execution.stopped_position is not None

    @rule(ports=st.sampled_from(["all", "state", "motion", "control"]))
    def lose_connections(self, ports):
        if ports == "control" and not self.has_control:
            return
        was = self.under_way
        for port, link in list(self.robot._runner._by_port.items()):
            if ports in ("all", port.name.lower()):
                link.transport.abort()
        self.do(asyncio.sleep(1.5))
        if was:
            # Blind, cut off or missed: failed, and nothing moves any more.
            kind = MotionFailed if ports == "control" else (ConnectionLost, MotionStopped)
            with pytest.raises(kind):
                self.do(self.execution.result())
            self.do(asyncio.sleep(1.0))
        first = self.do(self.robot.next_state())
        self.do(asyncio.sleep(0.3))
        assert self.do(self.robot.next_state()).joints == pytest.approx(first.joints, abs=1e-3)

    @invariant()
    def robot_is_where_it_was_asked_to_be(self):
        joints = np.array(self.robot.state.joints)
        if self.asked:
            assert (self.asked[0] <= joints).all()
            assert (joints <= self.asked[1]).all()

    @invariant()
    def every_task_of_the_controller_runs(self):
        faults = [task.fault for task in self.controller.tasks.values() if task.fault]
        assert not faults


TestClientAndController = ClientAndController.TestCase
TestClientAndController.settings = settings(
    max_examples=12,
    stateful_step_count=14,
    # Booting takes most of the time; the explanation would trace all of it.
    phases=(Phase.explicit, Phase.generate),
)
