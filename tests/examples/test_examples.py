"""Every example runs as it is, and says what it says."""

import ast
import importlib
import json
import re
import runpy
import subprocess
import sys
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import pytest

from rapidgen.client import Robot, Timeouts
from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.testing.egm import guide
from rapidgen.viewer import plotting

EXAMPLES = Path(__file__).parents[2] / "examples"
SAYS = {
    "joint_trajectory.py": r"3 points in .* s\n.*0\.0.* degrees",
    "numpy_trajectory.py": r"instead of 3\.0 s\njoint_1 at most \d+ degrees/s\n<Execution",
    "streaming.py": r"76 points by stream",
    "cartesian_program.py": r"3 instructions in",
    "gripper.py": r"there: False\n.*closed: True\n.*open: True",
    "own_routine.py": r"height 100\.5 mm\nRG\d+: .*measure.*7",
    "two_arms.py": r"rob_l: 2 points.*\nrob_r: 2 points",
    "record_and_plot.py": r"executed\.svg\nexecuted minus commanded \d\.\d+ degrees",
}
GUIDED = {
    "egm_sine.py": r"lag 20 ms, residual 0\.\d+ degrees",
    "egm_joystick.py": r"moved by 80, 0, 40 mm",
    "egm_hand_guiding.py": r"0\.\d mm from where the hand pulls",
    "egm_camera.py": r"above the part within [01]\.\d mm",
}
APART = {
    "deployment.py",
    "guiding.py",
    "ros2_launch_test.py",
    "test_counting.py",
    "trying.py",
    "web_services.py",
}


@pytest.fixture
def here(tmp_path, monkeypatch):
    """Where an example runs, as `python EXAMPLE.py` would run it."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(EXAMPLES))
    monkeypatch.setattr(sys, "argv", ["example"])
    # However much else this machine has to do.
    patient = partial(Robot, timeouts=Timeouts(*[60.0] * 9))
    monkeypatch.setattr(importlib.import_module("trying"), "Robot", patient)
    return tmp_path


def test_all_are_named():
    named = (EXAMPLES / "README.md").read_text()
    files = {path.name for path in EXAMPLES.iterdir() if path.is_file()} - {"README.md"}
    assert [name for name in sorted(files) if f"`{name}`" not in named] == []
    assert {name for name in files if name.endswith(".py")} == {*SAYS, *GUIDED, *APART}


@pytest.mark.parametrize("name", SAYS)
def test_programs(here, capsys, name):
    runpy.run_path(str(EXAMPLES / name), run_name="__main__")
    assert re.search(SAYS[name], capsys.readouterr().out)


@contextmanager
def lock_step(program="guided.mod"):
    """What `guiding.session_of` gives, on the virtual clock."""
    guidance = "pose" if program == "guided_tcp.mod" else "joints"
    with VirtualController.from_files(
        {"T_ROB1": [EXAMPLES / program]}, robots=load_config("irb120").groups, cycle="once"
    ) as controller:
        session = guide(controller, "PC", "irb120", guidance=guidance)
        session.wait_until_guided()
        yield session


@pytest.mark.parametrize("name", GUIDED)
def test_guided_robots(here, capsys, monkeypatch, name):
    monkeypatch.setattr(importlib.import_module("guiding"), "session_of", lock_step)
    runpy.run_path(str(EXAMPLES / name), run_name="__main__")
    assert re.search(GUIDED[name], capsys.readouterr().out)


@pytest.mark.long
@pytest.mark.parametrize("name", GUIDED)
def test_guided_robots_of_sim(here, name):
    """Over UDP. A loaded computer changes the figures, so only the end is compared."""
    done = run(EXAMPLES / name, cwd=here)
    assert done.returncode == 0, done.stdout + done.stderr
    assert re.search(r"\d", done.stdout)


def run(*words, cwd):
    words = [sys.executable, *map(str, words)]
    return subprocess.run(words, cwd=cwd, capture_output=True, text=True, timeout=200, check=False)


def test_a_test_of_a_program(here):
    done = run(
        "-m", "pytest", "-q", "-p", "no:cacheprovider", EXAMPLES / "test_counting.py", cwd=here
    )
    assert "3 passed" in done.stdout, done.stdout + done.stderr


def test_deployment(here):
    done = run(EXAMPLES / "deployment.py", f"dir://{here}", cwd=here)
    assert done.returncode == 0, done.stdout + done.stderr
    assert (here / "HOME").is_dir() or list(here.rglob("*.mod*"))


def test_web_services(here):
    done = run(EXAMPLES / "web_services.py", cwd=here)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "T_ROB1" in done.stdout


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.ipynb")), ids=lambda path: path.stem)
def test_notebooks(here, monkeypatch, path):
    """Cell by cell; what a cell ends with shows itself, as in a notebook."""
    for name in ("plot.js", "plot.css"):
        (here / name).write_text("/**/")
    monkeypatch.setattr(plotting, "ASSETS", here)
    cells = json.loads(path.read_text())["cells"]
    assert all(not cell.get("outputs") for cell in cells)
    names, displayed = {}, 0
    for cell in cells:
        if cell["cell_type"] != "code":
            continue
        tree = ast.parse("".join(cell["source"]))
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, path.name, "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), path.name, "eval"), names)
            html = getattr(value, "_repr_html_", None)
            assert (html() if html is not None else repr(value)) or value is None
            displayed += html is not None
    assert displayed >= 2
