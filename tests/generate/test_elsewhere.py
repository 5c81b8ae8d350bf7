"""Tool, work object and load of a user module; names in use."""

import pytest

from rapidgen.config import load_config
from rapidgen.controller.cell import in_its_cell
from rapidgen.diagnostics import DiagnosticError
from rapidgen.generate import build, make_system
from rapidgen.verification.testbench import Bench

ELSEWHERE = {
    "tool.name": "tGripper",
    "tool.declared": "elsewhere",
    "tool.load.mass": 1.5,
    "work_object.name": "wTable",
    "work_object.declared": "elsewhere",
    "payload.name": "lPart",
    "tcp_speed_limit": 4000,
}


def bench_of(overrides):
    config = load_config("irb120", overrides=overrides)
    return Bench(config, in_its_cell(make_system(config, build(config)), config))


@pytest.mark.parametrize("given_by", ["GripLoad", "TLoad"])
def test_changed_external_data_apply_at_next_trajectory(given_by):
    with bench_of({**ELSEWHERE, "payload.given_by": given_by}) as bench:
        view = bench.controller.task("T_ROB1")
        link = bench.motion()
        bench.assert_moves_through(link, bench.wave(3))
        assert view["ROS_motion:tool_now"].tload.mass == 1.5
        bench.start_motion(link, bench.wave(6), 0.3)
        tool, load = view["own_data:tGripper"], view["own_data:lPart"]
        tool.tload.mass, load.mass = 2.0, 0.75
        view["own_data:tGripper"], view["own_data:lPart"] = tool, load
        bench.run(0.5)
        assert view["ROS_motion:tool_now"].tload.mass == 1.5
        bench.wait_until_standing()
        bench.run(0.5)
        bench.assert_moves_through(link, bench.wave(3))
        assert view["ROS_motion:tool_now"].tload.mass == 2.0
        assert view["ROS_motion:load_now"].mass == 0.75
        bench.assert_healthy()


TAKEN = ["num", "main", "MODULE", "ROS_run", "robtarget", "MoveAbsJ", "v100", "POINT", "joints"]


@pytest.mark.parametrize("name", TAKEN)
@pytest.mark.parametrize("key", ["tool", "work_object", "payload"])
def test_a_name_that_is_taken_is_refused(key, name):
    mass = {"tool.load.mass": 1} if key == "tool" else {}
    config = load_config("irb120", overrides={f"{key}.name": name, **mass})
    with pytest.raises(DiagnosticError, match=f"{key}.name: {name}") as refused:
        build(config)
    assert [d.code for d in refused.value.diagnostics] == ["RG106"]


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("model: irb120\ntool: {name: v100, load: {mass: 1}}\n", 2, 14),
        ("model: irb120\nwork_objects:\n  - name: wA\n  - {name: pose}\n", 4, 12),
        ("groups:\n  one:\n    model: irb120\n    payload: {name: num}\n", 4, 21),
    ],
)
def test_a_name_that_is_taken_has_its_place(tmp_path, text, line, column):
    (tmp_path / "cell.yaml").write_text(text)
    with pytest.raises(DiagnosticError) as refused:
        build(load_config(tmp_path / "cell.yaml"))
    (fault,) = refused.value.diagnostics
    assert (fault.code, fault.span.line, fault.span.column) == ("RG106", line, column)
    assert fault.span.path.endswith("cell.yaml")


@pytest.mark.parametrize("task", ["T_ROS_RECV", "t_ros_sup", "T_ROS_STATE"])
def test_the_motion_task_is_none_of_the_drivers(tmp_path, task):
    (tmp_path / "cell.yaml").write_text(f"model: irb120\ntask: {task}\n")
    with pytest.raises(DiagnosticError) as refused:
        build(load_config(tmp_path / "cell.yaml"))
    (fault,) = refused.value.diagnostics
    assert (fault.code, fault.span.line) == ("RG012", 2)
    with pytest.raises(DiagnosticError, match="RG012") as refused:
        build(load_config("irb120", overrides={"task": task}))
    assert refused.value.diagnostics[0].span is None


def test_two_data_of_one_name_are_refused():
    names = {"tool.name": "both", "tool.load.mass": 1, "work_object.name": "Both"}
    with pytest.raises(DiagnosticError, match="another datum"):
        build(load_config("irb120", overrides=names))
