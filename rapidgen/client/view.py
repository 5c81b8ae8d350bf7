"""What the handles of both clients tell without waiting."""

from collections.abc import Sequence

from rapidgen.client.run import Run
from rapidgen.client.state import State
from rapidgen.client.trajectory import Trajectory
from rapidgen.diagnostics import Diagnostic


class View:
    """A run as its caller may look at it."""

    def __init__(self, run: Run) -> None:
        self._run = run
        self._stopped: State | None = None

    @property
    def trajectory(self) -> Trajectory:
        """What was asked for, in the robot's order of joints."""
        return self._run.plan.trajectory

    @property
    def warnings(self) -> Sequence[Diagnostic]:
        """What the checks noted."""
        return self._run.plan.warnings

    @property
    def planned_seconds(self) -> float:
        """Seconds that the controller was asked to take."""
        return self._run.plan.total

    @property
    def is_over(self) -> bool:
        """Whether the result is there, good or bad."""
        return self._run.is_over

    @property
    def stopped_position(self) -> tuple[float, ...] | None:
        """Joints where the robot stood at the end; None while it moves or when nobody saw it."""
        if self._run.result is not None:
            return self._run.result.state.joints
        if self._stopped is not None:
            return self._stopped.joints
        error = self._run.error
        return error.states[-1].joints if error is not None and error.states else None
