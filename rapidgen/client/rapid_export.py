"""Programs and trajectories as RAPID modules that run without rapidgen.

`Program.to_rapid` and `Trajectory.to_rapid` call this module. A program is first checked against
the robot as before a run, so that the module contains only moves that are possible. Then each
instruction becomes one of RAPID:

- The end of a move is its checked posture. Targets with a pose get its configuration and external
  axes from this posture.
- Where the driver would stop the robot (before a wait, a signal, another tool), the module has a
  stop point.
- An arm whose configurations no public source confirms begins with MoveAbsJ and moves its axes
  with MoveAbsJ only; a warning and the header say so.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import degrees
from os import PathLike
from typing import TYPE_CHECKING, Literal, TypeAlias, cast

from rapidgen import __version__
from rapidgen.axes.configuration import configuration_data, family_of
from rapidgen.axes.default_postures import usual_start
from rapidgen.axes.frames import Pose, compose, normalise
from rapidgen.axes.kinematics import Kinematics, Posture
from rapidgen.client.core.checks import DriverLimits, check_trajectory
from rapidgen.client.core.frames import Frames
from rapidgen.client.core.group import Group
from rapidgen.client.core.program_checks import CheckedProgram, check_program
from rapidgen.client.errors import InvalidProgram, InvalidTarget
from rapidgen.client.pose import pose_of
from rapidgen.client.program import (
    FINE,
    Argument,
    Program,
    ProgramStep,
    Trigger,
    UserTool,
    UserWorkObject,
    Zone,
    ZoneLike,
    joints_of,
    zone_of,
)
from rapidgen.config import load_config
from rapidgen.config.model import GroupConfig, Placement, RobotConfig, RoutineParameter
from rapidgen.config.model import Load as ConfigLoad
from rapidgen.diagnostics import Diagnostic, Severity, Span, error, suggest
from rapidgen.export import description as rapid
from rapidgen.export.writer import ExportedModule, WriterOptions, check_module, write_module
from rapidgen.wire.simple_message.spec import Instruction, MarkPlace

if TYPE_CHECKING:
    from rapidgen.client.trajectory import Trajectory

MoveKind: TypeAlias = Literal["AbsJ", "J", "L", "C"]
_MM = 1000.0
_MOVES: dict[Instruction, MoveKind] = {
    Instruction.MOVE_ABSJ: "AbsJ",
    Instruction.MOVE_J: "J",
    Instruction.MOVE_L: "L",
    Instruction.MOVE_C: "C",
}
_REFERENCES: dict[MarkPlace, rapid.Reference] = {
    MarkPlace.START: "start",
    MarkPlace.END: "end",
    MarkPlace.TIME: "time",
}
_MOST = 10_000_000
"""Instructions of one program."""


def robot_of(
    robot: RobotConfig | str | PathLike[str], group: str = ""
) -> tuple[RobotConfig, GroupConfig]:
    """Return a configuration and one of its groups; the first by default.

    Raises DiagnosticError for a configuration with faults, InvalidTarget for another group.
    """
    config = robot if isinstance(robot, RobotConfig) else load_config(str(robot))
    names = [each.name for each in config.groups]
    if group and group not in names:
        raise InvalidTarget.because(
            "RG607",
            f"{config.name} has no motion group '{group}'",
            suggest(group, names) or f"it has: {', '.join(names)}",
            exit_code=2,
        )
    return config, config.groups[names.index(group) if group else 0]


def export_program(
    program: Program,
    config: RobotConfig,
    group: GroupConfig,
    *,
    module: str,
    routine: str,
    start: Sequence[float] | None,
    options: WriterOptions,
    spans: Sequence[Span] = (),
    header: Sequence[str] = (),
) -> ExportedModule:
    """Write a program as a module.

    `start` are joints (URDF) where the robot stands before it; None: the first position of the
    program if it begins with `move_joints`, else the robot's usual start. `spans` are the places
    of the instructions in their source. Raises InvalidProgram with all faults, DiagnosticError
    for names and for text that is no RAPID.
    """
    complete = Group.of(config, group)
    begin = _start(program, complete, group, start)
    checked = check_program(program, complete, start=begin, most=_MOST, spans=spans)
    converter = _Converter(config, group, complete, checked)
    instructions = converter.instructions()
    described = converter.routine(module, routine, instructions, header, begin)
    written = write_module(described, options)
    found = [d for d in check_module(written) if d.severity is not Severity.INFO]
    lines = tuple(written.lines[i] for i in converter.places)
    return ExportedModule(
        written,
        described,
        config,
        group,
        complete.map.to_urdf(begin),
        lines,
        (*checked.notes, *converter.notes, *found),
        tuple(spans),
    )


def export_trajectory(
    trajectory: "Trajectory",
    config: RobotConfig,
    group: GroupConfig,
    *,
    module: str,
    routine: str,
    zone: ZoneLike,
    options: WriterOptions,
    header: Sequence[str] = (),
) -> ExportedModule:
    """Write a trajectory as MoveAbsJ to its points, with their times (\\T).

    The first point is approached at 100 mm/s. Raises InvalidTrajectory with all faults.
    """
    complete = Group.of(config, group)
    points = trajectory.positions
    begin = (
        complete.to_wire(trajectory.reordered(complete.names).positions[:1])[0]
        if (not complete.name_faults(trajectory.names, points.shape[1]) and len(points))
        else None
    )
    start = None if begin is None else tuple(begin.tolist())
    limits = DriverLimits(_MOST, goes_to_single=True)
    checked = check_trajectory(trajectory, complete, limits, "download", start=start)
    on_path, to_rapid = _zone(zone_of(zone)), complete.map.to_rapid
    tool, wobj = group.tool.name, group.work_object.name
    approach, timed = rapid.Speed(100.0), rapid.Speed(1000.0)
    moves = [
        rapid.Move(
            "AbsJ",
            rapid.JointTarget(*to_rapid(row)),
            timed if number else approach,
            on_path if 0 < number < len(trajectory) - 1 else rapid.FINE,
            tool,
            wobj,
            seconds=seconds if number else 0.0,
        )
        for number, (row, seconds) in enumerate(
            zip(checked.wire.tolist(), checked.durations.tolist(), strict=True)
        )
        if number < len(trajectory)
    ]
    converter = _Converter(config, group, complete, None)
    converter.declare_group_data()
    described = converter.routine(module, routine, moves, header, checked.wire[0].tolist())
    written = write_module(described, options)
    found = [d for d in check_module(written) if d.severity is not Severity.INFO]
    urdf = complete.map.to_urdf(checked.wire[0].tolist())
    notes = (*checked.warnings, *found)
    spans = tuple(Span(trajectory.path, line, 1) for line in trajectory.lines)
    return ExportedModule(written, described, config, group, urdf, written.lines, notes, spans)


def _start(
    program: Program, group: Group, config: GroupConfig, start: Sequence[float] | None
) -> Posture:
    if start is not None:
        if len(start) != len(group.names):
            raise InvalidProgram.because(
                "RG670",
                f"{len(start)} values for a start, the robot has {len(group.names)} joints",
                f"rad and m, of {', '.join(group.names)}",
                exit_code=2,
            )
        return group.map.to_controller(tuple(map(float, start)))
    first = next((step for step in program.steps if step.kind in _MOVES), None)
    if first is not None and len(first.joints) == len(group.names):
        return group.map.to_controller(first.joints)
    return usual_start(config)


def _header(config: RobotConfig, group: GroupConfig, start: Sequence[float]) -> list[str]:
    names = [joint.name for joint in group.joints]
    values = ", ".join(
        f"{name} {degrees(value):.2f} deg" if joint.kind == "revolute" else f"{value * _MM:.2f} mm"
        for name, value, joint in zip(names, start, group.joints, strict=True)
    )
    robot = f"{config.name}, {group.model or 'robot without a model'}, {group.task}"
    return [f"Robot: {robot}. Written by rapidgen {__version__}.", f"Start: {values}."]


class _Converter:
    """Converts checked instructions to RAPID's."""

    def __init__(
        self,
        config: RobotConfig,
        group: GroupConfig,
        complete: Group,
        checked: CheckedProgram | None,
    ) -> None:
        self.config, self.group, self.complete = config, group, complete
        self.postures = checked.postures if checked is not None else []
        self.steps = checked.program.steps if checked is not None else []
        self.notes: list[Diagnostic] = []
        self.places: list[int] = []
        """Index of the RAPID instruction of each step."""
        self._kinematics = Kinematics.of(group)
        self._tools: dict[str, rapid.ToolData] = {}
        self._objects: dict[str, rapid.WorkObjectData] = {}
        self._own: dict[UserTool | UserWorkObject, str] = {}
        self._header: list[str] = []
        self._kinds = {signal.name: signal.kind for signal in config.signals}
        self._only_joints = self._kinematics is None or not family_of(self._kinematics).has_evidence

    def routine(
        self,
        module: str,
        name: str,
        instructions: Sequence[rapid.Instruction],
        header: Sequence[str],
        begin: Posture,
    ) -> rapid.Routine:
        """Return the description of the module."""
        payload = self.group.payload
        first = _header(self.config, self.group, self.complete.map.to_urdf(begin))
        return rapid.Routine(
            module,
            name,
            tuple(instructions),
            tuple(self._tools.values()),
            tuple(self._objects.values()),
            payload.name if payload.name != "load0" else "",
            payload.with_moves,
            (*first, *header, *self._header),
        )

    def declare_group_data(self) -> None:
        """Declare tool and work object of the group."""
        self._tool("")
        self._object("")

    def instructions(self) -> list[rapid.Instruction]:
        """Return the instructions of the whole program."""
        result: list[rapid.Instruction] = []
        moves = [step for step in self.steps if step.kind in _MOVES]
        if self._only_joints and any(step.kind is not Instruction.MOVE_ABSJ for step in moves):
            self._say_only_joints()
        if moves and moves[0].kind in (Instruction.MOVE_L, Instruction.MOVE_C):
            # Nothing else brings the arm into the posture that was checked.
            begin = replace(moves[0], zone=FINE, triggers=())
            result.append(self._move_joints(begin, self.postures[0]))
            self._header.append("The first instruction moves all axes to the start.")
        for number, step in enumerate(self.steps):
            self.places.append(len(result))
            following = self.steps[number + 1] if number + 1 < len(self.steps) else None
            result.append(self._instruction(number, step, following))
        return result

    def _instruction(
        self, number: int, step: ProgramStep, following: ProgramStep | None
    ) -> rapid.Instruction:
        kind = step.kind
        if kind in _MOVES:
            if self._stops(step, following):
                step = replace(step, zone=FINE)
            return self._move(step, self.postures[number + 1])
        if kind is Instruction.WAIT:
            return rapid.Wait(step.seconds)
        if kind is Instruction.WAIT_SIGNAL:
            return rapid.WaitSignal(step.signal, self._kinds[step.signal], step.value, step.seconds)
        if kind is Instruction.SET:
            return rapid.SetSignal(step.signal, self._kinds[step.signal], step.value)
        if kind is Instruction.SETTINGS:
            bits = int(step.value)
            return rapid.PathMode(bool(bits & 1), bool(bits & 2))
        if kind is Instruction.CALL:
            return self._call(step, self.postures[number])
        # Declarations stand at the top of the module; a comment keeps their place.
        assert step.own is not None, "TOOL and WORK_OBJECT have values"
        what = "Tool" if isinstance(step.own, UserTool) else "Work object"
        return rapid.Comment(f"{what} {self._named(step.own)} from here.")

    def _stops(self, step: ProgramStep, following: ProgramStep | None) -> bool:
        """True if the driver would stop at the end of a move, whatever its zone."""
        if following is None or following.kind not in _MOVES:
            return True
        return self._frame_names(step) != self._frame_names(following)

    # -- moves ------------------------------------------------------------------------------------

    def _move(self, step: ProgramStep, posture: Posture) -> rapid.Move:
        by_joints = self._only_joints and step.kind is Instruction.MOVE_J
        if (step.kind is Instruction.MOVE_ABSJ or by_joints) and not step.triggers:
            return self._move_joints(step, posture)
        # Signals on the path of a move to joints need the pose of the joints.
        pose = self._frames(step).pose(posture) if step.pose is None else step.pose
        kind: MoveKind = "J" if step.pose is None else _MOVES[step.kind]
        target = self._target(pose, posture)
        via = None if step.via is None else self._target(step.via, posture)
        return self._as_move(step, kind, target, via)

    def _move_joints(self, step: ProgramStep, posture: Posture) -> rapid.Move:
        target = rapid.JointTarget(*self.complete.map.to_rapid(posture))
        return self._as_move(step, "AbsJ", target, None)

    def _as_move(
        self,
        step: ProgramStep,
        kind: MoveKind,
        target: rapid.Target,
        via: rapid.RobTarget | None,
    ) -> rapid.Move:
        tool, wobj = self._frame_names(step)
        speed = step.speed
        return rapid.Move(
            kind,
            target,
            rapid.Speed(
                _rounded(speed.tcp * _MM),
                _rounded(degrees(speed.orientation)),
                _rounded(speed.linear * _MM),
                _rounded(degrees(speed.rotary)),
            ),
            _zone(step.zone),
            tool,
            wobj,
            via,
            tuple(self._trigger(trigger) for trigger in step.triggers),
        )

    def _target(self, pose: Pose, posture: Posture) -> rapid.RobTarget:
        kinematics = self._kinematics
        assert kinematics is not None, "poses were checked with the geometry"
        (x, y, z), q = pose[0], normalise(pose[1])
        if q[0] < 0:
            q = (-q[0], -q[1], -q[2], -q[3])
        data = configuration_data(kinematics, posture)
        place = (x * _MM, y * _MM, z * _MM)
        return rapid.RobTarget(place, q, data.configuration, data.external)

    def _frames(self, step: ProgramStep) -> Frames:
        geometry = self.complete.geometry
        tool = self.group.tool.name if step.tool == "" else step.tool
        wobj = self.group.work_object.name if step.work_object == "" else step.work_object
        own_tool = own_object = None
        if isinstance(tool, UserTool):
            own_tool = pose_of(tool.frame)
        if isinstance(wobj, UserWorkObject):
            own_object = compose(pose_of(wobj.user_frame), pose_of(wobj.object_frame))
        assert geometry is not None, "poses were checked with the geometry"
        geometry = geometry.owning(own_tool, own_object)
        tools, objects = [n for n, _ in geometry.tools], [n for n, _ in geometry.work_objects]
        frames = geometry.frames(
            tools.index(tool if isinstance(tool, str) else ""),
            objects.index(wobj if isinstance(wobj, str) else ""),
        )
        assert frames is not None, "poses were checked with the geometry"
        return frames

    def _trigger(self, trigger: Trigger) -> rapid.Trigger:
        reference = _REFERENCES[trigger.kind]
        place = trigger.place if reference == "time" else _rounded(trigger.place * _MM)
        kind = self._kinds[trigger.signal]
        return rapid.Trigger(trigger.signal, kind, trigger.value, reference, place)

    # -- tools and work objects -------------------------------------------------------------------

    def _frame_names(self, step: ProgramStep) -> tuple[str, str]:
        tool, wobj = step.tool, step.work_object
        return (
            self._tool(tool) if isinstance(tool, str) else self._named(tool),
            self._object(wobj) if isinstance(wobj, str) else self._named(wobj),
        )

    def _tool(self, name: str) -> str:
        """Return the name of a tool of the configuration; declare it if the controller does not."""
        tool = next(
            (t for t in (self.group.tool, *self.group.tools) if t.name == name), self.group.tool
        )
        if tool.name != "tool0" and not tool.elsewhere and tool.name not in self._tools:
            self._tools[tool.name] = rapid.ToolData(
                tool.name, tool.held, _frame(tool.frame), _load(tool.load)
            )
        return tool.name

    def _object(self, name: str) -> str:
        known = (self.group.work_object, *self.group.work_objects)
        wobj = next((w for w in known if w.name == name), self.group.work_object)
        if wobj.name != "wobj0" and not wobj.elsewhere and wobj.name not in self._objects:
            self._objects[wobj.name] = rapid.WorkObjectData(
                wobj.name, wobj.held, _frame(wobj.user_frame), _frame(wobj.object_frame)
            )
        return wobj.name

    def _named(self, own: UserTool | UserWorkObject) -> str:
        """Return the name of a tool or work object of the program, declared on first use."""
        if own in self._own:
            return self._own[own]
        if isinstance(own, UserTool):
            name = f"tool_{len(self._tools) + 1}"
            centre = tuple(value * _MM for value in own.centre)
            load = rapid.Load(own.mass, centre, own.axes, own.inertia)
            self._tools[name] = rapid.ToolData(name, True, _pose(own.frame), load)
        else:
            name = f"wobj_{len(self._objects) + 1}"
            user, inner = _pose(own.user_frame), _pose(own.object_frame)
            self._objects[name] = rapid.WorkObjectData(name, False, user, inner)
        self._own[own] = name
        return name

    # -- calls ------------------------------------------------------------------------------------

    def _call(self, step: ProgramStep, posture: Posture) -> rapid.Call:
        routine = next(r for r in self.group.routines if r.name == step.routine)
        if step.seconds:
            self._say("RG753", f"the time-out of '{step.routine}' is not exported")
        arguments = tuple(
            self._argument(step, parameter, value, posture)
            for parameter, value in zip(routine.parameters, step.arguments, strict=True)
        )
        return rapid.Call(routine.call.rpartition(":")[2], arguments, routine.returns)

    def _argument(
        self, step: ProgramStep, parameter: RoutineParameter, value: Argument, posture: Posture
    ) -> rapid.Argument:
        if parameter.type == "jointtarget":
            joints = self.complete.map.to_controller(joints_of(cast("Sequence[float]", value)))
            target: rapid.Target = rapid.JointTarget(*self.complete.map.to_rapid(joints))
            return rapid.Argument(target, parameter.type, parameter.inout)
        if parameter.type == "robtarget":
            pose = pose_of(value)
            target = self._target(pose, self._frames(step).postures(pose, posture)[0])
            return rapid.Argument(target, parameter.type, parameter.inout)
        plain = cast("float | bool | str", value)
        return rapid.Argument(plain, parameter.type, parameter.inout)

    def _say(self, code: str, message: str, help: str = "") -> None:
        self.notes.append(error(code, None, message, help, severity=Severity.WARNING))

    def _say_only_joints(self) -> None:
        assert self._kinematics is not None, "poses were checked with the geometry"
        family = family_of(self._kinematics)
        self._say(
            "RG752",
            f"no public targets confirm the configuration data of this arm ({family.name})",
            "joint moves are MoveAbsJ; compare the confdata of linear moves with the controller's",
        )
        self._header += [
            f"Public targets do not confirm the configuration data of this arm ({family.name}).",
            "Joint moves are MoveAbsJ. Compare the confdata of linear moves with the controller's.",
        ]


def _rounded(value: float) -> float:
    """Return a converted value without the noise of the conversion."""
    return round(value, 6)


def _zone(zone: Zone) -> rapid.Zone:
    if zone.stops:
        return rapid.FINE
    lengths = (zone.tcp, zone.orientation, zone.external)
    return rapid.Zone(
        False,
        (
            *(_rounded(value * _MM) for value in lengths),
            _rounded(degrees(zone.angle)),
            _rounded(zone.linear * _MM),
            _rounded(degrees(zone.rotary)),
        ),
    )


def _pose(pose: Pose) -> rapid.Frame:
    (x, y, z), q = pose_of(pose)
    return rapid.Frame((x * _MM, y * _MM, z * _MM), normalise(q))


def _frame(placement: Placement) -> rapid.Frame:
    x, y, z = placement.position
    return rapid.Frame((x * _MM, y * _MM, z * _MM), placement.orientation)


def _load(load: ConfigLoad) -> rapid.Load:
    centre = tuple(value * _MM for value in load.centre)
    return rapid.Load(load.mass, centre, load.axes, load.inertia)
