"""Every shipped model boots and moves in each RobotWare generation."""

from dataclasses import replace

import pytest

from rapidgen.config import load_config, shipped_names
from rapidgen.generate import build, layout, make_system
from rapidgen.machine.event_log import EventType
from rapidgen.system import parse_cfg, read_folder
from rapidgen.system.base.mechanics_cfg import arm_name
from rapidgen.verification.messages import MAX_JOINTS, RawJointPosition
from rapidgen.verification.position_checks import distance
from rapidgen.verification.testbench import Bench

VERSIONS = {5: "5.15", 6: "6.15", 7: "7.10", 8: "8.0"}
CASES = [
    (name, generation)
    for name in shipped_names()
    for generation in load_config(name).generations or (load_config(name).robotware[0],)
]


def overrides_for(generation):
    kind = "irc5" if generation < 7 else "omnicore"
    # No file of RobotWare 8 was seen: it is for its controller to say how they begin.
    digits = [f"controller.cfg_header.{d}={generation}:0" for d in ("SYS", "EIO", "SIO")]
    return [
        f"controller.robotware={VERSIONS[generation]}",
        f"controller.type={kind}",
        *(digits if generation == 8 else ()),
    ]


@pytest.mark.parametrize(("name", "generation"), CASES)
def test_boots_and_moves(name, generation):
    config = load_config(name, overrides=overrides_for(generation))
    assert config.robotware[0] == generation
    bench = Bench(config, make_system(config, build(config)))
    try:
        assert bench.controller.diagnostics == []
        for number in range(len(config.groups)):
            own = bench.of_group(number)
            state, points = own.state(), own.wave(3, duration=1.0)
            own.assert_moves_through(own.motion(), points)
            own.run(0.5)
            state.read()
            text = state.expect(RawJointPosition, 2, "a JOINT arrives").joints
            count = len(own.position)
            assert distance(text[:count], points[-1][0]) < 1e-6
            assert text[count:] == (0.0,) * (MAX_JOINTS - count)
        others = [e for e in bench.controller.log if e.type is not EventType.INFO]
        assert [str(e) for e in others] == []
        bench.assert_healthy()
    finally:
        bench.close()


@pytest.mark.parametrize("generation", [5, 6, 7])
def test_files_of_a_generation(generation, tmp_path):
    config = load_config("irb1200", overrides=overrides_for(generation))
    output = build(config)
    paths = {f.path: f for f in output.files}
    end = "x" if generation == 7 else ""
    assert f"HOME/rapidgen/ROS_common.sys{end}" in paths
    assert f"HOME/rapidgen/ROS_motion.mod{end}" in paths
    assert ("SIO.cfg" in paths) == (generation == 7)
    for cfg in ("SYS.cfg", "EIO.cfg"):
        assert parse_cfg(paths[cfg].data).version[0] == generation


def test_tasks_of_two_arms(tmp_path):
    from rapidgen.generate import write

    config = load_config("irb14000")
    write(build(config), tmp_path / "yumi")
    system = read_folder(tmp_path / "yumi")
    motion = [t for t in system.tasks if t.motion]
    assert [(t.name, t.mechanical_unit_group) for t in motion] == [
        ("T_ROB_R", "rob_r"),
        ("T_ROB_L", "rob_l"),
    ]
    assert len(system.tasks) == 10
    assert {t.type for t in system.tasks if not t.motion} == {"SEMISTATIC"}
    assert {e.event for e in system.events if e.task == "T_ROB_R"} == {
        "POWER_ON",
        "START",
        "RESTART",
        "STOP",
        "QSTOP",
    }
    assert "Shared" not in (tmp_path / "yumi/SYS.cfg").read_text()


def test_commissioning_makes_the_background_tasks_normal():
    config = load_config("irb120", overrides=["commissioning=true"])
    assert {t.type for t in make_system(config, build(config)).tasks} == {"NORMAL"}


def test_called_from_a_main_of_ones_own():
    output = build(load_config("irb120", overrides=["main=own"]))
    (motion,) = [f for f in output.files if f.path.endswith("ROS_motion.mod")]
    assert b"PROC main()" not in motion.data
    assert b"PROC ROS_run(" in motion.data


def test_without_a_control_port_nothing_of_it_is_built():
    config = load_config("irb120", overrides=["ports.control=0"])
    output = build(config)
    assert "T_ROS_CONTROL" not in {t.name for t in make_system(config, output).tasks}
    assert not any("ROS_control" in f.path for f in output.files)
    assert b"ROS_control_" not in b"".join(f.data for f in output.files if f.kind == "module")


def test_without_geometry_corners_are_those_of_the_zone():
    config = load_config("irb120")
    (group,) = config.groups
    unknown = replace(config, groups=(replace(group, chain=()),))
    known, plain = (
        next(f.data for f in build(c).files if f.path.endswith("ROS_motion.mod"))
        for c in (config, unknown)
    )
    assert b"shape_corner" in known
    assert b"shape_corner" not in plain
    assert b"move CONFIG_ZONE;" in plain


@pytest.mark.parametrize("name", ["irb120", "irb14000", "irb14050", "irb120_track", "irb460"])
def test_the_driver_asks_for_arms_that_there_are(name):
    for group in load_config(name).groups:
        for joint in group.joints:
            assert layout.arm(group, joint).lower() == arm_name(group, joint).lower()
