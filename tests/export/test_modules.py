"""Programs and trajectories as modules: text, checks, and the run on a virtual controller."""

from dataclasses import replace
from itertools import islice

import pytest

from rapidgen.client import InvalidProgram, Pose, Program, Speed, Trajectory, UserTool, Zone, pulse
from rapidgen.client.core.group import Group
from rapidgen.config import load_config
from rapidgen.controller.module_trial import run_module
from rapidgen.diagnostics import DiagnosticError, Span
from rapidgen.export.writer import WriterOptions
from rapidgen.rapid import format_source
from tools.export_trials import TOLERANCE, trials

BENT = [0.2, 0.1, 0.1, 0.3, 0.6, -0.2]
OVERRIDES = {
    "signals": {"glue": {"kind": "DO", "access": "write"}, "part": {"kind": "DI"}},
    "work_objects": [{"name": "table", "user_frame": {"position": [300, 0, 200]}}],
    "routines.weld": {
        "call": "cell:weld",
        "parameters": [
            {"name": "seam", "type": "num"},
            {"name": "good", "type": "bool", "mode": "inout"},
            {"name": "at", "type": "robtarget"},
        ],
    },
}


@pytest.fixture(scope="module")
def config():
    return load_config("irb120", overrides=OVERRIDES)


@pytest.fixture(scope="module")
def pose(config):
    group = Group.of(config, config.groups[0])
    return Pose(*group.poses.pose(group.map.to_controller(BENT)))


def everything(pose):
    program = Program(speed=0.2, zone="z10").move_joints(BENT)
    program.move_linear(pose.moved(y=0.05)).set("glue").wait(0.5).wait_for("part", timeout=2)
    program.move_circular(
        pose.moved(y=0.05, z=0.03), pose.moved(z=0.06), triggers=pulse("glue", 0.01, 0.02)
    )
    program.allow(singularities=True).call("weld", 7.5, False, pose)
    program.move_to(pose, speed=Speed(0.123, 1.0), zone=Zone.of(0.004))
    return program.use(tool=UserTool(Pose((0.0, 0.0, 0.0)), 0.5)).move_joints(BENT)


def run(exported):
    return run_module(
        exported.module,
        exported.group,
        start=exported.start_values,
        robotware=exported.config.robotware,
        lines=exported.lines,
        spans=exported.spans,
    )


def test_random_programs_follow_the_driver():
    for program, text, apart in islice(trials(4, seed=11), 4):
        assert apart < TOLERANCE, (program.steps, text)


@pytest.mark.parametrize("targets", ["inline", "named", "arrays"])
def test_module_is_formatted_and_runs(config, pose, targets):
    options = WriterOptions(targets, 'TPWrite "begin";', "Stop;", "PROC mine()\nENDPROC")
    exported = everything(pose).to_rapid(config, options=options, module="all", routine="work")
    assert format_source(exported.text) == exported.text
    lines = exported.text.splitlines()
    for number, word in ((0, "MoveAbsJ"), (1, "MoveL"), (2, "SetDO glue, 1;"), (5, "TriggC")):
        assert lines[exported.lines[number] - 1].strip().startswith(word)
    trial, errors = run(exported)
    assert not errors
    assert trial.seconds > 1
    assert set(trial.inferred) >= {"glue", "part", "weld"}


def test_shipped_template_needs_no_formatter(config, pose, monkeypatch):
    """Large programs are not formatted again."""
    complete = everything(pose)
    formatted = complete.to_rapid(config).text
    monkeypatch.setattr("rapidgen.export.writer._MOST_FORMATTED", 0)
    assert complete.to_rapid(config).text == formatted


def test_predefined_names_only_where_they_fit(config, pose):
    program = Program(speed=0.1, zone="z10").move_joints(BENT).move_linear(pose.moved(z=0.05))
    text = (
        program.move_linear(pose, speed=0.1001, zone=0.010).move_joints(BENT).to_rapid(config).text
    )
    assert "v100, z10, tool0;" in text
    # Zone.of(10 mm) is z10 by value; 100.1 mm/s is no predefined speed.
    assert "speed1, z10, tool0;" in text
    assert "CONST speeddata speed1 := [100.1,500,5000,1000];" in text


def test_program_without_joints_begins_at_the_start(config, pose):
    exported = Program().move_linear(pose.moved(z=0.02)).to_rapid(config, start=BENT)
    first, second = (line for line in exported.text.splitlines() if "Move" in line and ";" in line)
    assert first.strip().startswith("MoveAbsJ [[11.45916,")
    assert second.strip().startswith("MoveL")
    assert exported.start == pytest.approx(BENT)


@pytest.mark.parametrize(
    ("options", "report"),
    [
        ({"module": "7up"}, "a name of RAPID is a letter"),
        ({"routine": "moveL"}, "RAPID has a type, a routine or a datum of that name"),
        ({"module": "endproc"}, "reserved word"),
        ({"module": "x" * 33}, "33 characters"),
        ({"module": "same", "routine": "Same"}, "something else has this name"),
        ({"options": WriterOptions(taken=frozenset({"table"}))}, "something else has this name"),
    ],
)
def test_invalid_name_is_rejected(config, options, report):
    program = Program().use(work_object="table").move_joints(BENT)
    with pytest.raises(DiagnosticError) as error:
        program.to_rapid(config, **options)
    (fault,) = error.value.diagnostics
    assert fault.code == "RG750"
    assert report in fault.message


def test_unreachable_pose_is_rejected_with_its_number(config):
    with pytest.raises(InvalidProgram, match="instruction 1: the pose is not reached"):
        Program().move_joints(BENT).move_linear(Pose((5, 0, 0))).to_rapid(config)


def test_template_that_loses_an_instruction_is_rejected(config, tmp_path):
    program = Program().move_joints(BENT).wait(1)
    (tmp_path / "module.mod.j2").write_text(
        "MODULE {{ module }}\nPROC {{ routine }}()\n{{ instructions[0] }}\nENDPROC\nENDMODULE\n"
    )
    with pytest.raises(DiagnosticError, match="has lost instruction 1: WaitTime 1;"):
        program.to_rapid(config, options=WriterOptions(templates=tmp_path))
    (tmp_path / "module.mod.j2").write_text("{{ instructions.__class__ }}{{ nonsense }}")
    with pytest.raises(DiagnosticError, match="RG751"):
        program.to_rapid(config, options=WriterOptions(templates=tmp_path))


def test_trajectory_takes_its_time(config):
    trajectory = Trajectory([0, 1, 2.5], [BENT, [0.3] * 6, [0.1, 0.2, 0, 0.1, 0.5, 0]])
    exported = trajectory.to_rapid(config)
    assert "\\T:=1.5, fine, tool0;" in exported.text
    trial, errors = run(exported)
    assert not errors
    assert trial.seconds == pytest.approx(2.5, abs=0.1)


def test_error_of_the_run_has_the_line_of_the_source(config, pose):
    """A wrong configuration stops the robot: ConfL is on [S4 datasys 3-ConfL]."""
    exported = Program().move_joints(BENT).move_linear(pose.moved(z=0.02)).to_rapid(config)
    wrong = exported.text.replace("[0,0,-1,0]", "[2,2,2,0]")
    assert wrong != exported.text
    broken = replace(
        exported,
        module=replace(exported.module, text=wrong),
        spans=(Span("path.csv", 2, 1), Span("path.csv", 3, 1)),
    )
    _, (error,) = run(broken)
    assert (error.code, error.span.path, error.span.line) == ("RG754", "path.csv", 3)
    assert error.related[0].span.line == exported.lines[1]
