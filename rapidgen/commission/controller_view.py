"""The controller's own view of the robot, which does not pass through the driver."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from rapidgen.axes.frames import Pose
from rapidgen.axes.mapping import JointMap
from rapidgen.config.model import GroupConfig

if TYPE_CHECKING:
    from rapidgen.client.rws import AsyncController

_MM = 0.001


@dataclass(frozen=True, slots=True)
class PanelState:
    """Mode (`AUTO`, `MANR`, `MANF`), speed override in percent, identity."""

    mode: str
    speed: int
    robotware: str
    is_virtual: bool


class ControllerView(Protocol):
    """Readings of a controller. Nothing here changes it."""

    async def axes(self) -> tuple[float, ...]:
        """Return the axis values in wire order, rad and m."""

    async def flange(self) -> Pose:
        """Return the pose of tool0 in the world frame, m."""

    async def panel(self) -> PanelState:
        """Return the state of the panel."""


class WebServicesView:
    """Readings over Robot Web Services. Raises as `AsyncController`."""

    def __init__(self, controller: "AsyncController", group: GroupConfig) -> None:
        self._controller = controller
        self._map = JointMap.of(group)
        self._unit = group.mechanical_unit

    async def axes(self) -> tuple[float, ...]:
        """Return the axis values in wire order, rad and m."""
        target = await self._controller.joint_target(self._unit)
        return self._map.from_rapid(target.robax, target.extax, [0.0] * len(self._map.joints))

    async def flange(self) -> Pose:
        """Return the pose of tool0 in the world frame, m."""
        target = await self._controller.rob_target(self._unit, tool="tool0", wobj="wobj0")
        x, y, z = (value * _MM for value in target.trans)
        q1, q2, q3, q4 = target.rot
        return (x, y, z), (q1, q2, q3, q4)

    async def panel(self) -> PanelState:
        """Return the state of the panel."""
        panel = await self._controller.panel()
        identity = await self._controller.identity()
        return PanelState(panel.mode, panel.speed, identity.robotware, identity.is_virtual)
