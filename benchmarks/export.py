"""Seconds of CPU to export 100,000 points: writing alone, then with check and run.

`python benchmarks/export.py [--points N]`. Check and run take N points: a module of 100,000 is
larger than the parser accepts, and `export --parts` splits it. The points are a dense path of
joints, 0.2 mm to 1 mm apart at the TCP; the run is that of `rapidgen export`, on the virtual
controller.
"""

import argparse
import time

import numpy as np

from rapidgen.axes.mapping import JointMap
from rapidgen.client.core.group import Group
from rapidgen.client.rapid_export import export_program
from rapidgen.client.toolpath_program import program_of
from rapidgen.config import load_config
from rapidgen.controller.module_trial import run_module
from rapidgen.diagnostics import Span
from rapidgen.export import description as rapid
from rapidgen.export.sources import PathStep, Toolpath
from rapidgen.export.writer import WriterOptions, write_module


def path(count: int) -> np.ndarray:
    """Return joints (count, 6) of a wave within the range of an irb120, rad."""
    phase = np.linspace(0, 0.004 * count, count)[:, None]
    return np.array([0.0, 0.1, 0.1, 0.2, 0.6, 0.0]) + 0.25 * np.sin(phase * np.arange(1, 7) / 6)


def writing(count: int) -> None:
    """Print the time of a description's text, inline and in arrays."""
    joints = JointMap.of(load_config("irb120").groups[0])
    moves = [
        rapid.Move("AbsJ", rapid.JointTarget(*joints.to_rapid(row)), rapid.Speed(100), rapid.FINE)
        for row in path(count).tolist()
    ]
    routine = rapid.Routine("long", "main", tuple(moves))
    for style in ("inline", "arrays"):
        began = time.process_time()
        module = write_module(routine, WriterOptions(targets=style))
        seconds = time.process_time() - began
        print(
            f"{count} points {style}: written in {seconds:.1f} s, {len(module.text) / 1e6:.1f} MB"
        )


def complete(count: int) -> None:
    """Print the time of the whole command without reading: program, check, text, run."""
    config = load_config("irb120")
    group = config.groups[0]
    steps = tuple(
        PathStep("joints", Span("long.csv", n + 1, 1), joints=tuple(row), speed=0.1)
        for n, row in enumerate(path(count).tolist())
    )
    own = Group.of(config, group)
    began = time.process_time()
    program, spans = program_of(Toolpath(steps), own, zone="z0")
    exported = export_program(
        program,
        config,
        group,
        module="long",
        routine="main",
        start=None,
        options=WriterOptions(),
        spans=spans,
    )
    written = time.process_time()
    trial, errors = run_module(
        exported.module,
        group,
        start=exported.start_values,
        robotware=config.robotware,
        lines=exported.lines,
        spans=spans,
    )
    assert not errors, errors[0]
    ended = time.process_time()
    print(f"program, check and text in {written - began:.1f} s, run in {ended - written:.1f} s")
    print(f"{count} moves in {trial.seconds:.0f} simulated s, {len(trial.warnings)} warnings")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--points", type=int, default=20_000)
    given = parser.parse_args()
    writing(100_000)
    complete(given.points)
