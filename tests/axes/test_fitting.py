"""Fits to measured points, generated from a known figure."""

import pytest

from rapidgen.axes import fitting, frames
from rapidgen.axes.fitting import NoFit

PLACED = ((10.0, -20.0, 30.0), frames.from_zyx(0.3, -0.4, 0.5))
CORNERS = [(0.0, 0.0, 0.0), (100.0, 0.0, 0.0), (0.0, 50.0, 0.0), (0.0, 0.0, 70.0)]
LINE = [(float(k), 0.0, 0.0) for k in range(4)]


def test_displacement_is_found_again():
    moved = [frames.transform(PLACED, corner) for corner in CORNERS]
    (shift, turn), worst, mean = fitting.displacement(CORNERS, moved)
    assert shift == pytest.approx(PLACED[0])
    assert turn == pytest.approx(PLACED[1])
    assert max(worst, mean) < 1e-9


def test_frame_through_three_points():
    points = [frames.transform(PLACED, corner) for corner in CORNERS[:3]]
    place, turn = fitting.frame_through(*points)
    assert place == points[0]
    assert turn == pytest.approx(PLACED[1])


def test_sphere_says_which_point_is_off():
    on = [(3.0, 0.0, 0.0), (-3.0, 0.0, 0.0), (0.0, 3.0, 0.0), (0.0, -3.0, 0.0), (0.0, 0.0, 3.0)]
    exact = fitting.sphere(on)
    assert exact.centre == pytest.approx((0, 0, 0), abs=1e-9)
    assert exact.radius == pytest.approx(3)
    assert exact.largest < 1e-9
    off = fitting.sphere([*on, (0.0, 0.0, -3.0), (2.0, 2.0, 2.0)])
    assert off.worst == 6
    assert off.rms < off.largest


def test_point_that_flanges_hold():
    tool, world = (5.0, 6.0, 100.0), (800.0, 20.0, 30.0)
    turns = [frames.from_zyx(*angles) for angles in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))]
    flanges = [(frames.subtract(world, frames.rotate(turn, tool)), turn) for turn in turns]
    held, errors = fitting.held_point(flanges)
    assert held == pytest.approx(tool)
    assert max(errors) < 1e-9
    with pytest.raises(NoFit, match="do not turn the tool"):
        fitting.held_point([flanges[0]] * 4)


@pytest.mark.parametrize(
    "figure",
    [
        lambda: fitting.sphere(LINE),
        lambda: fitting.displacement(LINE, LINE),
        lambda: fitting.frame_through(*LINE[:3]),
    ],
)
def test_points_on_a_line_fit_nothing(figure):
    with pytest.raises(NoFit):
        figure()
