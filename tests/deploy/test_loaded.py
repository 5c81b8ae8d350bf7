"""Deployed drivers on the cfg of delivered controllers.

They load, run, and uninstall without a trace. The cfg is `base_system`'s, whose lines have their
backups next to them.
"""

import pytest

from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.deploy import from_files, make_plan
from rapidgen.deploy.transports.folder import FolderTransport
from rapidgen.generate import build
from rapidgen.generate.existing_controller import fit, read_cell
from rapidgen.system import read_system, write_cfg
from rapidgen.system.base import Robot, base_system
from tests.refusal import refused


def delivered(folder, robotware, robots):
    """A backup of a controller as it is delivered."""
    for name in ("HOME", "SYSPAR", "BACKINFO"):
        (folder / name).mkdir(parents=True)
    for text in base_system(robotware, robots).domains:
        (folder / f"SYSPAR/{text.domain}.cfg").write_text(write_cfg(text))
    version = f"<RobotWare><Version>{robotware[0]}.{robotware[1]:02d}.00</Version></RobotWare>"
    (folder / "BACKINFO/version.xml").write_text(version)
    return folder


def made(config, cell=None):
    return from_files({file.path: file.data for file in build(config, cell).files})


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


def test_a_motion_task_that_is_not_there_is_refused(tmp_path):
    folder = delivered(tmp_path / "c", (6, 15), [Robot("T_ROB2", "ROB_2")])
    wanted = made(load_config("irb120"))
    assert refused(make_plan, FolderTransport(folder), wanted) == ["RG538"]


def test_a_motion_task_that_starts_with_another_routine_is_a_step(tmp_path):
    """As abb_driver's page advises: main renamed to ROS_main, Entry set to it."""
    folder = delivered(tmp_path / "c", (6, 15), [Robot("T_ROB1", "ROB_1")])
    path = folder / "SYSPAR/SYS.cfg"
    path.write_text(path.read_text().replace('"NORMAL"', '"NORMAL" -Entry "ROS_main"'))
    steps = make_plan(FolderTransport(folder), made(load_config("irb120"))).steps
    assert "set Entry of T_ROB1 to main (it starts with ROS_main there)" in steps[0].what
    own = made(load_config("irb120", overrides=("main=own",)))
    assert not any("Entry" in step.what for step in make_plan(FolderTransport(folder), own).steps)


def test_a_build_for_a_cell_that_had_the_driver_does_not_take_its_tasks_away(kit, tmp_path):
    folder = delivered(tmp_path / "c", (6, 15), [Robot("T_ROB1", "ROB_1")])
    transport = FolderTransport(folder)
    config = load_config("irb120")
    clean = read_cell(folder)
    kit.deploy(transport, made(config))
    loaded = read_cell(folder)
    assert refused(make_plan, transport, made(fit(config, loaded), loaded)) == ["RG539"]
    plan = make_plan(transport, made(fit(config, clean), clean))
    assert not any(change.action == "remove" for change in plan.cfg)
