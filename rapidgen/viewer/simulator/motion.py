"""Robots of a virtual controller: appearance and positions."""

from collections.abc import Iterable, Mapping

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Posture
from rapidgen.axes.limits import outside
from rapidgen.controller.runner import ControllerRunner
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.moves import MoveFrames
from rapidgen.runtime.task.task import Task
from rapidgen.viewer.appearance import PLAIN, Appearance
from rapidgen.viewer.messages import (
    Copy,
    Jog,
    JogBy,
    JogTo,
    Positions,
    Request,
    RobotPlace,
    Scene,
    ToPage,
)
from rapidgen.viewer.pose_snippets import copied
from rapidgen.viewer.primitive_urdf import Drawing
from rapidgen.viewer.provider import Handler, RequestRejected
from rapidgen.viewer.robots import ToolAndWorkObject, pose_of, side_by_side


class MotionProvider:
    """The scene, positions, and jogging of the robots."""

    def __init__(self, runner: ControllerRunner, look: Appearance = PLAIN) -> None:
        self._controller = runner.controller
        self._look = look
        self._scheduler = runner.controller.scheduler
        self._groups = tuple(self._controller.motion.groups.values())
        self._drawings = tuple(look.of(group.config) for group in self._groups)
        self._last_sent: tuple[RobotPlace, ...] = ()
        self._last: dict[str, MoveFrames] = {}

    def whole(self) -> Iterable[ToPage]:
        """Return the scene and the positions."""
        configs = [group.config for group in self._groups]
        yield Scene(
            title=self._controller.system.name,
            kind="simulation",
            may_command=True,
            groups=tuple(side_by_side(configs, self._drawings)),
            things=self._look.things,
            faults=self._look.faults,
        )
        yield self._state(self._now())

    def changes(self) -> Iterable[ToPage]:
        """Return positions if one has changed."""
        now = self._now()
        if now != self._last_sent:
            self._last_sent = now
            yield self._state(now)

    def handlers(self) -> Mapping[type, Handler]:
        """Handlers of jogging, and of positions as text."""
        return {Jog: self._jog, JogTo: self._jog_to, JogBy: self._jog_by, Copy: self._copy}

    def _state(self, groups: tuple[RobotPlace, ...]) -> Positions:
        return Positions(time=self._controller.now, groups=groups)

    def _now(self) -> tuple[RobotPlace, ...]:
        blocked = self._blocked()
        return tuple(
            self._of(group, drawing, blocked)
            for group, drawing in zip(self._groups, self._drawings, strict=True)
        )

    def _of(self, group: MotionGroup, drawing: Drawing, blocked: str) -> RobotPlace:
        actual = group.positions()
        carried = self._carried(group)
        tcp = carried.tcp(group.kinematics, actual)
        return RobotPlace(
            joints=drawing.values(group.map.to_urdf(actual)),
            commanded=drawing.values(group.map.to_urdf(group.reference())),
            axes=actual,
            tcp=None if tcp is None else pose_of(tcp),
            tool=pose_of(carried.tool),
            tool_held=carried.held,
            work_object=pose_of(carried.object),
            standing=group.is_standing,
            blocked=blocked,
        )

    def _carried(self, group: MotionGroup) -> ToolAndWorkObject:
        carrier = self._carrier(group)
        if carrier is None:
            return ToolAndWorkObject.configured(group.config)
        now = carrier.at(group.positions())
        return ToolAndWorkObject(now.tool, not now.stationary, now.object)

    def _carrier(self, group: MotionGroup) -> MoveFrames | None:
        """Tool and work object of the last move, also of a dropped path.

        A jog drops the path.
        """
        move = group.motion.move(self._scheduler.now)
        if move is not None:
            self._last[group.name] = move.carrier
        return self._last.get(group.name)

    def _tasks(self) -> Iterable[Task]:
        return self._controller.rapid_tasks.values()

    def _jog(self, request: Request) -> str:
        assert isinstance(request, Jog)
        group = self._group(request.group)
        joints = group.config.joints
        if len(request.axes) != len(joints):
            raise RequestRejected(f"{group.name} has {len(joints)} axes")
        current = group.positions()
        axes = tuple(
            now if own is None else now + own if request.relative else own
            for own, now in zip(request.axes, current, strict=True)
        )
        self._put(group, axes)
        return ""

    def _jog_to(self, request: Request) -> str:
        assert isinstance(request, JogTo)
        group, tcp, carried = self._tcp(request.group)
        outer = carried.object if request.frame == "work_object" else frames.IDENTITY
        now = frames.within(outer, tcp)
        turned = request.orientation or now[1]
        if not any(turned):
            raise RequestRejected("this is not an orientation")
        x, y, z = (
            own if own is not None else at for own, at in zip(request.position, now[0], strict=True)
        )
        place = ((x, y, z), frames.normalise(turned))
        self._put_tcp(group, frames.compose(outer, place), carried)
        return ""

    def _jog_by(self, request: Request) -> str:
        assert isinstance(request, JogBy)
        group, tcp, carried = self._tcp(request.group)
        turned = {"base": frames.UNIT, "tool": tcp[1], "work_object": carried.object[1]}
        unit = [0.0, 0.0, 0.0]
        unit[request.axis] = 1.0
        axis = frames.rotate(turned[request.frame], (unit[0], unit[1], unit[2]))
        place = frames.add(tcp[0], frames.scale(axis, request.distance))
        orientation = frames.multiply(frames.about(axis, request.angle), tcp[1])
        self._put_tcp(group, (place, frames.normalise(orientation)), carried)
        return ""

    def _tcp(self, name: str) -> tuple[MotionGroup, frames.Pose, ToolAndWorkObject]:
        """Return a robot, its TCP in the world, tool and work object."""
        group = self._group(name)
        carried = self._carried(group)
        now = carried.tcp(group.kinematics, group.positions())
        if group.kinematics is None or now is None or not carried.held:
            raise RequestRejected(f"{group.name} does not carry its TCP")
        return group, now, carried

    def _put_tcp(self, group: MotionGroup, tcp: frames.Pose, carried: ToolAndWorkObject) -> None:
        assert group.kinematics is not None
        flange = frames.compose(tcp, frames.invert(carried.tool))
        result = group.kinematics.follow(flange, group.positions())
        if result is None:
            raise RequestRejected("the TCP does not reach that place as the arm is bent now")
        self._put(group, result)

    def _blocked(self) -> str:
        """Return the reason why no robot can be jogged now; empty if they can."""
        if any(t.state == "running" and t.spec.motion for t in self._tasks()):
            return "a program controls the robot: stop it first"
        return ""

    def _put(self, group: MotionGroup, axes: Posture) -> None:
        for fault in outside(group.config.joints, axes):
            raise RequestRejected(f"{fault.joint.name} would leave its range")
        if why := self._blocked():
            raise RequestRejected(why)
        self._carrier(group)  # Stored, because the path may be dropped.
        try:
            group.jog(axes)
        except ValueError as error:
            raise RequestRejected(str(error)) from error

    def _copy(self, request: Request) -> str:
        assert isinstance(request, Copy)
        group = self._group(request.group)
        posture, carried = group.positions(), self._carried(group)
        return copied(request, group.map, group.kinematics, posture, carried)

    def _group(self, name: str) -> MotionGroup:
        group = self._controller.motion.groups.get(name)
        if group is None:
            raise RequestRejected(f"there is no robot {name}")
        return group
