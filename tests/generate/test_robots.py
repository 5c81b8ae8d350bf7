"""Every shipped model, in every RobotWare generation that it exists for, boots and moves."""

import struct

import pytest

from rapidgen.config import load_config, shipped_names
from rapidgen.generate import build
from rapidgen.system import parse_cfg, read_folder
from tests.generate.bench import STOP, Bench, close_to, trajectory

VERSIONS = {5: "5.15", 6: "6.15", 7: "7.10", 8: "8.0"}
CASES = [
    (name, generation)
    for name in shipped_names()
    for generation in load_config(name).generations or (load_config(name).robotware[0],)
]


def overrides_for(generation):
    kind = "irc5" if generation < 7 else "omnicore"
    return [f"controller.robotware={VERSIONS[generation]}", f"controller.type={kind}"]


def targets(config, group, bench):
    """Where the group stands, and two places near it within the limits."""
    here = list(bench.joints(group.name))
    rows = [here]
    for step in (0.02, 0.05):
        row = []
        for joint, value in zip(group.joints, here, strict=True):
            room = joint.upper - value
            row.append(value + step if room > step else value - step)
        rows.append(row)
    return rows


@pytest.mark.parametrize(("name", "generation"), CASES)
def test_boots_and_moves(name, generation):
    config = load_config(name, overrides=overrides_for(generation))
    assert config.robotware[0] == generation
    bench = Bench(config)
    try:
        assert bench.vc.diagnostics == []
        for group in config.groups:
            client, state = bench.client(group.ports.motion), bench.client(group.ports.state)
            rows = targets(config, group, bench)
            client.send(b"".join(trajectory(rows, [10, 1, 1])))
            reply = client.wait_frame()
            assert struct.unpack_from("<4i", reply)[1:] == (11, 3, 1), struct.unpack(
                "<3i", reply[16:]
            )
            bench.vc.run_for(3)
            assert close_to(bench.joints(group.name), rows[-1], 1e-6)
            state.frames()
            frames = [state.wait_frame(), state.wait_frame()]
            (joint,) = [f for f in frames if f[4] == 10]
            told = struct.unpack_from("<10f", joint, 20)
            count = len(group.joints)
            assert close_to(told[:count], rows[-1], 1e-6)
            assert told[count:] == (0.0,) * (10 - count)
        others = [e for e in bench.vc.log if e.type.name in ("WARNING", "ERROR")]
        assert [str(e) for e in others] == []
        assert bench.healthy()
    finally:
        bench.stop()


@pytest.mark.parametrize("generation", [5, 6, 7])
def test_files_of_a_generation(generation, tmp_path):
    config = load_config("irb1200", overrides=overrides_for(generation))
    output = build(config)
    paths = {f.path: f for f in output.files}
    end = "x" if generation == 7 else ""
    assert f"HOME/ROS/ROS_common.sys{end}" in paths
    assert f"HOME/ROS/ROS_motion.mod{end}" in paths
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
        ("T_ROB_L", "rob_L"),
        ("T_ROB_R", "rob_R"),
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


def test_two_arms_move_at_once_and_stop_apart(bench):
    b = bench("irb14000")
    left, right = b.config.groups
    clients = {g.name: b.client(g.ports.motion) for g in b.config.groups}
    start = {g.name: list(b.joints(g.name)) for g in b.config.groups}
    for group in b.config.groups:
        rows = [start[group.name], [v + 0.1 for v in start[group.name]]]
        rows[1] = [min(v, j.upper) for v, j in zip(rows[1], group.joints, strict=True)]
        clients[group.name].send(b"".join(trajectory(rows, [10, 2])))
        assert clients[group.name].wait_frame()[12] == 1
    b.vc.run_for(1)
    clients[left.name].send(STOP)
    assert clients[left.name].wait_frame()[12] == 1
    b.vc.run_for(3)
    assert abs(b.joints(left.name)[0] - start[left.name][0]) < 0.09
    assert b.joints(right.name)[0] == pytest.approx(start[right.name][0] + 0.1, abs=1e-5)
    assert b.healthy()


def test_commissioning_makes_the_background_tasks_normal(bench):
    b = bench(commissioning=True)
    assert {t.type for t in b.system.tasks} == {"NORMAL"}
    from tests.generate.driving import move_well

    move_well(b)


def test_called_from_a_main_of_ones_own():
    output = build(load_config("irb120", overrides=["main=own"]))
    (motion,) = [f for f in output.files if f.path.endswith("ROS_motion.mod")]
    assert b"PROC main()" not in motion.data
    assert b"PROC ROS_run()" in motion.data
