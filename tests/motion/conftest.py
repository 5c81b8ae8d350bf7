"""Cells and programs for the tests of motion."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.motion.moves import JointMove, MoveSpeed, Zone
from tests.motion.cell import Cell, zone


@pytest.fixture
def cell() -> Cell:
    """An IRB 120."""
    return Cell()


@pytest.fixture
def make_cell() -> type[Cell]:
    """Cells of other robots or settings."""
    return Cell


@pytest.fixture
def joint() -> Callable[..., JointMove]:
    """A joint move: degrees of the first axes, zone in mm (0 = fine)."""

    def make(*degrees: float, z: float = 0, time: float | None = None, **more: Any) -> JointMove:
        values = tuple(np.radians([*degrees, *[0.0] * (6 - len(degrees))]).tolist())
        speed = MoveSpeed(more.pop("tcp", 1.0))
        return JointMove(target=values, speed=speed, zone=zone(z), time=time, **more)

    return make


@pytest.fixture
def zones() -> Callable[[float], Zone]:
    """Zones by radius in mm."""
    return zone


class Program:
    """A RAPID program on a whole controller."""

    def __init__(self, path, text: str, robot: str, **options: Any) -> None:
        file = path / "Probe.mod"
        file.write_text(text, encoding="latin-1")
        groups = load_config(robot).groups
        self.controller = VirtualController.from_files(
            {"T_ROB1": [file]}, robots=groups, cycle="once", **options
        )
        self.group = self.controller.motion.group(groups[0].name)

    def run(self, seconds: float = 100.0) -> list[str]:
        """What the program wrote on the pendant."""
        self.controller.run_for(seconds)
        return list(self.controller.operator.rows)


@pytest.fixture
def rapid(tmp_path) -> Callable[..., Program]:
    """A program from the text between PROC main() and ENDPROC, and module declarations."""

    def make(body: str, declarations: str = "", robot: str = "irb120", **options: Any) -> Program:
        text = f"MODULE Probe\n{declarations}\nPROC main()\n{body}\nENDPROC\nENDMODULE\n"
        return Program(tmp_path, text, robot, **options)

    return make
