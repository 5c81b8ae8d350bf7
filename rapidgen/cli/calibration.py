"""The command `calibrate`: measure the accelerations of a robot's axes."""

import math
import os
import sys
from dataclasses import replace
from datetime import date
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen._atomic_write import write_whole
from rapidgen.cli import options
from rapidgen.cli.target_text import Units, figure, joints_of, read_figures
from rapidgen.config.yaml_text import yaml_text
from rapidgen.diagnostics import DiagnosticError, error, refusal

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rapidgen.client import Trajectory
    from rapidgen.client.core.group import Group
    from rapidgen.config.model import GroupConfig, RobotConfig
    from rapidgen.motion.calibration import AxisFit, MoveFit

_FASTEST = 1.1
"""Speed of a log above which it is not of this robot, as a share of the axis speed."""
_SLACK = 0.5
"""deg or mm by which a log may leave an axis range."""
_PAUSE = 0.5
"""s of standstill after each move of the program."""


def calibrate(
    config: options.Config,
    log: Annotated[
        Path | None,
        typer.Option(
            "--log", help="CSV `time,<joint names>` (s, rad, m) of earlier moves.", metavar="FILE"
        ),
    ] = None,
    program: Annotated[
        Path | None,
        typer.Option(
            "--program", help="Write the moves as a RAPID module; no motion.", metavar="FILE.mod"
        ),
    ] = None,
    amplitude: Annotated[
        str,
        typer.Option(
            help="Largest distance of the axes from the start: one value, all, or some by name.",
            metavar="A|A1,A2,...",
        ),
    ] = "",
    speed: Annotated[
        float | None,
        typer.Option(help="Fraction of the axis speeds; 1 measures best.", metavar="FRACTION"),
    ] = None,
    start: Annotated[
        str,
        typer.Option(
            help="Start position of --program; default 0,0,0,0,30,0.", metavar="J1,J2,..."
        ),
    ] = "",
    record: Annotated[
        Path | None, typer.Option(help="CSV file for the executed positions.", metavar="FILE")
    ] = None,
    write: Annotated[
        bool, typer.Option("--write", help="Write the accelerations into the configuration.")
    ] = False,
    to: options.RobotAddress = "",
    group: options.Group = "",
    yes: options.YesOnLoopback = False,
    move_real_robot: options.RealRobot = "",
    as_json: options.AsJson = False,
) -> int:
    """Measure the axes' accelerations (THE ROBOT MOVES).

    Moves single axes from the current position in three postures and fits the accelerations. No
    axis is ever further from its start than its amplitude. Values are deg and mm. Ctrl-C stops
    the robot. With --log or --program nothing moves.

    rapidgen calibrate cell.yaml --amplitude 20 --speed 1 --to sim

    rapidgen calibrate cell.yaml --log executed.csv --write
    """
    from rapidgen.cli.run_outputs import check_files_writable
    from rapidgen.client.core.group import Group
    from rapidgen.config import load_config

    _one_source(log, program, amplitude, speed)
    if write:
        _require_file(config)
    check_files_writable([path for path in (record, program) if path is not None])
    loaded = load_config(config)
    own = _group(loaded, group)
    axes = Group.of(loaded, own)
    if program is not None:
        assert speed is not None
        write_whole(program, _module(axes, start, amplitude, speed).encode("ascii"))
        typer.echo(f"{program}: run it on the robot, record the joints, then use --log")
        return 0
    if log is not None:
        recording = _read_log(log, axes)
    else:
        assert speed is not None
        recording = _measured(
            config, own.name, to, amplitude, speed, yes=yes, real_robot=move_real_robot
        )
        if record is not None:
            recording.to_csv(record)
    moves, fits = _fitted(recording, axes)
    _report(axes, moves, fits, as_json=as_json)
    if write:
        _write(loaded, own, fits)
    elif not as_json:
        typer.echo(_block(own, fits))
    return 0


def _one_source(
    log: Path | None, program: Path | None, amplitude: str, speed: float | None
) -> None:
    if log is not None and program is not None:
        raise typer.BadParameter("--log and --program exclude each other")
    if log is not None:
        if amplitude or speed is not None:
            raise typer.BadParameter("--amplitude and --speed belong to moves, --log needs none")
        return
    if not amplitude:
        raise typer.BadParameter("choose how far the axes may move", param_hint="--amplitude")
    if speed is None:
        raise typer.BadParameter("choose a fraction of the axis speeds", param_hint="--speed")
    if not 0 < speed <= 1:
        raise typer.BadParameter(
            f"must be above 0 and at most 1, not {speed}", param_hint="--speed"
        )


def _require_file(config: str) -> None:
    from rapidgen.config import shipped_names

    if config in shipped_names():
        raise refusal(
            "RG901",
            None,
            f"--write: {config} is a shipped model, not a file",
            f"`rapidgen new cell.yaml --robot {config}` writes a configuration",
        )


def _group(config: "RobotConfig", name: str) -> "GroupConfig":
    names = [group.name for group in config.groups]
    if (name and name not in names) or (not name and len(names) > 1):
        raise typer.BadParameter(f"the groups are {', '.join(names)}", param_hint="--group")
    return next(group for group in config.groups if name in ("", group.name))


# -- the moves --------------------------------------------------------------------------------


def _start(group: "Group", text: str) -> tuple[float, ...]:
    """Return the start position of a program."""
    if text:
        return joints_of(read_figures(text, "--start"), Units(), group, [0.0] * len(group.names))
    values = [math.radians(30) if joint.axis == "rax_5" else 0.0 for joint in group.joints]
    within = [min(max(v, j.lower), j.upper) for v, j in zip(values, group.joints, strict=True)]
    return group.map.to_urdf(within)


def _amplitudes(group: "Group", text: str) -> tuple[float, ...]:
    """Return amplitudes in rad and m. Raises typer.BadParameter."""
    option, units = "--amplitude", Units()
    figures = read_figures(text, option)
    if not figures.names and len(figures.values) == 1:
        figures = replace(figures, values=figures.values * len(group.names))
    result = joints_of(figures, units, group, [0.0] * len(group.names), option)
    if any(value < 0 for value in result) or not any(result):
        raise typer.BadParameter("amplitudes are 0 or more, one of them above 0", param_hint=option)
    return result


def _targets(group: "Group", start: "Sequence[float]", text: str) -> list[tuple[float, ...]]:
    """Return targets of the controller's axes; the first move begins at `start`, joints.

    Raises DiagnosticError RG614 with all axes that would leave their limits.
    """
    from rapidgen.client import InvalidTrajectory
    from rapidgen.motion.calibration import identification_moves

    joints = group.joints
    current = tuple(group.map.to_controller(start))
    amplitudes = _amplitudes(group, text)
    faults = []
    for joint, value, amplitude in zip(joints, current, amplitudes, strict=True):
        low, high = value - amplitude, value + amplitude
        if amplitude and not joint.lower <= low <= high <= joint.upper:
            unit, factor, _ = Units().joint(joint.kind)
            limits = f"{figure(joint.lower, factor)} to {figure(joint.upper, factor)} {unit}"
            most = max(0.0, min(value - joint.lower, joint.upper - value))
            faults.append(
                error(
                    "RG614",
                    None,
                    f"{joint.name} would leave its limits: {joint.axis} would go from "
                    f"{figure(low, factor)} to {figure(high, factor)} {unit}, limits {limits}",
                    f"start elsewhere, or use an amplitude of at most {figure(most, factor)} "
                    f"{unit} for {joint.name}",
                )
            )
    if faults:
        raise InvalidTrajectory(tuple(faults), exit_code=2)
    return identification_moves(current, amplitudes, [joint.axis for joint in joints])


def _seconds(
    group: "Group", begin: "Sequence[float]", end: "Sequence[float]", speed: float
) -> float:
    """Return the duration of a move of the controller's axes at a fraction of their speeds."""
    times = [abs(b - a) / j.speed for a, b, j in zip(begin, end, group.joints, strict=True)]
    return max(max(times) / speed, group.policy.min_segment)


def _module(group: "Group", start: str, amplitude: str, speed: float) -> str:
    """Return a RAPID module with the moves; each stops, and stays for a moment."""
    begin = _start(group, start)
    targets = [tuple(group.map.to_controller(begin)), *_targets(group, begin, amplitude)]

    def target(values: "Sequence[float]") -> str:
        parts = [
            ",".join("9E9" if value > 8e9 else f"{value:.4f}" for value in part)
            for part in group.map.to_rapid(values)
        ]
        return f"[[{parts[0]}],[{parts[1]}]]"

    lines = [
        "MODULE RG_calibrate",
        "  ! Moves of single axes, from standstill to standstill, for `rapidgen calibrate --log`.",
        "  PROC main()",
        "    ! The first move goes to the start position, slowly.",
        f"    MoveAbsJ {target(targets[0])}, v100, fine, tool0;",
        f"    WaitTime {_PAUSE};",
    ]
    for a, b in pairwise(targets):
        time = _seconds(group, a, b, speed)
        lines += [
            f"    MoveAbsJ {target(b)}, vmax\\T:={time:.4f}, fine, tool0;",
            f"    WaitTime {_PAUSE};",
        ]
    return "\n".join([*lines, "  ENDPROC", "ENDMODULE", ""])


def _measured(
    config: str,
    group: str,
    to: str,
    amplitude: str,
    speed: float,
    *,
    yes: bool,
    real_robot: str,
) -> "Trajectory":
    """Move the robot and return what it did."""
    from rapidgen.cli.motion_execution import confirm_at, permitted, report_interruption
    from rapidgen.cli.terminal import is_quiet
    from rapidgen.client import Robot, Trajectory

    robot = Robot(config, address=to or None, group=group, feedback=True)
    must_ask = permitted(robot, to, yes=yes, real_robot=real_robot)
    with robot:
        axes = robot.group
        current = tuple(axes.map.to_controller(robot.state.joints))
        targets = _targets(axes, robot.state.joints, amplitude)
        _show_moves(axes, current, targets, speed, str(robot.address))
        if must_ask:
            confirm_at(robot)
        with robot.recording() as recording, report_interruption(robot, Units()) as in_progress:
            for number, (begin, end) in enumerate(pairwise([current, *targets]), 1):
                ends = [axes.map.to_urdf(values) for values in (begin, end)]
                seconds = _seconds(axes, begin, end, speed)
                trajectory = Trajectory.from_points(ends, seconds=seconds, names=axes.names)
                in_progress[:] = [robot.execute(trajectory)]
                in_progress[0].result()
                if not is_quiet():
                    sys.stderr.write(f"move {number} of {len(targets)}\n")
        return recording.trajectory()


def _show_moves(
    group: "Group",
    start: "Sequence[float]",
    targets: "Sequence[Sequence[float]]",
    speed: float,
    address: str,
) -> None:
    from rich.console import Console
    from rich.table import Table

    console = Console(stderr=True, highlight=False)
    console.print(f"{len(targets)} moves at {speed:.0%} of the axis speeds, at {address}")
    table = Table("axis", box=None)
    for title in ("now", "min", "max", "lower", "upper", ""):
        table.add_column(title, justify="right" if title else "left")
    for index, joint in enumerate(group.joints):
        unit, factor, digits = Units().joint(joint.kind)
        values = [start[index], *(target[index] for target in targets)]
        figures = (values[0], min(values), max(values), joint.lower, joint.upper)
        table.add_row(joint.name, *(figure(v, factor, digits) for v in figures), unit)
    console.print(table)


# -- the log ----------------------------------------------------------------------------------


def _read_log(path: Path, group: "Group") -> "Trajectory":
    """Read a log and check that it can be of this robot. Raises InvalidTrajectory."""
    import numpy as np

    from rapidgen.client import InvalidTrajectory, Trajectory

    log = Trajectory.from_csv(path)
    missing = [name for name in group.names if name not in log.names]
    if missing:
        raise InvalidTrajectory.because(
            "RG611",
            f"{path} has no column {', '.join(missing)}",
            f"the first line is `time,{','.join(group.names)}`",
            exit_code=2,
        )
    log = log.reordered(group.names)
    finite = np.isfinite(log.positions).all(axis=1) & np.isfinite(log.times)
    if not finite.all():
        row = int(np.flatnonzero(~finite)[0]) + 1
        raise InvalidTrajectory.because(
            "RG613", f"{path}: sample {row} has a value that is not finite", "remove the sample"
        )
    if len(log) < 2 or (np.diff(log.times) <= 0).any():
        late = np.flatnonzero(np.diff(log.times) <= 0)
        where = f"sample {int(late[0]) + 2} is not later" if len(late) else "fewer than 2 samples"
        raise InvalidTrajectory.because("RG612", f"{path}: {where}", "sort the log by time")
    _check_robot(path, log, group)
    return log


def _check_robot(path: Path, log: "Trajectory", group: "Group") -> None:
    """Raise InvalidTrajectory for a log that no robot of this configuration has made."""
    import numpy as np

    from rapidgen.client import InvalidTrajectory

    wire = group.to_wire(log.positions)
    rates = np.abs(np.diff(wire, axis=0)) / np.diff(log.times)[:, None]
    faults = []
    for column, joint in enumerate(group.joints):
        unit, factor, _ = Units().joint(joint.kind)
        low, high = (float(v) * factor for v in (wire[:, column].min(), wire[:, column].max()))
        if low < joint.lower * factor - _SLACK or high > joint.upper * factor + _SLACK:
            faults.append(
                error(
                    "RG614",
                    None,
                    f"{path}: {joint.name} goes from {low:.2f} to {high:.2f} {unit}, the axis from "
                    f"{joint.lower * factor:.2f} to {joint.upper * factor:.2f} {unit}",
                    "the log is of another robot, or its unit is not rad and m",
                )
            )
        fastest = float(rates[:, column].max())
        if fastest > _FASTEST * joint.speed:
            faults.append(
                error(
                    "RG615",
                    None,
                    f"{path}: {joint.name} moves at {fastest * factor:.1f} {unit}/s, the axis at "
                    f"{joint.speed * factor:.1f} {unit}/s at most",
                    "the log is of another robot, or its unit is not s, rad and m",
                )
            )
    if faults:
        raise InvalidTrajectory(tuple(faults), exit_code=1)


# -- the result -------------------------------------------------------------------------------


def _fitted(log: "Trajectory", group: "Group") -> "tuple[list[MoveFit], list[AxisFit]]":
    """Fit all moves. Raises DiagnosticError RG643 if no acceleration can be measured."""
    from rapidgen.motion.calibration import accelerations, fit_moves

    moves = fit_moves(log.times, group.to_wire(log.positions), group.joints)
    fits = accelerations(moves)
    if not fits:
        found = f"{len(moves)} moves of a single axis" if moves else "no move of a single axis"
        doubts = tuple(dict.fromkeys(move.doubt for move in moves))
        raise DiagnosticError(
            error(
                "RG643",
                None,
                f"no acceleration can be measured: {found} in {len(log)} samples",
                "log moves of single axes from standstill to standstill, with at least 5 samples "
                "of each; `rapidgen explain RG643`",
                notes=doubts,
            ),
            exit_code=1,
        )
    return moves, fits


def _report(
    group: "Group", moves: "Sequence[MoveFit]", fits: "Sequence[AxisFit]", *, as_json: bool
) -> None:
    if as_json:
        import json

        typer.echo(json.dumps({"axes": [_as_data(group, fit) for fit in fits]}))
        return
    known = {fit.axis: fit for fit in fits}
    for axis, joint in enumerate(group.joints):
        unit, factor, _ = Units().joint(joint.kind)
        fit = known.get(axis)
        if fit is None:
            doubts = [move.doubt for move in moves if move.axis == axis]
            typer.echo(f"{joint.name}: not measured, {doubts[0] if doubts else 'no usable move'}")
            continue
        change = fit.acceleration / joint.acceleration
        typer.echo(
            f"{joint.name}: {fit.acceleration * factor:.0f} {unit}/s² ({change:.2f} of the"
            f" configuration's {joint.acceleration * factor:.0f}), {fit.lowest * factor:.0f} to"
            f" {fit.highest * factor:.0f} in {fit.moves} moves, residual"
            f" {fit.miss * factor:.4f} {unit}"
        )


def _as_data(group: "Group", fit: "AxisFit") -> dict[str, object]:
    joint = group.joints[fit.axis]
    return {
        "joint": joint.name,
        "acceleration": fit.acceleration,
        "configured": joint.acceleration,
        "lowest": fit.lowest,
        "highest": fit.highest,
        "residual": fit.miss,
        "moves": fit.moves,
    }


def _values(group: "GroupConfig", fits: "Sequence[AxisFit]") -> dict[str, float]:
    """Return accelerations by joint as the configuration has them, deg/s² or mm/s²."""
    result = {}
    for fit in fits:
        joint = group.joints[fit.axis]
        value = float(f"{fit.acceleration * Units().joint(joint.kind)[1]:.5g}")
        result[joint.name] = int(value) if value.is_integer() else value
    return result


def _source(group: "GroupConfig", fits: "Sequence[AxisFit]") -> str:
    """Return the source of the accelerations; empty if some axes were not measured."""
    if len(fits) < len(group.joints):
        return ""
    moves = sum(fit.moves for fit in fits)
    return f"measured on this robot by rapidgen calibrate, {moves} moves, {date.today()}"


def _block(group: "GroupConfig", fits: "Sequence[AxisFit]") -> str:
    """Return the lines to paste."""
    values, source = _values(group, fits), _source(group, fits)
    lines = ["", "joints:"]
    lines += [f"  {yaml_text(name)}: {{acceleration: {a:g}}}" for name, a in values.items()]
    if source:
        lines += ["source:", f"  accelerations: {yaml_text(source)}"]
    return "\n".join(lines)


def _write(config: "RobotConfig", group: "GroupConfig", fits: "Sequence[AxisFit]") -> None:
    """Write accelerations into the configuration, if nothing else changes by that."""
    from rapidgen.config.edit import CannotEdit, set_value
    from rapidgen.config.yaml_tree import MappingNode, parse

    path = config.path
    text = path.read_bytes().decode("utf-8")
    root, _ = parse(text, str(path))
    nested = isinstance(root, MappingNode) and "groups" in root.entries
    prefix = ("groups", group.name) if nested else ()
    values, source = _values(group, fits), _source(group, fits)
    try:
        for name, value in reversed(values.items()):
            text = set_value(text, (*prefix, "joints", name, "acceleration"), value, str(path))
        if source:
            text = set_value(text, (*prefix, "source", "accelerations"), source, str(path))
        if not _has_only(config, group, values, text):
            raise CannotEdit("another value would change")
    except (CannotEdit, DiagnosticError) as fault:
        raise refusal(
            "RG644",
            None,
            f"cannot write the accelerations into {path}: {fault}",
            "add the lines by hand",
            notes=tuple(_block(group, fits).strip().splitlines()),
            exit_code=1,
        ) from fault
    write_whole(path, text.encode("utf-8"))
    typer.echo(f"{path}: {len(values)} accelerations written")


def _has_only(
    config: "RobotConfig", group: "GroupConfig", values: dict[str, float], text: str
) -> bool:
    """Return True if an edited text is the same configuration with other accelerations."""
    from rapidgen.config import load_config

    trial = config.path.with_name(f".rapidgen-{os.urandom(4).hex()}.yaml")
    try:
        trial.write_bytes(text.encode("utf-8"))
        edited = load_config(trial)
    finally:
        trial.unlink(missing_ok=True)
    for before, after in zip(config.groups, edited.groups, strict=True):
        joints = []
        for old, new in zip(before.joints, after.joints, strict=True):
            factor = Units().joint(old.kind)[1]
            value = values.get(old.name) if before.name == group.name else None
            expected = old.acceleration if value is None else value / factor
            if not math.isclose(new.acceleration, expected, rel_tol=1e-6):
                return False
            joints.append(replace(new, acceleration=old.acceleration))
        changed = replace(
            after,
            joints=tuple(joints),
            inertias=before.inertias,
            acceleration_source=before.acceleration_source,
        )
        if changed != before:
            return False
    return replace(edited, groups=config.groups, name=config.name) == config
