"""Routines of RAPID as programs: the way back of `rapid_export`."""

from math import radians
from os import PathLike
from typing import TypedDict

from rapidgen.axes.frames import normalise
from rapidgen.axes.kinematics import AxisConfiguration
from rapidgen.axes.mapping import ABSENT
from rapidgen.client.core.group import Group
from rapidgen.client.pose import Pose
from rapidgen.client.program import (
    FINE,
    Argument,
    Program,
    Speed,
    Trigger,
    UserTool,
    UserWorkObject,
    Zone,
)
from rapidgen.client.rapid_export import robot_of
from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Span, error, suggest
from rapidgen.export import description as rapid
from rapidgen.export.reader import read_routine

_MM = 0.001
_PLACES = {"start": Trigger.after, "end": Trigger.before, "time": Trigger.ahead}


class _Options(TypedDict):
    """Arguments of all moves to poses."""

    speed: Speed
    zone: Zone
    configuration: AxisConfiguration
    external: dict[str, float]
    triggers: list[Trigger]


def import_program(
    text: str,
    robot: RobotConfig | str | PathLike[str],
    *,
    routine: str,
    group: str,
    path: str,
) -> Program:
    """Return a routine as a program. Raises DiagnosticError RG763 with all faults."""
    config, chosen = robot_of(robot, group)
    read = read_routine(text, routine, path)
    importer = _Importer(config, chosen, read.routine)
    for instruction, span in zip(read.routine.instructions, read.spans, strict=True):
        importer.add(instruction, span)
    if importer.findings:
        raise DiagnosticError(importer.findings)
    return importer.program


class _Importer:
    """Adds instructions of RAPID to a program."""

    def __init__(self, config: RobotConfig, group: GroupConfig, routine: rapid.Routine) -> None:
        self.program = Program()
        self.findings: list[Diagnostic] = []
        self._group, self._complete = group, Group.of(config, group)
        self._tools = {tool.name.lower(): tool for tool in routine.tools}
        self._objects = {wobj.name.lower(): wobj for wobj in routine.work_objects}
        self._used = group.tool.name, group.work_object.name

    def add(self, instruction: rapid.Instruction, span: Span) -> None:
        """Add one instruction; report it if the robot's configuration does not fit."""
        match instruction:
            case rapid.Move():
                self._move(instruction, span)
            case rapid.SetSignal(signal, _, value):
                self.program.set(signal, value)
            case rapid.WaitSignal(signal, _, value, seconds):
                self.program.wait_for(signal, value, timeout=seconds)
            case rapid.Wait(seconds):
                self.program.wait(seconds)
            case rapid.PathMode(singularities, configurations):
                self.program.allow(singularities=singularities, configurations=configurations)
            case rapid.Call():
                self._call(instruction, span)

    def _fault(self, span: Span, message: str, help: str = "") -> None:
        self.findings.append(error("RG763", span, message, help))

    def _move(self, move: rapid.Move, span: Span) -> None:
        if move.seconds:
            self._fault(span, "a move with \\T belongs to a trajectory, not to a program")
            return
        self._use(move, span)
        speed = Speed(
            _round(move.speed.tcp * _MM),
            radians(move.speed.orientation),
            _round(move.speed.linear * _MM),
            radians(move.speed.rotary),
        )
        triggers = [self._trigger(each) for each in move.triggers]
        zone = _zone(move.zone)
        target = move.target
        if isinstance(target, rapid.JointTarget):
            joints = self._joints(target, span)
            if joints is not None:
                self.program.move_joints(joints, speed=speed, zone=zone, triggers=triggers)
            return
        cf1, cf4, cf6, cfx = target.conf
        options: _Options = {
            "speed": speed,
            "zone": zone,
            "configuration": (cf1, cf4, cf6, cfx),
            "external": self._external(target),
            "triggers": triggers,
        }
        pose = _pose(target.trans, target.rot)
        if move.kind == "J":
            self.program.move_to(pose, **options)
        elif move.via is not None:
            self.program.move_circular(_pose(move.via.trans, move.via.rot), pose, **options)
        else:
            self.program.move_linear(pose, **options)

    def _joints(self, target: rapid.JointTarget, span: Span) -> tuple[float, ...] | None:
        joints = self._complete.map
        try:
            return joints.to_urdf(joints.from_rapid(target.robax, target.extax))
        except ValueError as fault:
            self._fault(span, f"the target has no value of {fault}")
            return None

    def _external(self, target: rapid.RobTarget) -> dict[str, float]:
        """Return external axes by joint name; those of an arm with seven axes belong to it."""
        result = {}
        for joint in self._complete.joints:
            if not joint.axis.startswith("eax") or (joint.axis == "eax_a" and self._has_seven()):
                continue
            value = target.extax["abcdef".index(joint.axis[-1])]
            if value < ABSENT / 2:
                scaled = radians(value) if joint.kind == "revolute" else value * _MM
                result[joint.name] = joint.sign * (scaled - joint.offset)
        return result

    def _has_seven(self) -> bool:
        geometry = self._complete.geometry
        return geometry is not None and geometry.kinematics.seventh >= 0

    def _trigger(self, trigger: rapid.Trigger) -> Trigger:
        place = trigger.place if trigger.reference == "time" else _round(trigger.place * _MM)
        return _PLACES[trigger.reference](place, trigger.signal, trigger.value)

    def _use(self, move: rapid.Move, span: Span) -> None:
        """Change tool and work object, if a move has others than the one before."""
        if (move.tool, move.work_object) == self._used:
            return
        own_tools = (self._group.tool, *self._group.tools)
        own_objects = (self._group.work_object, *self._group.work_objects)
        tool: str | UserTool | None = None
        wobj: str | UserWorkObject | None = None
        if move.tool != self._used[0]:
            known = [each.name for each in own_tools]
            declared = self._tools.get(move.tool.lower())
            if move.tool in known:
                tool = "" if move.tool == known[0] else move.tool
            elif declared is None or not declared.held:
                self._fault(span, f"there is no tool '{move.tool}'", suggest(move.tool, known))
                return
            else:
                x, y, z = (value * _MM for value in declared.load.centre)
                ix, iy, iz = declared.load.inertia
                frame = _pose(declared.frame.trans, declared.frame.rot)
                axes = _pose((0, 0, 0), declared.load.axes)[1]
                tool = UserTool(frame, declared.load.mass, (x, y, z), axes, (ix, iy, iz))
        if move.work_object != self._used[1]:
            known = [each.name for each in own_objects]
            placed = self._objects.get(move.work_object.lower())
            if move.work_object in known:
                wobj = "" if move.work_object == known[0] else move.work_object
            elif placed is None or placed.held:
                message = f"there is no work object '{move.work_object}'"
                self._fault(span, message, suggest(move.work_object, known))
                return
            else:
                wobj = UserWorkObject(
                    _pose(placed.user.trans, placed.user.rot),
                    _pose(placed.object.trans, placed.object.rot),
                )
        self._used = move.tool, move.work_object
        self.program.use(tool=tool, work_object=wobj)

    def _call(self, call: rapid.Call, span: Span) -> None:
        names = {r.call.rpartition(":")[2].lower(): r.name for r in self._group.routines}
        name = names.get(call.routine.lower())
        if name is None:
            help = suggest(call.routine, list(names)) or "list it under `routines:`"
            self._fault(span, f"the configuration has no routine '{call.routine}'", help)
            return
        arguments: list[Argument] = []
        for argument in call.arguments:
            value = argument.value
            if isinstance(value, rapid.RobTarget):
                arguments.append(_pose(value.trans, value.rot))
            elif isinstance(value, rapid.JointTarget):
                arguments.append(self._joints(value, span) or ())
            else:
                arguments.append(value)
        self.program.call(name, *arguments)


def _pose(trans: tuple[float, ...], rot: tuple[float, ...]) -> Pose:
    x, y, z = (_round(value * _MM) for value in trans)
    w, a, b, c = rot
    return Pose((x, y, z), normalise((w, a, b, c)))


def _zone(zone: rapid.Zone) -> Zone:
    if zone.finep:
        return FINE
    tcp, orientation, external, angle, linear, rotary = zone.sizes
    return Zone(
        _round(tcp * _MM),
        _round(orientation * _MM),
        _round(external * _MM),
        radians(angle),
        _round(linear * _MM),
        radians(rotary),
    )


def _round(value: float) -> float:
    """Return a converted value without the noise of the conversion."""
    return round(value, 9)
