"""A virtual controller as the page's subject, over its restarts."""

from collections.abc import Callable

from rapidgen.controller.runner import ControllerRunner
from rapidgen.viewer.appearance import PLAIN, Appearance
from rapidgen.viewer.provider import StateProvider
from rapidgen.viewer.simulator.connections import ConnectionsProvider
from rapidgen.viewer.simulator.editor_place import EditorPlaceProvider
from rapidgen.viewer.simulator.motion import MotionProvider
from rapidgen.viewer.simulator.operator_output import OperatorOutputProvider
from rapidgen.viewer.simulator.pendant import PendantProvider
from rapidgen.viewer.simulator.program import ProgramProvider
from rapidgen.viewer.simulator.signals import SignalsProvider
from rapidgen.viewer.simulator.targets import TargetsProvider
from rapidgen.viewer.simulator.trajectories import TrajectoryProvider

ASPECTS: tuple[Callable[[ControllerRunner], StateProvider], ...] = (
    PendantProvider,
    OperatorOutputProvider,
    SignalsProvider,
    ConnectionsProvider,
    TrajectoryProvider,
    ProgramProvider,
    TargetsProvider,
    EditorPlaceProvider,
)
"""Providers of a virtual controller's state after the scene."""


class Simulation:
    """Subject of the server: `serve_page(Simulation(runner))`."""

    def __init__(self, runner: ControllerRunner, look: Appearance = PLAIN) -> None:
        self._runner = runner
        self._look = look

    def post(self, function: Callable[[], None]) -> bool:
        """Run a function on the controller's thread; False while it restarts."""
        return self._runner.post(function)

    def aspects(self) -> tuple[StateProvider, ...]:
        """Providers of the running controller."""
        scene = MotionProvider(self._runner, self._look)
        others = tuple(make(self._runner) for make in ASPECTS)
        if self._runner.controller.collisions is None:
            return (scene, *others)
        # Without detection nothing of it is imported.
        from rapidgen.viewer.simulator.collisions import CollisionProvider

        return (scene, *others, CollisionProvider(self._runner, self._look))
