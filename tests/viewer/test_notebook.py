"""Robots in notebooks: the view's frame, and the progress of a motion."""

import threading
from contextlib import closing
from types import SimpleNamespace
from urllib.request import urlopen

import pytest

from rapidgen.client import Progress, Robot, TrajectoryState
from rapidgen.viewer import progress, view
from tests.viewer.test_robot import address


def test_view_of_a_robot_is_a_frame_with_its_page(irb120):
    with (
        Robot("irb120", address=address(irb120), watch=True) as robot,
        closing(view(robot, height=300)) as shown,
    ):
        assert shown.url.startswith("http://127.0.0.1:")
        assert f'src="{shown.url}"' in shown._repr_html_()
        assert "height:300px" in shown._repr_html_()
        with urlopen(shown.url, timeout=10) as page:
            assert b"<!doctype html>" in page.read(100).lower()


class Motion:
    """A motion that ends after its progress was read twice."""

    def __init__(self, ending):
        self.reads, self.ending, self.seen = 0, ending, threading.Event()

    @property
    def progress(self):
        self.reads += 1
        if self.reads == 2:
            self.seen.set()
        return Progress(TrajectoryState.MOVING, 10, fraction=0.4)

    def result(self, timeout=None):
        assert self.seen.wait(30)
        if isinstance(self.ending, Exception):
            raise self.ending
        return self.ending


def test_progress_returns_the_result(capsys):
    result = SimpleNamespace()
    assert progress(Motion(result)) is result
    assert "100 %" in capsys.readouterr().out


def test_progress_ends_with_the_error(capsys):
    with pytest.raises(ValueError, match="stopped"):
        progress(Motion(ValueError("stopped")))
    assert "40 %" in capsys.readouterr().out
    assert "progress of a motion" not in [thread.name for thread in threading.enumerate()]
