"""Objects of the customer exist when a driver is booted."""

from dataclasses import replace

from rapidgen.config import load_config
from rapidgen.controller.cell import in_its_cell
from rapidgen.generate import build, make_system
from rapidgen.system.model import ModuleFile

OWN = load_config("irb120", overrides=["main=own"])
THEIRS = b"MODULE theirs\n PROC Main()\n  ROS_run;\n ENDPROC\nENDMODULE\n"


def mains(system):
    return [
        module.name
        for task in system.tasks
        for module in task.modules
        if b"proc main()" in module.data.lower() and task.motion
    ]


def test_missing_main_is_replaced():
    system = make_system(OWN, build(OWN))
    assert mains(system) == []
    assert mains(in_its_cell(system, OWN)) == ["own_main"]


def test_existing_main_stays_the_only_main():
    system = make_system(OWN, build(OWN))
    motion, *others = system.tasks
    theirs = ModuleFile("theirs", "theirs.mod", THEIRS)
    system = replace(system, tasks=(replace(motion, modules=(*motion.modules, theirs)), *others))
    assert mains(in_its_cell(system, OWN)) == ["theirs"]


def test_driver_with_main_gets_no_other():
    config = load_config("irb120")
    system = make_system(config, build(config))
    assert mains(in_its_cell(system, config)) == ["ROS_motion"]
