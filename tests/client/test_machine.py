"""A state machine of client and controller: random calls, losses and stops in any order.

The model is small: where the robot was last seen to stand, and whether a trajectory is under
way. What must hold whatever came before is in the rules and the invariants.
"""

import asyncio

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

from rapidgen.client import (
    AsyncRobot,
    ConnectionLost,
    InvalidTrajectory,
    MotionStopped,
    NotReady,
    Trajectory,
)
from rapidgen.client.address import Address
from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.protocol.spec import Reason
from rapidgen.virtual.asyncio_clock import VirtualLoop
from rapidgen.virtual.controller import VirtualController

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
        self.asked = [path.positions.min(axis=0) - 2e-3, path.positions.max(axis=0) + 2e-3]

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
        except (MotionStopped, ConnectionLost):
            assert was_over, "nothing ended it since the last step"
            return
        assert result.deviation < 1e-3
        assert result.seconds < 4 * result.planned_seconds + 2

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

    @rule(ports=st.sampled_from(["all", "state", "motion"]))
    def lose_connections(self, ports):
        was = self.under_way
        for port, link in list(self.robot._links.items()):
            if ports in ("all", port.name.lower()):
                link.transport.abort()
        self.do(asyncio.sleep(1.5))
        if was:
            # Blind or cut off: failed, and nothing moves any more.
            with pytest.raises((ConnectionLost, MotionStopped)):
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
    deadline=None,
    derandomize=True,
    # Booting takes most of the time; the explanation would trace all of it.
    phases=(Phase.explicit, Phase.generate),
    suppress_health_check=list(HealthCheck),
)
