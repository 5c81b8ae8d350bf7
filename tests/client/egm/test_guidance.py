"""Sessions of the driver, requested by the client; both are on the virtual clock."""

import asyncio
from contextlib import asynccontextmanager

import pytest

import rapidgen.client.egm
from rapidgen.client import AsyncRobot, NotReady, NotSupported, RequestRefused, Trajectory
from rapidgen.client.address import Address
from rapidgen.client.flows.control import ask
from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.generate import build, make_system
from rapidgen.testing.asyncio_clock import run
from rapidgen.verification.egm_partner import GuidingPartner
from rapidgen.wire.simple_message.messages import EgmRequest
from rapidgen.wire.simple_message.spec import Reason, TrajectoryState

CONFIGS = {
    "without": load_config("irb120"),
    "six": load_config("robots/examples/irb120_egm-rw6.yaml"),
    "seven": load_config("robots/examples/crb15000_egm-rw7.yaml"),
}
SYSTEMS = {name: make_system(config, build(config)) for name, config in CONFIGS.items()}


class Session:
    """A partner without a process: the heartbeat of its datagrams is that of the client."""

    def __init__(self, partner):
        self.partner = partner

    def write(self, numbers):
        """Send other numbers from now on."""
        (self.partner.heartbeat,) = numbers

    async def wait_until_guided(self):
        """Wait for the first frame in which the robot is guided."""
        while not (self.partner.frames and self.partner.frames[-1][1].running):
            await asyncio.sleep(0.004)


@pytest.fixture
def guide(monkeypatch):
    """Runs a coroutine function with a connected robot and its partner."""

    def guide(name, use, driver=""):
        config = CONFIGS[name]
        with VirtualController(SYSTEMS[driver or name], config.groups) as controller:
            partner = GuidingPartner(lambda: controller.scheduler.now * 1e-9, heartbeats=False)
            controller.egm.connect("ROS_EGM", partner)
            controller.run_for(2.0)

            @asynccontextmanager
            async def listen(*_, **__):
                yield Session(partner)

            monkeypatch.setattr(rapidgen.client.egm, "listen_async", listen)

            async def main():
                address = Address("controller", 11000, 11002)
                async with AsyncRobot(config, address=address) as robot:
                    await use(robot, partner)

            run(controller, main())

    return guide


def progress(robot):
    return robot._core.state_port.progress


@pytest.mark.parametrize("name", ["six", "seven"])
def test_a_session_lasts_as_long_as_its_block(guide, name):
    async def use(robot, partner):
        for number in (1, 2):
            async with robot.egm():
                await asyncio.sleep(3.0)
                assert partner.frames[-1][1].running
                assert progress(robot).state == TrajectoryState.MOVING
            assert (progress(robot).trajectory, progress(robot).state) == (
                number,
                TrajectoryState.DONE,
            )
        assert partner.sessions == 2
        result = await robot.execute(Trajectory.from_points([[0.0] * 6, [0.1] * 6], seconds=1.0))
        await result.result()

    guide(name, use)


def test_a_stop_ends_the_session_and_the_block_goes_on(guide):
    async def use(robot, partner):
        async with robot.egm() as session:
            await asyncio.sleep(0.5)
            assert session.explain() == ""
            await robot.stop()
            assert session.explain() == "the driver reports STOPPED (stopped on request)"
        assert progress(robot).reason == Reason.STOPPED

    guide("seven", use)


def test_an_error_of_the_block_ends_the_session(guide):
    async def use(robot, partner):
        with pytest.raises(KeyError):
            async with robot.egm():
                raise KeyError("of the caller")
        await asyncio.sleep(1.0)
        assert progress(robot).state == TrajectoryState.DONE

    guide("seven", use)


def test_motions_and_sessions_exclude_each_other(guide):
    path = Trajectory.from_points([[0.0] * 6, [0.3] * 6], seconds=2.0)

    async def use(robot, partner):
        async with robot.egm():
            with pytest.raises(NotReady, match="session"):
                await robot.execute(path)
        execution = await robot.execute(path)
        with pytest.raises(NotReady):
            async with robot.egm():
                pass
        assert (await execution.result()).deviation < 1e-3

    guide("seven", use)


def test_slow_heartbeats_are_rejected(guide):
    async def use(robot, partner):
        robot._core.begin_guidance(5.0, None)
        await asyncio.sleep(0.5)
        request = ask(robot._core, EgmRequest(1), "start a session")
        with pytest.raises(RequestRefused) as caught:
            await robot._runner.run(request)
        assert caught.value.reason is Reason.NO_HEARTBEAT

    guide("six", use)


@pytest.mark.parametrize(("name", "driver"), [("without", ""), ("six", "without")])
def test_without_egm_a_session_is_not_supported(guide, name, driver):
    async def use(robot, partner):
        with pytest.raises(NotSupported, match="RG624"):
            async with robot.egm():
                pass
        assert not partner.frames

    guide(name, use, driver)
