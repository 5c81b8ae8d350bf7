"""`rapidgen demo`, whose reader has never seen any of it."""

import re
import urllib.request

import pytest

from rapidgen.cli import demo
from rapidgen.cli.app import main
from rapidgen.viewer import plotting
from rapidgen.viewer.server import ASSETS
from tests.viewer.conftest import absent


def test_demo_reports_steps_and_next_commands(tmp_path, capsys, monkeypatch):
    drawn = []
    monkeypatch.setattr(plotting.Plot, "save", lambda plot, path: drawn.append(plot) or path)
    assert main(["demo", "--no-view", "--output", str(tmp_path / "demo")]) == 0
    message = capsys.readouterr()
    steps = re.findall(r"^(\w+):? {2,}", message.err, re.MULTILINE)
    assert steps == ["build", "boot", "connect", "move", "plot", "next"]
    assert "%, joints at" in message.err
    assert "31 points" in message.out
    assert (tmp_path / "demo" / "irb120" / "README.md").is_file()
    # By the controller's clock nothing of the robot's is ahead of its command.
    difference = drawn[0].charts[-1]
    assert difference.title == "executed minus commanded"
    # Degrees; a state that is a period late would be six of them off.
    assert max(abs(curve.values).max() for curve in difference.curves) < 4.0


def test_demo_serves_the_page_while_the_robot_moves(tmp_path, capsys, monkeypatch):
    if not ASSETS.is_dir():
        absent("built page: `make page`")
    # Without a terminal it moves once more; the page answers until then.
    monkeypatch.setattr(demo, "_UNATTENDED", 1.0)
    answers = []

    def open_page(output, trajectory, recording, group):
        (url,) = re.findall(r"^page +(http://127\.0\.0\.1:\d+/)#token=", said.err, re.MULTILINE)
        with urllib.request.urlopen(url, timeout=5) as answer:
            answers.append(answer.status)

    said = None

    def read_output(*_):
        nonlocal said
        said = capsys.readouterr()

    monkeypatch.setattr(demo, "_report", read_output)
    monkeypatch.setattr(demo, "_draw", open_page)
    assert main(["demo", "--output", str(tmp_path / "demo")]) == 0
    assert answers == [200]
    assert "goes on moving for 1 s" in capsys.readouterr().err


def test_demo_without_page_says_how_to_get_it(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(demo, "find_spec", lambda name: None)
    monkeypatch.setattr(demo, "_simulator", _no_simulator)
    with pytest.raises(RuntimeError, match="view=False"):
        main(["demo", "--output", str(tmp_path / "demo")])
    assert "page     not shown: pip install 'rapidgen[web]'" in capsys.readouterr().err


def _no_simulator(folder, *, view):
    raise RuntimeError(f"view={view}")


def test_demo_shows_why_the_simulator_ends(tmp_path, capsys):
    (tmp_path / "empty").mkdir()
    with pytest.raises(demo._SimulatorEnded), demo._simulator(tmp_path / "empty", view=False):
        pass
    assert "error[RG7" in capsys.readouterr().err
