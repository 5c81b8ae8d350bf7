"""The generated folder: reproducible, whole, linted, mapped to its templates."""

import hashlib
import json
import os
import re
from dataclasses import replace

import pytest

from rapidgen._data import data_folder
from rapidgen.config import from_manifest, load_config
from rapidgen.config.model import Load, Placement, Tool, WorkObject
from rapidgen.diagnostics import DiagnosticError
from rapidgen.generate import build, compare, write
from rapidgen.generate.context import tool_literal, work_object_literal
from rapidgen.generate.numbers import inward, literal, single
from rapidgen.generate.render import Renderer
from rapidgen.system import parse_cfg, read_folder


@pytest.fixture(scope="module")
def irb120():
    return load_config("irb120")


@pytest.fixture(scope="module")
def output(irb120):
    return build(irb120)


def text_of(output, name):
    (result,) = [f for f in output.files if f.path.endswith(name)]
    return result.data.decode("latin-1")


def test_two_builds_are_equal_byte_for_byte(irb120, output):
    assert build(irb120) == output
    assert build(load_config("irb120")) == output


def test_the_folder_does_not_know_where_it_was_built(irb120, output, tmp_path):
    moved = replace(irb120, path=tmp_path / "elsewhere.yaml")
    assert build(moved) == output


def test_files_and_sums(output):
    manifest = json.loads(text_of(output, "manifest.json"))
    assert output.files[-1].path == "manifest.json"
    listed = {f["path"]: f for f in manifest["files"]}
    assert [f.path for f in output.files[:-1]] == list(listed)
    for file in output.files[:-1]:
        assert listed[file.path]["sha256"] == hashlib.sha256(file.data).hexdigest()
        assert listed[file.path]["size"] == len(file.data)
    for name in ("common", "server", "motionServer", "stateServer", "motion"):
        assert any(re.search(rf"/ROS_{name}\.(mod|sys)$", path) for path in listed)
    assert listed["HOME/rapidgen/ROS_common.sys"]["task"] == [
        "T_ROB1",
        "T_ROS_RECV",
        "T_ROS_SUP",
        "T_ROS_CONTROL",
        "T_ROS_STATE",
    ]


def test_the_manifest_holds_the_configuration(irb120, output):
    manifest = json.loads(text_of(output, "manifest.json"))
    assert from_manifest(manifest["configuration"], irb120.path) == irb120


def test_every_module_carries_the_build_id(output):
    modules = [f for f in output.files if f.kind == "module"]
    assert len(modules) == 10
    for module in modules:
        assert module.data.decode().count(f'"{output.build_id}"') >= 1, module.path


def test_build_id_depends_on_every_input(irb120, output):
    assert build(replace(irb120, state_period=0.05)).build_id != output.build_id
    other_inputs = replace(irb120, inputs=(*irb120.inputs, ("x.yaml", b"")))
    assert build(other_inputs).build_id != output.build_id
    assert re.fullmatch("[0-9a-f]{12}", output.build_id)


def test_set_changes_only_the_named_key(output):
    changed = build(
        load_config("irb120", overrides=["trajectory.capacity=5000", "ports.motion=12000"])
    )
    result = []
    for old, new in zip(output.files, changed.files, strict=True):
        assert old.path == new.path
        if old.kind in ("readme", "manifest"):
            continue
        lines = zip(old.data.splitlines(), new.data.splitlines(), strict=True)
        result += [new_line.strip().decode() for a, new_line in lines if a != new_line]
    ids = [line for line in result if changed.build_id in line]
    remaining = sorted(line for line in result if changed.build_id not in line)
    # One in each module, and one in the reply to HELLO.
    assert len(ids) == 11
    assert remaining == ["CONST num ROS_CAPACITY := 5000;", "LOCAL CONST num PORT := 12000;"]


def test_text_rules(output):
    for module in (f for f in output.files if f.kind == "module"):
        text = module.data.decode("latin-1")
        assert text.endswith("ENDMODULE\n")
        assert "\r" not in text
        assert "\t" not in text
        assert not re.search(r"[ \t]+$", text, re.M), module.path
        assert max(map(len, text.splitlines())) <= 120, module.path
        code = re.sub(r'"(?:[^"\\]|\\..)*"|!.*', "", text)
        assert max(map(len, re.findall(r"[A-Za-z]\w*", code))) <= 32
        assert "TODO" not in text
        assert "\n\n\n" not in text, module.path
    for cfg in (f for f in output.files if f.kind == "cfg"):
        assert cfg.data.count(b"\r\n") == cfg.data.count(b"\n") > 0
        assert parse_cfg(cfg.data).version[0] == 6


def test_lines_lead_to_their_template(output, tmp_path):
    write(output, tmp_path / "irb120")
    system = read_folder(tmp_path / "irb120")
    checked = 0
    for task in system.tasks:
        for module in task.modules:
            lines = module.data.decode("latin-1").splitlines()
            assert [line for line, _, _ in module.origin] == list(range(1, len(lines) + 1))
            for number, template, at in module.origin:
                source = (data_folder("templates") / template).read_text().splitlines()[at - 1]
                if "{{" not in source and "{%" not in source:
                    assert source == lines[number - 1]
                    checked += 1
    assert checked > 1000


def test_an_edited_module_has_no_map(output, tmp_path):
    write(output, tmp_path / "irb120")
    path = tmp_path / "irb120/HOME/rapidgen/ROS_motion.mod"
    path.write_bytes(b"! edited\n" + path.read_bytes())
    modules = read_folder(tmp_path / "irb120").tasks[0].modules
    motion = next(m for m in modules if m.name == "ROS_motion")
    assert motion.origin == ()
    assert motion.data.startswith(b"! edited")


def test_an_undefined_name_is_an_error(tmp_path):
    import jinja2

    (tmp_path / "x.j2").write_text("{{ missing }}")
    with pytest.raises(jinja2.UndefinedError):
        Renderer(tmp_path).render("x.j2")


@pytest.mark.parametrize("name", ["zelle_ü", "ячейка"])
def test_text_beyond_ascii_is_refused_with_the_reason(irb120, name):
    """It stands in comments; a virtual 6.15 did not load a system module for one character."""
    with pytest.raises(DiagnosticError) as caught:
        build(replace(irb120, name=name))
    result = caught.value.diagnostics[0]
    assert result.code == "RG101"
    assert "did not load" in result.notes[0]


def test_files_for_a_controller_are_ascii(irb120):
    """Names of joints may be anything: they are not written."""
    first, *others = irb120.groups[0].joints
    group = replace(irb120.groups[0], joints=(replace(first, name="drehung_ü"), *others))
    for file in build(replace(irb120, groups=(group,))).files:
        assert file.kind == "readme" or file.data.isascii(), file.path


def test_names_too_long_for_rapid_are_refused(irb120):
    tool = Tool(name="gripper_for_heavy_castings_of_line_7")
    group = replace(irb120.groups[0], tool=tool)
    with pytest.raises(DiagnosticError) as caught:
        build(replace(irb120, groups=(group,)))
    assert {d.code for d in caught.value.diagnostics} == {"RG101"}
    assert tool.name in caught.value.diagnostics[0].label


def test_measured_figures_fit_into_lines(irb120):
    """As a calibration or LoadIdentify gives them. RAPID is free-format [K §2.1], and a controller
    that saves a PERS writes as many digits."""
    measured = Placement(
        (0.1234567, -0.7654321, 1.2345678), (0.5123456, -0.5234567, 0.4765432, -0.4863215)
    )
    load = Load(
        3.4567891, measured.position, measured.orientation, (0.0123456, 0.0234567, 0.0345678)
    )
    tools = [
        Tool("torch_of_the_second_station_left", frame=measured, load=load),
        Tool("other", frame=measured, load=load),
    ]
    group = replace(
        irb120.groups[0],
        tool=tools[0],
        work_object=WorkObject("fixture", user_frame=measured, object_frame=measured),
        tools=(tools[1],),
        work_objects=(WorkObject("fixture_2", user_frame=measured, object_frame=measured),),
    )
    output = build(replace(irb120, groups=(group,)))
    motion = "".join(text_of(output, "ROS_motion.mod").split())
    assert f"TASKPERStooldata{tools[0].name}:={tool_literal(tools[0])};" in motion
    assert f"TASKPERSwobjdatafixture:={work_object_literal(group.work_object)};" in motion


# -- writing ---------------------------------------------------------------------------------


def test_write_compare_and_replace(output, tmp_path):
    folder = tmp_path / "deep/irb120"
    assert [c.path for c in compare(output, folder)] == sorted(f.path for f in output.files)
    write(output, folder)
    assert compare(output, folder) == []
    (folder / "HOME/rapidgen/old.mod").write_text("stale")
    # It is an earlier build's own: the manifest lists it.
    manifest = json.loads((folder / "manifest.json").read_bytes())
    manifest["files"].append({"path": "HOME/rapidgen/old.mod"})
    (folder / "manifest.json").write_text(json.dumps(manifest))
    (folder / "SYS.cfg").write_text("edited")
    changed = ["HOME/rapidgen/old.mod", "SYS.cfg", "manifest.json"]
    assert [c.path for c in compare(output, folder)] == changed
    write(output, folder)
    assert compare(output, folder) == []
    assert os.listdir(folder.parent) == ["irb120"]


def test_a_foreign_folder_is_not_touched(output, tmp_path):
    (tmp_path / "thesis.txt").write_text("years of work")
    with pytest.raises(DiagnosticError) as caught:
        write(output, tmp_path)
    assert caught.value.diagnostics[0].code == "RG102"
    assert os.listdir(tmp_path) == ["thesis.txt"]


@pytest.mark.parametrize("fail_at", [0, 1])
def test_a_failed_write_leaves_the_old_output_whole(output, irb120, tmp_path, monkeypatch, fail_at):
    folder = tmp_path / "irb120"
    write(output, folder)
    rename, calls = os.rename, []

    def failing(source, target):
        calls.append(source)
        if len(calls) == fail_at + 1:
            raise OSError(28, "No space left on device")
        rename(source, target)

    monkeypatch.setattr("rapidgen.generate.output.os.rename", failing)
    with pytest.raises(DiagnosticError) as caught:
        write(build(replace(irb120, state_period=0.05)), folder)
    assert caught.value.diagnostics[0].code == "RG103"
    assert compare(output, folder) == []
    assert os.listdir(tmp_path) == ["irb120"]


# -- numbers ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("value", "text"),
    [(0, "0"), (-165, "-165"), (0.1, "0.1"), (1 / 3, "0.33333334"), (9e9, "9E9"), (1e-7, "1E-7"),
     (250.25, "250.25"), (-0.0, "0")],
)  # fmt: skip
def test_literals_are_the_shortest_that_read_back(value, text):
    assert literal(value) == text
    assert single(float(literal(value))) == single(value)


@pytest.mark.parametrize("value", [float("nan"), float("inf"), 1e39])
def test_literal_beyond_a_num_is_refused(value):
    with pytest.raises((ValueError, OverflowError)):
        literal(value)


def test_limits_are_rounded_inwards():
    assert inward(164.99999999, up=False) == 165
    assert inward(123.45678, up=False) == 123.4567
    assert inward(-123.45678, up=True) == -123.4567
