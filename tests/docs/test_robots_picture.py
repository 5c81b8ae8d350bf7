"""docs/start/robots.svg shows the models as their files have them."""

from pathlib import Path

import pytest

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config, shipped_names
from tests.docs.robots_picture import PAGE, chain, draw


def test_the_picture_is_drawn_from_the_models():
    assert PAGE.read_text(encoding="utf-8") == draw(), "python -m tests.docs.robots_picture"
    assert f"({PAGE.name})" in Path(PAGE.with_suffix(".md")).read_text(encoding="utf-8")


@pytest.mark.parametrize("name", shipped_names())
def test_what_is_drawn_ends_at_the_flange(name):
    for group in load_config(name).groups:
        own, degrees = Kinematics.of(group), tuple(range(3, 3 + len(group.joints)))
        controller = own.map.from_rapid(*_rapid(own, degrees))
        *_, (_, end) = chain(own, degrees)
        assert max(map(abs, frames.error(end, own.forward(controller)))) < 1e-9


def _rapid(own, degrees):
    """robax and extax with those figures in the order of the joints."""
    slots = [0.0] * 12
    for (slot, _), value in zip(own.map._slots, degrees, strict=True):
        slots[slot] = value
    return slots[:6], slots[6:]
