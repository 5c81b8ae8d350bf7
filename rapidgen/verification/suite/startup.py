"""Start of a driver: modules of other builds, and earlier activity."""

from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import POINT_BYTES, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.raw_connection import raw_point
from rapidgen.verification.stream import BEGIN, Streamer
from rapidgen.verification.testbench import Bench, with_module

case = SuiteGroup("controller")


@case("one-module-of-another", "a module of another build that several tasks load")
def _one_other(bench: Bench) -> None:
    """Load another build into each task: only that task reports it."""
    tasks = [t for t in bench.system.tasks if t.mechanical_unit_group == bench.mechanical_unit]
    build = bench.system.build_id.encode()
    # A module that several tasks load.
    path, data = next((m.path, m.data) for t in tasks for m in t.modules if m.name == "ROS_server")
    with bench.second_controller(
        with_module(bench.system, path, data.replace(build, b"0123456789ab"))
    ) as other:
        watcher, link = other.watcher(), other.motion()
        other.run(0.3)
        events = [" ".join(e.texts) for e in other.controller.log if "different builds" in str(e)]
        expected = [f"Task {t.name}," for t in tasks if any(m.path == path for m in t.modules)]
        if len(events) != len(expected) or not all(any(w in e for e in events) for w in expected):
            raise CheckFailed(f"{path} is of another build, the event log says {events}")
        link.send(raw_point(-1, other.position, 1.0))
        other.run(0.3)
        reply = other.progress(watcher)
        if (reply.state, reply.reason) != (RawTrajectoryState.REFUSED, RawReason.BUILD_MISMATCH):
            raise CheckFailed(f"{path} is of another build, PROGRESS says {reply}")
        if other.status(watcher).motion_possible:
            raise CheckFailed("modules of several builds: STATUS says that motion is possible")


@case("power-returns", "a power failure while a trajectory is received", needs="stream")
def _power_returns(bench: Bench) -> None:
    """Fail power during reception or before motion: the data is discarded."""
    for streaming in (False, True):
        link, watcher = bench.motion(), bench.watcher()
        if streaming:
            stream = Streamer(bench, link)
            stream.put(bench.wave(2), BEGIN)
        else:
            link.send(bench.download(bench.wave(5))[: 3 * (POINT_BYTES)])
        bench.run(0.2)
        number = bench.progress(watcher).trajectory
        bench.controller.perform("power-loss")
        bench.assert_at_rest(0.2, "the power has failed")
        bench.start_again()
        bench.assert_at_rest(0.8, "the power came back")
        watcher, link = bench.watcher(), bench.motion()
        reply, status = bench.progress(watcher), bench.status(watcher)
        if reply.trajectory != number or reply.state in (
            RawTrajectoryState.RECEIVING,
            RawTrajectoryState.MOVING,
        ):
            raise CheckFailed(f"trajectory {number} was there when the power failed: {reply}")
        if status.motion_possible != 1 or status.in_motion:
            raise CheckFailed(f"the power came back, STATUS says {status}")
        link.send(bench.download(bench.wave(5))[3 * (POINT_BYTES) :])
        bench.assert_at_rest(0.5, "half of it came before the power failed")
        bench.assert_moves_through(link, bench.wave(2))
        link.close()
        watcher.close(then=0.1)
