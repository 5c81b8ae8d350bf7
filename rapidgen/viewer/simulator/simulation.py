"""A virtual controller that is viewed, over its restarts."""

from collections.abc import Callable

from rapidgen.controller.runner import Cabinet
from rapidgen.viewer.appearance import PLAIN, Appearance
from rapidgen.viewer.provider import Aspect
from rapidgen.viewer.simulator.connections import ConnectionsAspect
from rapidgen.viewer.simulator.motion import MotionAspect
from rapidgen.viewer.simulator.operator_output import TellingAspect
from rapidgen.viewer.simulator.pendant import PendantAspect
from rapidgen.viewer.simulator.program import ProgramAspect
from rapidgen.viewer.simulator.signals import SignalsAspect
from rapidgen.viewer.simulator.targets import TargetsAspect
from rapidgen.viewer.simulator.trajectories import TrajectoryAspect

ASPECTS: tuple[Callable[[Cabinet], Aspect], ...] = (
    PendantAspect,
    TellingAspect,
    SignalsAspect,
    ConnectionsAspect,
    TrajectoryAspect,
    ProgramAspect,
    TargetsAspect,
)
"""What is told of a virtual controller after the scene."""


class Simulation:
    """What the server watches: `serve_page(Simulation(cabinet))`."""

    def __init__(self, cabinet: Cabinet, look: Appearance = PLAIN) -> None:
        self._cabinet = cabinet
        self._look = look

    def post(self, function: Callable[[], None]) -> bool:
        """Run a function on the controller's thread; False while it restarts."""
        return self._cabinet.post(function)

    def aspects(self) -> tuple[Aspect, ...]:
        """Topics of the controller that runs now."""
        scene = MotionAspect(self._cabinet, self._look)
        return (scene, *(make(self._cabinet) for make in ASPECTS))
