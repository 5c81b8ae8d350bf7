"""Programs in parts on the virtual controller: the robot never waits for a module.

StartLoad only orders, WaitLoad links and initialises (S4 2-StartLoad-3, 2-WaitLoad-3); UnLoad needs
the same path text as Load (2-UnLoad-1).
"""

import re
from dataclasses import replace

import numpy as np
import pytest

from rapidgen.controller import VirtualController
from rapidgen.diagnostics import DiagnosticError
from rapidgen.export.description import FINE, JointTarget, Move, RobTarget, Routine, Speed, Zone
from rapidgen.export.parts import (
    LIMITS,
    QUEUED,
    LoadTimes,
    least_durations,
    measuring_files,
    split,
    unsplit,
)
from rapidgen.machine.cost_model import Costs

ZONE = Zone(False, (5.0, 8.0, 8.0, 0.8, 8.0, 0.8))
DOWN = (0.0, 0.0, 1.0, 0.0)
SMALL = replace(LIMITS[6], memory=64_000)
"""16 kB of text at once."""


def line(count=240, step=30.0, speed=100.0, long_every=0):
    """A zigzag of equal lines in front of the robot."""
    start = JointTarget((0.0, 0.0, 0.0, 0.0, 90.0, 0.0))
    moves = [Move("AbsJ", start, Speed(200.0), FINE)]
    for n in range(count):
        x = 330.0 + step * (n % 2)
        target = RobTarget((x, 0.25 * n, 400.0), DOWN, (0, 0, 0, 0))
        moves.append(Move("L", target, Speed(speed), ZONE if n < count - 1 else FINE))
    return Routine("long", "main", tuple(moves))


def written(files, folder):
    """Write modules to the HOME folder of a controller's disks; return it."""
    home = folder / "HOME"
    home.mkdir()
    for name, text in files.items():
        (home / name).write_text(text, encoding="ascii")
    return home


def standing(files, folder, costs=None):
    """Run modules; return seconds between first and last line, and those at rest in between."""
    home = written(files, folder)
    first = next(iter(files))
    with VirtualController.from_files(
        [home / first], robot="irb120", folder=folder, cycle="once", costs=costs
    ) as controller:
        recorder = controller.record()["rob1"]
        assert controller.run(max_time=300.0) == "finished"
        path = recorder.recording(0.01).commanded
    speeds = np.abs(np.diff(path, axis=0)).max(axis=1) / 0.01
    moving = np.flatnonzero(speeds > 1e-4)
    # The approach ends in a fine point: the program has one rest, before the lines.
    resting = speeds[moving[0] : moving[-1]] <= 1e-4
    return (moving[-1] - moving[0]) * 0.01, np.count_nonzero(resting) * 0.01


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """Times of the same program in one module."""
    return standing(split(line(), LIMITS[6]).files(), tmp_path_factory.mktemp("whole"))


def costs_of(times, factor):
    """Costs of a controller whose load and link times are a multiple of the estimated ones."""
    return Costs(
        module_load=round(1e6 * times.load * factor), module_link=round(1e6 * times.link * factor)
    )


def test_small_program_stays_one_module():
    result = split(line(20), LIMITS[6])
    assert len(result.parts) == 1
    assert list(result.files()) == ["long.mod"]


def test_robot_never_waits_at_the_printed_reserve(whole, tmp_path):
    times = LoadTimes(load=0.004, link=0.002, fixed=0.0)
    result = split(line(), SMALL, times)
    assert len(result.parts) > 2
    files = result.files()
    duration, resting = standing(files, tmp_path, costs_of(times, result.reserve))
    assert resting <= whole[1] + 0.02
    assert duration == pytest.approx(whole[0], abs=0.1)


def test_robot_waits_beyond_the_reserve(whole, tmp_path):
    times = LoadTimes(load=0.004, link=0.002, fixed=0.0)
    result = split(line(), SMALL, times)
    duration, _ = standing(result.files(), tmp_path, costs_of(times, 6 * result.reserve))
    assert duration > whole[0] + 0.2


def test_split_without_reserve_is_rejected():
    with pytest.raises(DiagnosticError, match="RG790"):
        split(line(400, step=1.0, speed=200.0), SMALL)


def test_no_part_is_smaller_than_what_is_queued():
    result = split(line(), SMALL, LoadTimes(0.001, 0.0005, 0.0))
    for part in result.parts:
        assert sum(isinstance(step, Move) for step in part.instructions) > QUEUED
    steps = [step for part in result.parts for step in part.instructions]
    assert steps == list(result.routine.instructions)


def test_only_parts_before_the_last_complete_one_are_unloaded():
    text = split(line(), SMALL, LoadTimes(0.001, 0.0005, 0.0)).files()["long.mod"]
    calls = re.findall(r'%"long_(\d+)_moves"%|UnloadFile:="long_(\d+)\.mod"', text)
    done = 0
    for called, unloaded in calls:
        if called:
            done = int(called)
        else:
            assert int(unloaded) < done


def test_report_names_the_longest_load():
    result = split(line(), SMALL, LoadTimes(0.004, 0.002, 0.0))
    assert any(f"{4 * result.reserve:.1f} ms/kB to load" in row for row in result.report())
    assert result.holds[0.25]


def test_dense_program_is_not_verified():
    dense = line(600, step=0.5, speed=100.0)
    result = split(dense, LIMITS[6])
    assert result.moves_per_second == pytest.approx(179, rel=0.05)
    assert [found.code for found in result.findings(LIMITS[6])] == ["RG791"]


def test_whole_module_beyond_the_limit_is_reported():
    found = unsplit(line(), LoadTimes()).findings(SMALL)
    assert [one.code for one in found] == ["RG792"]


def test_durations_are_way_by_speed():
    assert least_durations(line(3))[2] == pytest.approx(0.3, rel=0.01)


def test_measuring_program_finds_the_times_of_the_controller(tmp_path):
    home = written(measuring_files((16, 64)), tmp_path)
    costs = Costs(module_load=3000, module_link=7000)
    with VirtualController.from_files(
        [home / "measure_load.mod"],
        robot="irb120",
        entry="measure_load_times",
        folder=tmp_path,
        cycle="once",
        costs=costs,
    ) as controller:
        assert controller.run(max_time=60.0) == "finished"
        printed = list(controller.operator.rows)
    figures = re.findall(r"(\d+) kB: ([\d.]+) ms/kB to load, ([\d.]+) to link", " ".join(printed))
    assert [size for size, *_ in figures] == ["16", "64"]
    for _, load, link in figures:
        assert float(load) == pytest.approx(3.0, rel=0.1)
        assert float(link) == pytest.approx(7.0, rel=0.1)
