"""Collision checks on the command line: summary, plot, and files in a cell."""

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rapidgen.cli.terminal import is_quiet
from rapidgen.diagnostics import Diagnostic, refusal, render

if TYPE_CHECKING:
    from rapidgen.collision.check import CollisionReport
    from rapidgen.collision.timing import Timing
    from rapidgen.config.cell import CellDescription
    from rapidgen.config.model import GroupConfig, RobotConfig

TRAJECTORIES = (".csv", ".json")
_PAIRS = 5
"""Pairs of bodies in a plot, the nearest ones."""


def collision_summary(report: "CollisionReport") -> str:
    """Return the least clearance, the extent of the proof, and what was not checked."""
    nearest = report.clearances().by_pair()
    if nearest:
        one, other, far, when = nearest[0]
        least = f"least clearance {1000 * far:.1f} mm, {one} - {other} at {when:.3f} s"
    else:
        least = "no pair is nearer than 100 mm"
    timings = [_timing_text(timing) for timing in report.timings]
    lines = [
        f"collisions: {len(report.world.scene.pairs)} pairs, {report.postures} postures; {least}",
        *timings,
        *(f"{one} - {other} may touch: {why}" for (one, other), why in _reasons(report)),
        *(f"not checked: {text}" for text in report.world.unchecked),
    ]
    return "" if is_quiet() else "".join(f"{line}\n" for line in lines)


def _timing_text(timing: "Timing") -> str:
    robots = " and ".join(timing.robots)
    if timing.proved == float("inf"):
        return f"{robots}: free for any timing"
    if not timing.violations:
        return f"{robots}: proved for time shifts up to {timing.proved:.2f} s"
    return f"{robots}: proved for time shifts up to {timing.proved:.2f} of {timing.tolerance:.2f} s"


def _reasons(report: "CollisionReport") -> list[tuple[list[str], str]]:
    names = {body.name for body in report.world.scene.bodies}
    return [(sorted(pair), why) for pair, why in report.world.allowed.items() if pair <= names]


def draw_clearance(report: "CollisionReport", path: Path) -> None:
    """Write a plot of the clearance over time. Raises DiagnosticError RG626."""
    from rapidgen.collision.check import LIMIT
    from rapidgen.viewer.chart_data import Chart, Curve
    from rapidgen.viewer.plotting import Plot

    seen = report.clearances()
    top = 1000 * LIMIT
    curves = [Curve("least", seen.times, np.minimum(1000 * seen.curve(), top))]
    by_names = {frozenset(seen.scene.names(i)): i for i in range(seen.distances.shape[1])}
    for one, other, _, _ in seen.by_pair()[:_PAIRS]:
        column = seen.distances[:, by_names[frozenset((one, other))]]
        curves.append(Curve(f"{one} - {other}", seen.times, np.minimum(1000 * column, top)))
    Plot("Clearance", (Chart("clearance, up to 100", "mm", tuple(curves)),)).save(path)


def check_in_cell(files: Sequence[Path], cell_file: Path, plot: Path | None) -> list[Diagnostic]:
    """Check trajectories, or a RAPID program, in a cell; return the findings.

    Prints warnings and the summary on stderr. Raises DiagnosticError.
    """
    from rapidgen.config.cell import load_cell

    cell = load_cell(cell_file)
    found: list[Diagnostic] = []
    trajectories = [file for file in files if file.suffix.lower() in TRAJECTORIES]
    program = [file for file in files if file not in trajectories]
    reports = [_of_trajectory(file, cell, cell_file) for file in trajectories]
    if program:
        reports.append(_of_program(program, cell_file))
    for number, report in enumerate(reports):
        found += report.diagnostics
        sys.stderr.write(render(report.world.diagnostics))
        sys.stderr.write(collision_summary(report))
        if plot is not None:
            several = len(reports) > 1
            draw_clearance(report, plot.with_stem(f"{plot.stem}_{number}") if several else plot)
    return found


def write_cell_srdf(cell_file: Path, path: Path) -> None:
    """Write the pairs of links that a cell's check leaves out as an SRDF.

    Raises DiagnosticError (RG848: not written; RG833: the existing file is no SRDF).
    """
    from rapidgen.collision.srdf import disabled_pairs, write_srdf
    from rapidgen.collision.world import build_world, other_groups, sources_of
    from rapidgen.config.cell import load_cell

    cell = load_cell(cell_file)
    sources = sources_of(cell, other_groups(cell))
    world = build_world(cell, sources)
    pairs = disabled_pairs(world.scene, world.allowed, {thing.name for thing in cell.things})
    names = [s.description.graph.robot.name for s in sources if s.description is not None]
    try:
        write_srdf(path, names[0] if names else cell_file.stem, pairs)
    except OSError as fault:
        raise refusal(
            "RG848", None, f"cannot write {path}: {fault.strerror}", "choose another file"
        ) from None
    sys.stderr.write(f"{path}: {len(pairs)} pairs disabled\n")


def _of_trajectory(file: Path, cell: "CellDescription", cell_file: Path) -> "CollisionReport":
    """Check the limits of a trajectory, then its path from its first point."""
    from rapidgen.client.collisions import CellCheck
    from rapidgen.client.core.checks import check_trajectory
    from rapidgen.client.core.group import Group
    from rapidgen.client.trajectory import Trajectory

    read = Trajectory.from_csv if file.suffix.lower() == ".csv" else Trajectory.from_json
    trajectory = read(file)
    config, group = _robot_of(trajectory.names, cell, file)
    own = Group.of(config, group)
    ordered = trajectory.reordered(own.names) if len(trajectory.names) else trajectory
    start = own.to_wire(ordered.positions[:1])[0].tolist()
    checked = check_trajectory(trajectory, own, start=(*start, *[0.0] * (10 - len(start))))
    return CellCheck(cell_file, config, group).check_points(
        checked.wire, checked.durations, start, since=float(trajectory.times[0])
    )


def _robot_of(
    names: Sequence[str], cell: "CellDescription", file: Path
) -> "tuple[RobotConfig, GroupConfig]":
    """Return the robot of a cell with the joints of a trajectory (RG834)."""
    from rapidgen.config.load import load_config

    known = []
    for keys in cell.robots.values():
        if not keys.model:
            continue
        config = load_config(keys.model)
        for group in config.groups:
            joints = [joint.name for joint in group.joints]
            if not names or set(names) == set(joints):
                return config, group
            known.append(f"{config.name}: {', '.join(joints)}")
    raise refusal(
        "RG834",
        None,
        f"no robot of the cell has the joints of {file.name}: {', '.join(names[:12])}",
        "; ".join(known) or "robots: {T_ROB1: {model: irb120}} in the cell file names it",
    )


def _of_program(files: Sequence[Path], cell_file: Path) -> "CollisionReport":
    """Run a program once on the virtual clock, and check its planned path."""
    from rapidgen.controller.boot_targets import BootOptions, load_target
    from rapidgen.controller.collisions import CollisionSetup, CollisionWatch
    from rapidgen.controller.controller import VirtualController
    from rapidgen.controller.inference.restarts import run_past_stops

    booted = load_target(list(map(str, files)), BootOptions(cell=str(cell_file)))
    assert booted.cell is not None
    with VirtualController.boot(booted, cycle="once", autostart=False) as controller:
        watch = CollisionWatch(controller, CollisionSetup(booted.cell, booted.described))
        controller.start_program()
        finished = run_past_stops(controller, max_time=3600.0, max_statements=100_000_000)
        faults = [task for task in controller.tasks.values() if task.fault is not None]
        if finished != "finished" or faults:
            why = faults[0].fault.title if faults and faults[0].fault else finished
            raise refusal(
                "RG835",
                None,
                f"the program did not run to its end: {why}",
                "`rapidgen run FILE --cell CELL` shows where, and checks the path so far",
                exit_code=1,
            )
        return watch.report()
