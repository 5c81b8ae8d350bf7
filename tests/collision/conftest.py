"""An arm with collision shapes, and cells around it."""

import pytest

from tests.docs.tree import ROOT


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """An IRB 120 whose URDF has spheres and capsule-like cylinders as `<collision>`."""
    path = tmp_path_factory.mktemp("cell")
    text = (ROOT / "robots" / "urdf" / "irb120.urdf").read_text(encoding="utf-8")
    text = text.replace("<visual>", "<collision>").replace("</visual>", "</collision>")
    (path / "arm.urdf").write_text(text)
    (path / "robot.yaml").write_text(
        "model: irb120\nurdf: {file: arm.urdf}\ncontroller: {robotware: 6.15}\n"
    )
    return path


WRIST = """
  pairs:
    base_link - link_2: {allowed: bars meet in the shoulder}
    link_3 - link_5: {allowed: bars meet in the wrist}
    link_3 - link_6: {allowed: bars meet in the wrist}
    link_4 - link_6: {allowed: bars meet in the wrist}
"""


@pytest.fixture
def cell(folder):
    """Write a cell file: `cell("things: ...")`."""

    def make(text="", collision="collision:\n  clearance: 10", robots=""):
        path = folder / "cell.yaml"
        robots = robots or "robots:\n  T_ROB1: {model: robot.yaml}"
        path.write_text(f"{robots}\n{text}\n{collision}{WRIST}")
        return path

    return make
