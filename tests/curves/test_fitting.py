"""Fits of small curves: what is predicted is what the virtual controller does."""

import math

import numpy as np
import pytest

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Kinematics
from rapidgen.config.model_cache import shipped_groups
from rapidgen.controller import VirtualController
from rapidgen.curves.curve import read_curve
from rapidgen.curves.fitting import Fitter, Requirement
from rapidgen.curves.module import module_of
from rapidgen.curves.placement import Placer, lead_for, speed_after
from rapidgen.curves.prediction import Predictor

GROUP = shipped_groups("irb120")[0]
KINEMATICS = Kinematics.of(GROUP)
TOOL = ((0.0, 0.0, 0.1), (1.0, 0.0, 0.0, 0.0))
WANTED = Requirement(0.0005, math.radians(3), 0.05, 30)


def wave(x):
    """A wave on a table in front of the robot: mm, the tool points down."""
    return 60 * math.sin(x / 45), 20 * math.sin(x / 60)


@pytest.fixture(scope="module")
def curve(tmp_path_factory):
    path = tmp_path_factory.mktemp("curves") / "wave.csv"
    rows = [(400 + wave(x)[0], x - 100, 250 + wave(x)[1], 0, 0, -1) for x in range(0, 201, 5)]
    path.write_text("\n".join(",".join(map(str, row)) for row in rows), encoding="ascii")
    return read_curve(path)


@pytest.fixture(scope="module")
def placement(curve):
    return Placer(KINEMATICS, TOOL).best(curve)


@pytest.fixture(scope="module")
def fit(placement):
    return Fitter(GROUP, TOOL, placement).fit(0.15, WANTED)


def test_fit_keeps_the_requirement_with_few_moves(fit):
    assert fit.keeps(WANTED)
    assert fit.moves <= 16
    assert fit.prediction.mean_speed == pytest.approx(0.15, rel=0.01)


def test_lines_that_are_placed_by_hand_need_more_moves(fit, placement):
    by_hand = Fitter(GROUP, TOOL, placement).equally_spaced(fit.moves, 0.01, 0.15)
    assert not by_hand.keeps(WANTED)


def test_virtual_controller_moves_as_predicted(fit, placement, tmp_path):
    module = module_of(fit, KINEMATICS, "wave")
    path = tmp_path / "wave.mod"
    path.write_text(module.text, encoding="ascii")
    options = {"robot": "irb120", "entry": "wave_path", "cycle": "once"}
    with VirtualController.from_files([path], **options) as controller:
        recorder = controller.record()["rob1"]
        assert controller.run(max_time=60.0) == "finished"
        rows = recorder.recording(0.004).commanded
    fitter = Fitter(GROUP, TOOL, placement)
    # Without the approach: from the last sample at the start of the lead.
    at_start = np.abs(rows - np.array(fit.program.start)).max(axis=1) < 1e-5
    own = rows[np.flatnonzero(at_start)[-1] :]
    result = fitter.predictor.compare([tuple(row) for row in own.tolist()], TOOL)
    assert result.largest_deviation < WANTED.tolerance
    assert result.largest_angle < WANTED.angle
    assert result.mean_speed == pytest.approx(fit.prediction.mean_speed, rel=0.005)


def test_circle_is_one_circle(tmp_path):
    rows = []
    for k in range(37):
        a = math.radians(5 * k) - math.pi / 2
        rows.append((350 + 80 * math.cos(a), 80 * math.sin(a), 300, 0, 0, -1))
    path = tmp_path / "circle.csv"
    path.write_text("\n".join(",".join(map(str, row)) for row in rows), encoding="ascii")
    placement = Placer(KINEMATICS, TOOL).best(read_curve(path))
    fit = Fitter(GROUP, TOOL, placement).fit(0.1, WANTED)
    assert [w.via is not None for w in fit.program.waypoints] == [False, True, False]
    assert "MoveC" in module_of(fit, KINEMATICS, "circle").text


def test_deviation_of_a_shifted_path_is_the_shift(fit, curve):
    shifted = curve.placed(((0.0, 0.0, 0.002), (1.0, 0.0, 0.0, 0.0)))
    result = Predictor(GROUP, shifted).predict(fit.program)
    assert result.largest_deviation == pytest.approx(0.002, abs=0.0006)


def test_angle_of_a_tilted_tool_is_the_tilt(fit, placement):
    tilted = TOOL[0], frames.about((1.0, 0.0, 0.0), math.radians(2))
    fitter = Fitter(GROUP, TOOL, placement)
    program = fit.program
    moved = type(program)(program.start, program.waypoints, program.speed, tilted)
    result = fitter.predictor.predict(moved)
    # The waypoints are those of the tool, so the flange tilts and the tool does not.
    assert result.largest_angle < math.radians(1)


def test_curve_out_of_reach_has_no_placement(curve):
    far = curve.placed(((1.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)))
    placer = Placer(KINEMATICS, TOOL)
    assert placer.best(far) is None
    assert placer.reached(far) == 0.0


@pytest.mark.long
def test_place_brings_a_far_curve_into_reach(curve):
    far = curve.placed(((3.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)))
    placement = Placer(KINEMATICS, TOOL).place(far)
    assert placement.speed > 0.1
    again = Placer(KINEMATICS, TOOL).place(far)
    assert again.moved == placement.moved


def test_lead_and_speed_after_it_are_inverse():
    assert speed_after(lead_for(0.8)) == pytest.approx(0.8)
