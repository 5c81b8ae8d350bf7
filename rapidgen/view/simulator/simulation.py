"""A virtual controller that is viewed, over its restarts."""

from collections.abc import Callable

from rapidgen.controller.cabinet import Cabinet
from rapidgen.view.appearance import PLAIN, Appearance
from rapidgen.view.aspect import Aspect
from rapidgen.view.simulator.connections import ConnectionsAspect
from rapidgen.view.simulator.motion import MotionAspect
from rapidgen.view.simulator.pendant import PendantAspect
from rapidgen.view.simulator.program import ProgramAspect
from rapidgen.view.simulator.signals import SignalsAspect
from rapidgen.view.simulator.targets import TargetsAspect
from rapidgen.view.simulator.telling import TellingAspect
from rapidgen.view.simulator.trajectories import TrajectoryAspect

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
