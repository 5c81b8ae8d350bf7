"""Where the examples find their robot: at an address, else on a virtual controller."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from rapidgen.client import Robot
from rapidgen.config import load_config
from rapidgen.config.model import RobotConfig
from rapidgen.controller import VirtualController
from rapidgen.controller.cell import in_its_cell
from rapidgen.generate import build, make_system
from rapidgen.system.model import ModuleFile


@contextmanager
def robot_of(config: str | RobotConfig, *modules: Path, **options: bool) -> Iterator[Robot]:
    """A connected robot that is ready to move: `python EXAMPLE.py [ADDRESS]`.

    `modules` are RAPID files that the virtual controller loads; a robot has its own.
    """
    if sys.argv[1:]:
        with Robot(config, address=sys.argv[1], **options) as robot:
            yield robot
        return
    with virtual_controller(config, *modules) as controller:
        with Robot(config, address=controller.address(), **options) as robot:
            robot.wait_until(lambda state: state.status.motion_possible == 1, timeout=20)
            yield robot


@contextmanager
def virtual_controller(config: str | RobotConfig, *modules: Path) -> Iterator[VirtualController]:
    """A controller that executes a configuration's driver, in real time, on free ports."""
    model = config if isinstance(config, RobotConfig) else load_config(config)
    system = in_its_cell(make_system(model, build(model)), model)
    files = tuple(ModuleFile(path.stem, path.name, path.read_bytes()) for path in modules)
    tasks = [
        replace(task, modules=(*task.modules, *files)) if task.motion else task
        for task in system.tasks
    ]
    system = replace(system, tasks=tuple(tasks))
    choices = {"robots": tuple(model.groups), "clock": "real", "ports": "auto"}
    with VirtualController(system, **choices) as controller:
        controller.start()
        yield controller
