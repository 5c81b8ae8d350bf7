"""rapid_out/: output of the examples, for reviews of changes.

Three are stored completely, of the others the cfg text. After an intended change: `python -m
tests.generate.goldens`.
"""

from dataclasses import replace

import pytest

from rapidgen.config import load_config
from rapidgen.generate import build, write
from rapidgen.rapid import check
from rapidgen.system import ModuleFile, read_folder
from rapidgen.verification.testbench import Bench
from tests.generate.goldens import EXAMPLES, GOLDENS, WHOLE, kept

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
def test_build_matches_the_golden(path):
    folder = GOLDENS / path.stem
    files = (p for p in folder.rglob("*") if p.is_file())
    result = {p.relative_to(folder).as_posix(): p.read_bytes() for p in files}
    wanted = kept(path)
    differing = [name for name in {*result, *wanted} if result.get(name) != wanted.get(name)]
    assert differing == [], "python -m tests.generate.goldens"


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda p: p.stem)
def test_an_example_is_checked_booted_and_driven(path, tmp_path):
    config = load_config(path)
    write(build(config), tmp_path / "out")
    system = read_folder(tmp_path / "out")
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
            own.assert_moves_through(own.motion(), own.wave(3))
        bench.assert_healthy()
    finally:
        bench.close()


def test_no_golden_without_its_example():
    result = {p.name for p in GOLDENS.iterdir() if p.is_dir()}
    assert result == {p.stem for p in EXAMPLES}


def test_whole_goldens_cover_coupling_two_arms_and_robotware_7():
    coupled, two, seven = map(
        load_config, (EXAMPLES[0].with_name(f"{name}.yaml") for name in WHOLE)
    )
    assert (coupled.robotware[0], two.robotware[0], seven.robotware[0]) == (5, 6, 7)
    assert coupled.groups[0].coupling
    assert len(two.groups) == 2
    assert any(joint.kind == "prismatic" for joint in two.groups[0].joints)
