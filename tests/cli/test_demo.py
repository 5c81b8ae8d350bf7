"""`rapidgen demo`, whose reader has never seen any of it."""

import re

from rapidgen.cli.app import main
from rapidgen.viewer import plotting


def test_demo_reports_steps_and_next_commands(tmp_path, capsys, monkeypatch):
    drawn = []
    monkeypatch.setattr(plotting.Plot, "save", lambda plot, path: drawn.append(plot) or path)
    assert main(["demo", "--output", str(tmp_path / "demo")]) == 0
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
