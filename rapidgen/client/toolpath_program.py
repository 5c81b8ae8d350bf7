"""Toolpaths of files as programs and trajectories of a robot."""

from rapidgen.client.core.group import Group
from rapidgen.client.errors import InvalidProgram
from rapidgen.client.pose import Pose
from rapidgen.client.program import Program, ZoneLike
from rapidgen.client.trajectory import Trajectory
from rapidgen.diagnostics import Span, suggest
from rapidgen.export.sources import JointPath, Toolpath


def trajectory_of(path: JointPath) -> Trajectory:
    """Return joints with times as a trajectory. Raises InvalidTrajectory."""
    return Trajectory(path.times, path.positions, path.names, path.path, path.lines)


def program_of(
    toolpath: Toolpath,
    group: Group,
    *,
    zone: ZoneLike,
    tool: str = "",
    work_object: str = "",
    allow: tuple[bool, bool] = (False, False),
) -> tuple[Program, list[Span]]:
    """Return a toolpath as a program, and the place of each instruction.

    The robot comes to the first pose with all axes and stops there; then it follows lines and arcs.
    `allow`: singularities and other configurations, as `Program.allow`. Raises InvalidProgram for
    joint names that the robot does not have.
    """
    order = _order(toolpath, group)
    program = Program(zone=zone).use(tool=tool or None, work_object=work_object or None)
    spans: list[Span] = []
    if any(allow):
        program.allow(singularities=allow[0], configurations=allow[1])
        spans.append(toolpath.steps[0].span)
    moved = False
    for number, step in enumerate(toolpath.steps):
        is_last = number == len(toolpath.steps) - 1
        stop: ZoneLike | None = "fine" if is_last or not moved else zone
        if step.kind == "joints":
            joints = step.joints if order is None else [step.joints[i] for i in order]
            program.move_joints(joints, speed=step.speed, zone=stop)
        elif step.kind == "set":
            program.set(step.name, step.value)
        elif step.kind == "call":
            program.call(step.name)
        elif step.kind == "wait":
            program.wait(step.value)
        else:
            assert step.pose is not None, "lines and arcs have a pose"
            pose = Pose(*step.pose)
            if not moved:
                program.move_to(pose, speed=step.speed, zone="fine")
            elif step.via is not None:
                program.move_circular(Pose(*step.via), pose, speed=step.speed, zone=stop)
            else:
                program.move_linear(pose, speed=step.speed, zone=stop)
        moved = moved or step.kind in ("joints", "line", "arc")
        spans.append(step.span)
    return program, spans


def _order(toolpath: Toolpath, group: Group) -> list[int] | None:
    """Return the column of each joint of the robot; None without names."""
    names, own = toolpath.names, group.names
    if not names:
        return None
    for name in names:
        if name not in own:
            raise InvalidProgram.because(
                "RG670",
                f"the robot has no joint '{name}'",
                suggest(name, own) or f"its joints: {', '.join(own)}",
                exit_code=2,
            )
    missing = [name for name in own if name not in names]
    if missing:
        raise InvalidProgram.because(
            "RG670", f"joints are missing: {', '.join(missing)}", exit_code=2
        )
    return [names.index(name) for name in own]
