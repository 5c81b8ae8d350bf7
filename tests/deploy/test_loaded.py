"""Deployed drivers on the cfg of delivered controllers: they load, run, and go without a trace.

The cfg is `base_system`'s, whose lines have their backups beside them.
"""

import pytest

from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.deploy import from_files
from rapidgen.deploy.transports.folder import FolderTransport
from rapidgen.generate import build
from rapidgen.system import read_system, write_cfg
from rapidgen.system.base import Robot, base_system


def delivered(folder, robotware, robots):
    """A backup of a controller as it is delivered."""
    for name in ("HOME", "SYSPAR", "BACKINFO"):
        (folder / name).mkdir(parents=True)
    for text in base_system(robotware, robots).domains:
        (folder / f"SYSPAR/{text.domain}.cfg").write_text(write_cfg(text))
    version = f"<RobotWare><Version>{robotware[0]}.{robotware[1]:02d}.00</Version></RobotWare>"
    (folder / "BACKINFO/version.xml").write_text(version)
    return folder


def made(config):
    return from_files({file.path: file.data for file in build(config).files})


def files(folder):
    return {p: p.read_bytes() for p in folder.rglob("*") if p.is_file()}


@pytest.mark.parametrize(
    ("name", "robots"),
    [
        ("irb120", [Robot("T_ROB1", "ROB_1")]),
        ("irb14000", [Robot("T_ROB_R", "ROB_R"), Robot("T_ROB_L", "ROB_L")]),
        ("crb15000", [Robot("T_ROB1", "ROB_1")]),
    ],
)
def test_deployed_booted_and_taken_off(kit, tmp_path, name, robots):
    config = load_config(name)
    folder = delivered(tmp_path / "c", config.robotware, robots)
    before = files(folder)
    kit.deploy(FolderTransport(folder), made(config))
    with VirtualController(read_system(folder), robots=config.groups) as controller:
        controller.run_for(1.0)
        assert {task: view.fault for task, view in controller.tasks.items() if view.fault} == {}
        assert {view.state for view in controller.tasks.values()} == {"running"}
    kit.deploy(FolderTransport(folder), None, verb="uninstall")
    assert files(folder) == before
