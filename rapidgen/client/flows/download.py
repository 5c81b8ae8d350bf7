"""Download of a trajectory: points, end frame, and the reply."""

from rapidgen.client.core.checks import CheckedTrajectory
from rapidgen.client.core.job import Job
from rapidgen.client.core.robot import Core
from rapidgen.client.errors import RobotError
from rapidgen.client.flows.effects import INTERRUPTIONS, Flow, Send, Wait
from rapidgen.client.flows.stop import PER_POINT, ended, stop
from rapidgen.wire.simple_message.messages import JOINT_TRAJ_PT
from rapidgen.wire.simple_message.numpy_codec import FRAME_BYTES, encode_trajectory
from rapidgen.wire.simple_message.spec import Port


def download(core: Core, checked: CheckedTrajectory) -> Flow[Job]:
    """Send all; return when the controller has accepted it.

    The robot moves only then.
    """
    sending = DownloadInProgress(core, checked)
    try:
        yield from sending.points()
        yield from sending.end()
        yield from sending.accepted()
    except INTERRUPTIONS:
        yield from stop(core)
        raise
    except RobotError as error:
        sending.motion.failed(error)
        raise (yield from ended(core, sending.motion)) from error.__cause__
    return sending.job()


class DownloadInProgress:
    """A trajectory being downloaded, in three steps."""

    def __init__(self, core: Core, checked: CheckedTrajectory) -> None:
        self._core = core
        self._data = encode_trajectory(checked.wire, checked.durations)
        self.motion = core.begin(checked)

    def points(self) -> Flow[None]:
        """Send all but the end frame: the robot does not move yet."""
        yield self._send(self._data[:-FRAME_BYTES])

    def end(self) -> Flow[None]:
        """Send the end frame: the controller may begin to move."""
        self.motion.asked(self._core.ports[Port.MOTION].request(JOINT_TRAJ_PT.number))
        yield self._send(self._data[-FRAME_BYTES:])

    def _send(self, data: bytes) -> Send:
        return Send(Port.MOTION, data, self._core.timeouts.send, motion=self.motion)

    def accepted(self) -> Flow[None]:
        """Wait for the controller's reply to the whole trajectory."""
        core, motion = self._core, self.motion
        timeout = core.timeouts.reply + PER_POINT * motion.frames
        yield Wait(lambda: motion.is_taken or motion.is_over, timeout)
        if motion.is_taken:
            return
        if motion.error is not None:
            raise motion.error
        raise core.state_port.late(
            f"the controller did not answer within {timeout:.1f} s if it accepted the trajectory",
            "a STOP was sent; look at the robot",
        )

    def job(self) -> Job:
        """The active job."""
        job = Job(self._core)
        job.take(self.motion)
        return job
