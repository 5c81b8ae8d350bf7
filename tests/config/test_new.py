"""`rapidgen new`: its output loads, or it reports what is missing.

Then it leaves no file.
"""

import json
import math

import pytest

from rapidgen.cli import terminal, wizard
from rapidgen.cli.configuration import new, robots, schema
from rapidgen.config import load_config, shipped_names
from rapidgen.config.registry import find_shipped
from rapidgen.diagnostics import DiagnosticError
from tests.config.drawing import drawn

URDFS = find_shipped("irb120").parent / "urdf"
XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'


def chain(prefix="", names=range(1, 7)):
    parts = [f'<link name="{prefix}l0"/>']
    for place, n in enumerate(names, 1):
        parts.append(
            f'<link name="{prefix}l{place}"/><joint name="{prefix}joint_{n}" type="revolute">'
            f'<parent link="{prefix}l{place - 1}"/><child link="{prefix}l{place}"/>'
            '<axis xyz="0 0 1"/><limit lower="-1" upper="1" velocity="1" effort="0"/></joint>'
        )
    return "".join(parts)


def codes(*arguments, **options):
    with pytest.raises(DiagnosticError) as caught:
        new(*arguments, **options)
    return [d.code for d in caught.value.diagnostics], caught.value.exit_code


@pytest.mark.parametrize("name", shipped_names())
def test_a_shipped_model(tmp_path, name):
    path = tmp_path / "cell.yaml"
    new(path, robot=name)
    made, known = load_config(path), load_config(name)
    assert made.groups == known.groups
    assert (made.controller, made.robotware) == (known.controller, known.robotware)
    assert made.name == "cell"


@pytest.mark.parametrize("name", shipped_names())
def test_every_comment_that_shows_a_key_is_right(tmp_path, name):
    path = tmp_path / "cell.yaml"
    new(path, robot=name)
    lines = path.read_text(encoding="utf-8").splitlines()
    start = next(i for i, line in enumerate(lines) if line == "# trajectory:")
    path.write_text("\n".join([*lines[:start], *(line[2:] for line in lines[start:])]))
    assert load_config(path).trajectory == load_config(name).trajectory


@pytest.mark.parametrize("name", ["irb120", "irb2400"])
def test_a_plain_urdf(tmp_path, name):
    path = tmp_path / "cell.yaml"
    new(path, urdf=URDFS / f"{name}.urdf")
    made = load_config(path).groups[0]
    known = load_config(name).groups[0]
    assert [j.axis for j in made.joints] == [j.axis for j in known.joints]
    assert made.coupling == known.coupling
    assert [link.joint for link in made.chain] == [link.joint for link in known.chain]


def test_one_macro_is_called_and_packages_are_written_down(tmp_path, monkeypatch):
    package = tmp_path / "ws" / "arm"
    package.mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>arm_pkg</name></package>")
    (package / "parts.xacro").write_text(f"<robot {XACRO}/>")
    (tmp_path / "a_macro.xacro").write_text(
        f'<robot {XACRO}><xacro:include filename="$(find arm_pkg)/parts.xacro"/>'
        f'<xacro:macro name="arm" params="prefix">{chain("${prefix}")}</xacro:macro></robot>'
    )
    path = tmp_path / "cells" / "cell.yaml"
    path.parent.mkdir()
    new(path, urdf=tmp_path / "a_macro.xacro", package_path=[tmp_path / "ws"], coupling=0)
    assert "macro: arm" in path.read_text()
    monkeypatch.chdir(path.parent)
    assert len(load_config("cell.yaml").groups[0].joints) == 6


def test_two_arms_are_two_groups_or_the_one_that_a_tip_leads_to(tmp_path):
    (tmp_path / "r.xacro").write_text(
        f'<robot name="r" {XACRO}><xacro:arg name="side" default="x_"/>'
        f'<link name="world"/>{chain("$(arg side)")}{chain("b_")}'
        + "".join(
            f'<joint name="{p}at" type="fixed"><parent link="world"/><child link="{p}l0"/></joint>'
            for p in ("$(arg side)", "b_")
        )
        + "</robot>"
    )
    path = tmp_path / "cell.yaml"
    new(path, urdf=tmp_path / "r.xacro", arg=["side=a_"], coupling=0)
    assert [g.joints[0].name for g in load_config(path).groups] == ["a_joint_1", "b_joint_1"]
    new(path, urdf=tmp_path / "r.xacro", arg=["side=a_"], tip=["b_l6"], coupling=0, force=True)
    assert [g.joints[0].name for g in load_config(path).groups] == ["b_joint_1"]
    assert codes(path, urdf=tmp_path / "r.xacro", tip=["b_l7"], force=True) == (["RG052"], 2)


def test_arguments_of_a_macro(tmp_path):
    (tmp_path / "r.xacro").write_text(
        f'<robot {XACRO}><xacro:macro name="arm" params="side">{chain("${side}")}'
        "</xacro:macro></robot>"
    )
    path = tmp_path / "cell.yaml"
    assert codes(path, urdf=tmp_path / "r.xacro") == (["RG056"], 2)
    new(path, urdf=tmp_path / "r.xacro", macro_arg=["side=left_"], coupling=0)
    assert load_config(path).groups[0].joints[0].name == "left_joint_1"
    assert codes(path, urdf=tmp_path / "r.xacro", macro_arg=["side"]) == (["RG020"], 2)


@pytest.mark.parametrize(
    ("message", "wanted"),
    [
        ({}, ("omnicore", (7, 10))),
        ({"robotware": "7.20"}, ("omnicore", (7, 20))),
        ({"controller": "virtual", "robotware": "7.6"}, ("virtual", (7, 6))),
    ],
)
@pytest.mark.parametrize("source", ["crb15000", "crb15000_10_152", "urdf"])
def test_a_robot_without_an_irc5_gets_none(tmp_path, source, message, wanted):
    path = tmp_path / "cell.yaml"
    if source == "urdf":
        (tmp_path / "r.urdf").write_text(drawn("crb15000", name_of="gofa"))
        new(path, urdf=tmp_path / "r.urdf", **message)
    else:
        new(path, robot=source, **message)
    config = load_config(path)
    assert (config.controller, config.robotware) == wanted


@pytest.mark.parametrize(
    ("message", "wanted"),
    [
        ({}, ("irc5", (6, 15))),
        ({"robotware": "5.61"}, ("irc5", (5, 61))),
        ({"robotware": "7.6"}, ("omnicore", (7, 6))),
        ({"controller": "omnicore"}, ("omnicore", (7, 10))),
        ({"controller": "irc5_compact", "robotware": "6.08"}, ("irc5_compact", (6, 8))),
    ],
)
@pytest.mark.parametrize("source", ["irb1600", "irb1600_10_145", "urdf"])
def test_controller_and_robotware_are_as_given(tmp_path, source, message, wanted):
    path = tmp_path / "cell.yaml"
    if source == "urdf":
        (tmp_path / "r.urdf").write_text(drawn("irb1600", name_of="x"))
        new(path, urdf=tmp_path / "r.urdf", **message)
    else:
        new(path, robot=source, **message)
    config = load_config(path)
    assert (config.controller, config.robotware) == wanted


def test_an_axis_of_length_0_is_a_finding(tmp_path):
    text = chain().replace('xyz="0 0 1"', 'xyz="0 0 0"', 1)
    (tmp_path / "irb120.urdf").write_text(f'<robot name="irb120">{text}</robot>')
    assert codes(tmp_path / "cell.yaml", urdf=tmp_path / "irb120.urdf") == (["RG053"], 2)
    assert not (tmp_path / "cell.yaml").exists()


def test_unknown_values_are_open_in_the_file(tmp_path):
    (tmp_path / "r.urdf").write_text(
        f'<robot name="irb">{chain(names=(1, 2, 7, 3, 4, 5, 6))}</robot>'
    )
    path = tmp_path / "cell.yaml"
    open_lines = ["RG022"] * 8  # seven axes and the coupling
    assert codes(path, urdf=tmp_path / "r.urdf") == (open_lines, 1)
    with pytest.raises(DiagnosticError) as caught:
        load_config(path)
    assert caught.value.exit_code == 1
    text = path.read_text()
    for axis in ("rax_1", "rax_2", "eax_a", "rax_3", "rax_4", "rax_5", "rax_6"):
        text = text.replace('axis: "???"', f"axis: {axis}", 1)
    path.write_text(text.replace('coupling: "???"', "coupling: 0"))
    assert axes_of(path) == ["rax_1", "rax_2", "eax_a", "rax_3", "rax_4", "rax_5", "rax_6"]


def axes_of(path):
    return [j.axis for j in load_config(path).groups[0].joints]


def test_axes_can_be_given_on_the_command_line(tmp_path):
    (tmp_path / "r.urdf").write_text(f'<robot name="r">{chain(names=range(3, 10))}</robot>')
    path = tmp_path / "cell.yaml"
    message = [f"joint_{n}=rax_{n - 3}" for n in range(4, 10)]
    new(path, urdf=tmp_path / "r.urdf", joint=message, track=["joint_3=eax_a"], coupling=0)
    assert axes_of(path) == ["rax_1", "rax_2", "rax_3", "rax_4", "rax_5", "rax_6", "eax_a"]
    assert codes(path, urdf=tmp_path / "r.urdf", joint=["joint_1=rax_1"]) == (["RG020"], 2)


def test_joint_outside_the_arm_identifies_the_others(tmp_path):
    path, urdf = tmp_path / "cell.yaml", tmp_path / "r.urdf"
    urdf.write_text(f'<robot name="r">{chain(names=(1, 2, 7, 3, 4, 5, 6))}</robot>')
    new(path, urdf=urdf, joint=["joint_7=eax_a"], coupling=0)
    seven = ["rax_1", "rax_2", "rax_3", "rax_4", "rax_5", "rax_6", "eax_a"]
    assert axes_of(path) == seven


def test_fixed_joint_next_to_six_others_is_no_axis(tmp_path):
    path, urdf = tmp_path / "cell.yaml", tmp_path / "r.urdf"
    stuck = chain().replace('lower="-1" upper="1"', 'lower="0" upper="0"')
    seven = chain(names=range(1, 8))
    place = seven.index('lower="-1"', seven.index("joint_6"))
    after = seven[place:].replace('lower="-1" upper="1"', 'lower="0" upper="0"', 1)
    urdf.write_text(f'<robot name="r">{seven[:place]}{after}</robot>')
    new(path, urdf=urdf, coupling=0)
    joints = load_config(path).groups[0].joints
    assert [(j.name, j.axis) for j in joints][-2:] == [("joint_5", "rax_5"), ("joint_7", "rax_6")]
    # All of them stuck is an export without ranges, not an arm without axes.
    urdf.write_text(f'<robot name="r">{stuck}</robot>')
    new(path, urdf=urdf, coupling=0, range_=["-90..90", "joint_6=-300..300"], force=True)
    ends = [j.upper for j in load_config(path).groups[0].joints]
    assert ends == pytest.approx([math.pi / 2] * 5 + [math.pi / 0.6])


SCARA = (
    '<robot name="scara"><link name="base"/><link name="l1"/><link name="l2"/><link name="l3"/>'
    '<joint name="a" type="continuous"><parent link="base"/><child link="l1"/>'
    '<axis xyz="0 0 1"/></joint>'
    '<joint name="b" type="continuous"><parent link="l1"/><child link="l2"/>'
    '<origin xyz="0.29 0 0.2"/><axis xyz="0 0 1"/></joint>'
    '<joint name="c" type="prismatic"><parent link="l2"/><child link="l3"/>'
    '<origin xyz="{x} {y} 0"/><axis xyz="0 0 -1"/><limit lower="0" upper="0.1"/></joint></robot>'
)


def test_scara_export_without_quill_is_recognised_by_its_arms(tmp_path):
    path, urdf = tmp_path / "cell.yaml", tmp_path / "r.urdf"
    urdf.write_text(SCARA.format(x=0.26, y=0))  # 290 and 260 mm: an IRB 920T-6/0.55
    new(path, urdf=urdf, speed=100)
    group = load_config(path).groups[0]
    assert "IRB 920T-6/0.55" in path.read_text()
    assert [round(math.degrees(j.upper)) for j in group.joints[:2]] == [140, 150]
    assert group.joints[2].sign == -1
    assert next((saved.axis, saved.must_stand) for saved in group.kept) == ("rax_4", False)
    urdf.write_text(SCARA.format(x=0, y=0.26))  # bent where the file says 0
    new(path, urdf=urdf, speed=100, force=True)
    offset = next(line for line in path.read_text().splitlines() if line.startswith("  b:"))
    assert "offset: 90" in offset
    urdf.write_text(SCARA.format(x=0.31, y=0))  # unknown arm: two ranges are open
    assert codes(path, urdf=urdf, speed=100, force=True) == (["RG022"] * 4, 1)
    new(path, urdf=urdf, speed=100, range_=["-120..120"], force=True)


@pytest.mark.parametrize("words", ["90", "b=90..", "-90..-90", "joint_9=0..1", "nan..nan"])
def test_a_range_has_two_ends_and_a_joint_that_exists(tmp_path, words):
    (tmp_path / "r.urdf").write_text(SCARA.format(x=0.31, y=0))
    made = codes(tmp_path / "cell.yaml", urdf=tmp_path / "r.urdf", speed=100, range_=[words])
    assert made == (["RG020"], 2)
    assert not (tmp_path / "cell.yaml").exists()


@pytest.mark.parametrize(
    ("name", "mesh", "count", "word"),
    [
        ("iiwa14", "", 7, "'iiwa14'"),
        ("kukaIiwa7", "", 7, "'kuka'"),
        ("arm", "kinova_description", 6, "'kinova'"),
        ("schunk_lwa4p", "", 6, "'schunk'"),
        ("leg", "", 8, "no name contains ABB"),
    ],
)
def test_another_makers_robot_is_reported(tmp_path, name, mesh, count, word):
    path, urdf = tmp_path / "cell.yaml", tmp_path / "r.urdf"
    joints = chain(names=range(1, count + 1))
    shape = f'<link name="m"><visual><geometry><mesh filename="package://{mesh}/m.stl"/>'
    shape = f"{shape}</geometry></visual></link>" if mesh else ""
    urdf.write_text(f'<robot name="{name}">{joints}{shape}</robot>')
    with pytest.raises(DiagnosticError) as caught:
        new(path, urdf=urdf, coupling=0)
    assert [d.code for d in caught.value.diagnostics] == ["RG059"]
    assert word in caught.value.diagnostics[0].message
    assert not path.exists()


def test_an_arm_of_abb_is_one_whatever_its_neighbours_are_called(tmp_path):
    text = (URDFS / "irb120.urdf").read_text().replace('"irb120"', '"ur5"')
    (tmp_path / "ur5.urdf").write_text(text)
    new(tmp_path / "cell.yaml", urdf=tmp_path / "ur5.urdf")


@pytest.fixture
def person(monkeypatch):
    """Answer questions as a user; record them."""
    requested = []

    def answers(*given):
        left = iter(given)

        def prompt(question, default=None, **_):
            requested.append(question)
            answer = next(left)
            return default if answer is None else answer

        monkeypatch.setattr(terminal, "is_terminal", lambda: True)
        monkeypatch.setattr(wizard.typer, "prompt", prompt)
        return requested

    return answers


def test_user_is_asked_for_open_values(tmp_path, person, capsys):
    (tmp_path / "r.urdf").write_text(
        f'<robot name="irb">{chain(names=(1, 2, 7, 3, 4, 5, 6))}</robot>'
    )
    requested = person("axis 1", None, None, "eax_a", "0")
    new(tmp_path / "cell.yaml", urdf=tmp_path / "r.urdf")
    # What is usual comes first; where one is no axis of the arm that identifies the other six.
    joints = load_config(tmp_path / "cell.yaml").groups[0].joints
    assert [(j.name[-1], j.axis) for j in joints] == [
        ("1", "rax_1"), ("2", "rax_2"), ("3", "rax_3"), ("4", "rax_4"), ("5", "rax_5"),
        ("6", "rax_6"), ("7", "eax_a"),
    ]  # fmt: skip
    assert len(requested) == 5
    text = capsys.readouterr().err
    assert "| ?      joint_7" in text
    assert "one of rax_1" in text


def test_a_person_names_the_robot(tmp_path, person):
    person(None)
    new(tmp_path / "cell.yaml")
    assert load_config(tmp_path / "cell.yaml").groups == load_config("irb120").groups
    person(str(URDFS / "irb2400.urdf"))
    new(tmp_path / "cell.yaml", force=True)
    assert load_config(tmp_path / "cell.yaml").groups[0].coupling == 1


@pytest.mark.parametrize(
    ("name", "coupling"),
    [
        ("irb2400_10_150", 1),  # by its name: axes along one line match no arm
        ("irb4600_20_250", 0),
        ("irb8700_550_420", None),
        ("irb580_12", None),
        ("some_arm", None),
    ],
)
def test_a_coupling_is_known_or_open(tmp_path, name, coupling):
    (tmp_path / "r.urdf").write_text(f'<robot name="{name}">{chain()}</robot>')
    path = tmp_path / "cell.yaml"
    if coupling is None:
        assert codes(path, urdf=tmp_path / "r.urdf") == (["RG022"], 1)
    else:
        new(path, urdf=tmp_path / "r.urdf")
        assert load_config(path).groups[0].coupling == coupling


def test_file_is_only_replaced_with_force(tmp_path):
    path = tmp_path / "cell.yaml"
    path.write_text("mine")
    assert codes(path, robot="irb120") == (["RG020"], 1)
    assert path.read_text() == "mine"
    new(path, robot="irb120", force=True)
    assert load_config(path)


def test_one_of_robot_and_urdf(tmp_path):
    assert codes(tmp_path / "c.yaml") == (["RG020"], 2)
    assert codes(tmp_path / "c.yaml", robot="irb120", urdf=URDFS) == (["RG020"], 2)
    assert codes(tmp_path / "c.yaml", robot="irb121") == (["RG009"], 2)
    assert codes(tmp_path / "none" / "c.yaml", robot="irb120") == (["RG001"], 2)
    assert codes(tmp_path / "c.yaml", urdf=tmp_path / "none.urdf") == (["RG060"], 2)


def test_the_list_of_robots(capsys):
    robots()
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == list(shipped_names())
    robots(as_json=True)
    listed = {model["name"]: model for model in json.loads(capsys.readouterr().out)}
    assert listed["irb14000"]["groups"] == {"rob_l": 7, "rob_r": 7}
    assert listed["irb120"]["unsure"] is False


def test_robots_are_filtered_by_words(capsys):
    robots(["palletiser", "rw7"])
    assert [line.split()[0] for line in capsys.readouterr().out.splitlines()] == [
        "irb460",
        "irb660",
    ]
    robots(["4600"])
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("irb4600 ")
    assert any("IRB 4600-20/2.5" in line for line in lines)


# Reach as in the types' names (m), of the wrist centre.
@pytest.mark.parametrize(
    ("name", "reach"),
    [("irb120", 580), ("irb1600", 1225), ("IRB 4600-40/2.55", 2550), ("irb6640", 2800)],
)
def test_a_robot_is_shown_with_axes_reach_and_sources(capsys, name, reach):
    robots(["show", name])
    text = capsys.readouterr().out
    assert text.count("rax_") >= 6
    printed = int(text.split("reach  ")[1].split()[0])
    assert printed == pytest.approx(reach, rel=0.03)
    assert "limits: " in text
    assert "coupling 0" in text


def test_unknown_robot_is_not_shown():
    with pytest.raises(DiagnosticError) as caught:
        robots(["show", "irb9999"])
    assert [d.code for d in caught.value.diagnostics] == ["RG009"]


def test_the_schema_is_json(capsys):
    schema()
    assert json.loads(capsys.readouterr().out)["properties"]["groups"]
