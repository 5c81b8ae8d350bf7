"""rapid_out/: what the examples give, kept so that a change to the output is seen in review.

After a wanted change:  for each example  `rapidgen build robots/examples/X.yaml -o rapid_out/X`.
"""

from dataclasses import replace
from pathlib import Path

import pytest

from rapidgen._data import data_folder
from rapidgen.config import load_config
from rapidgen.generate import build, compare
from rapidgen.proving.bench import Bench
from rapidgen.rapid import check
from rapidgen.system import ModuleFile, read_folder

EXAMPLES = sorted((data_folder("robots") / "examples").glob("*.yaml"))
GOLDENS = data_folder("robots").parent / "rapid_out"
OWN_MAIN = b"MODULE Cell\n    PROC main()\n        ROS_run;\n    ENDPROC\nENDMODULE\n"


def test_every_kind_of_robot_has_one():
    configs = [load_config(path) for path in EXAMPLES]
    assert {c.robotware[0] for c in configs} == {5, 6, 7}
    assert any(len(c.groups) == 2 for c in configs)
    groups = [g for c in configs for g in c.groups]
    assert any(g.coupling for g in groups)
    assert any(g.external_units for g in groups)
    assert {len(g.joints) for g in groups} >= {4, 6, 7, 8}
    assert any(j.kind == "prismatic" for g in groups for j in g.joints)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda p: p.stem)
def test_the_golden_is_what_is_built(path):
    changes = compare(build(load_config(path)), GOLDENS / path.stem)
    assert [c.path for c in changes] == [], f"rapidgen build {path} -o {GOLDENS / path.stem}"


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda p: p.stem)
def test_the_golden_is_checked_booted_and_driven(path):
    system = read_folder(GOLDENS / path.stem)
    config = load_config(path)
    if not config.call_main:
        own = ModuleFile("Cell", "Cell.mod", OWN_MAIN)
        robot, *others = system.tasks
        robot = replace(robot, modules=(*robot.modules, own))
        system = replace(system, tasks=(robot, *others))
    assert check(system) == []
    bench = Bench(config, system)
    try:
        for number in range(len(config.groups)):
            own = bench.of_group(number)
            own.moves_through(own.motion(), own.wave(3))
        bench.healthy()
    finally:
        bench.close()


def test_no_golden_without_its_example():
    found = {p.name for p in Path(GOLDENS).iterdir() if p.is_dir()}
    assert found == {p.stem for p in EXAMPLES}
