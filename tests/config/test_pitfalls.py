"""Pitfalls of 303 public models of ABB robots, each on a small URDF."""

import math

import pytest

from rapidgen.config import load_config
from rapidgen.diagnostics import Severity
from tests.config.drawing import (
    BASE,
    DEGREE,
    SIX,
    XACRO,
    arm,
    axes,
    errors,
    joint,
    links,
    only,
    robot,
    six,
)


def test_a_plain_robot_has_no_findings(check):
    config, result = check(robot(BASE, arm()))
    assert not result
    assert axes(config) == {f"joint_{n}": f"rax_{n}" for n in range(1, 7)}
    assert [link.joint for link in config.groups[0].chain] == list(axes(config))


def test_01_a_macro_file_is_an_empty_robot(check):
    macro = f'<xacro:macro name="arm" params="prefix size:=3">{BASE}{arm()}</xacro:macro>'
    text = f"<robot {XACRO}>{macro}</robot>"
    fault = only("RG031", check(text, suffix=".xacro"))
    assert "arm(prefix, size=)" in fault.message
    assert "macro: arm" in fault.help


def test_02_find_without_the_package(check):
    include = '<xacro:include filename="$(find nowhere_pkg)/a.xacro"/>'
    text = f'<robot name="r" {XACRO}>{include}</robot>'
    fault = only("RG032", check(text, suffix=".xacro"))
    assert "'nowhere_pkg'" in fault.message
    assert "searched" in fault.message
    assert "packages: {nowhere_pkg: FOLDER}" in fault.help


@pytest.mark.parametrize("left", ['<macro name="m"/>', '<include filename="a"/>'])
def test_03_unprefixed_tags_are_left_over(check, left):
    text = (
        robot(BASE, arm())
        .replace("<robot ", f"<robot {XACRO} ")
        .replace("<link", left + "<link", 1)
    )
    only("RG033", check(text, suffix=".xacro"))


def test_03_expressions_in_a_plain_urdf_have_their_line(check):
    fault = only(
        "RG033", check(robot(BASE, "\n", arm(), "\n", joint("${name}", "link_6", "x"), links("x")))
    )
    assert fault.span.line == 3


def test_04_order_in_the_chain_is_not_the_order_of_numbers(check):
    names = [f"joint_{n}" for n in (1, 3, 2, 4, 5, 6)]
    fault = only("RG034", check(robot(BASE, arm(names))))
    assert "'joint_3': it is number 2 in the chain and says 3" in fault.message
    assert "joint_3: {axis: rax_2}" in fault.help  # an arm's axes follow one another


def test_04_document_order_does_not_matter(check):
    parts = [joint(f"joint_{n}", f"l{n - 1}", f"l{n}") for n in (4, 1, 6, 2, 5, 3)]
    config, result = check(robot(links(*(f"l{n}" for n in range(7))), *parts))
    assert not result
    assert list(axes(config)) == [f"joint_{n}" for n in range(1, 7)]


def test_05_numbers_off_by_one(check):
    only("RG035", check(robot(BASE, arm([f"joint_{n}" for n in range(2, 8)]))))


def test_06_prefix_is_resolved_and_reported(check):
    config, result = check(robot(BASE, arm([f"cell_joint_{n}_a" for n in range(1, 7)])))
    assert not errors(result)
    assert result["RG036"].severity is Severity.WARNING
    assert "cell_joint_1_a = rax_1" in result["RG036"].message
    assert config is not None


def test_06_one_name_that_is_spelt_otherwise(check):
    names = ["joint_1", "joint_2", "joint 3", "joint_4", "joint_5", "joint_6"]
    fault = only("RG034", check(robot(BASE, arm(names))))
    assert fault.message.endswith("'joint 3': it is not spelt like 'joint_1'")


def test_06_names_with_blanks_are_mapped_by_hand(check):
    names = [f"Revolute {n}" for n in (14, 15, 16, 17, 18, 19)]
    text = robot(BASE, arm(names))
    _, result = check(text)
    assert '"Revolute 14"' in result["RG035"].help
    lines = "\n".join(f'  "{name}": {{axis: rax_{n}}}' for n, name in enumerate(names, 1))
    config, result = check(text, f"joints:\n{lines}")
    assert not result
    assert axes(config)["Revolute 16"] == "rax_3"


def test_07_degrees_in_place_of_radians(check):
    fault = only("RG037", check(six(lower=-165, upper=165)))
    assert "looks like degrees" in fault.message


def test_07_the_widest_real_axis_passes(check):
    config, result = check(six(lower=-460 * DEGREE, upper=460 * DEGREE))
    assert not errors(result)
    assert config.groups[0].joints[2].upper == pytest.approx(460 * DEGREE, abs=0.01 * DEGREE)


def test_07_a_speed_of_degrees_is_a_warning(check):
    _, result = check(six(velocity=46))
    assert result["RG037"].severity is Severity.WARNING


@pytest.mark.parametrize(
    ("kind", "velocity", "code", "messages", "speed"),
    [
        ("prismatic", 1, None, "", 1.0),
        ("prismatic", 46, None, "", 46.0),  # 46 m/s are no degrees per second
        ("prismatic", 49.9, None, "", 49.9),
        ("prismatic", 50, "RG039", "50 m/s looks like a placeholder", 50.0),
        ("prismatic", 0, "RG039", "the velocity 0", None),
        ("revolute", 45, None, "", 45.0),
        ("revolute", 45.1, "RG037", "45.1 rad/s looks like degrees per second", 45.1),
        ("revolute", 50, "RG039", "50 rad/s looks like a placeholder", 50.0),
    ],
)
def test_07_and_09_speeds_of_linear_and_turning_axes(check, kind, velocity, code, messages, speed):
    track = joint("track", "base_link", "rail", kind, lower=0, upper=2, velocity=velocity)
    config, result = check(
        robot(BASE, arm(), track, links("rail")), f"{SIX}\n  track: {{axis: eax_a}}"
    )
    text = {c: d for c, d in result.items() if c in ("RG037", "RG039")}
    assert set(text) == ({code} if code else set())
    if code:
        assert messages in text[code].message
    if speed is not None:
        assert next(j for j in config.groups[0].joints if j.name == "track").speed == (
            pytest.approx(speed)
        )


@pytest.mark.parametrize("missing", [{"limit": False}, {"lower": None}, {"velocity": None}])
def test_08_missing_limits(check, missing):
    only("RG038", check(six(**missing)))
    config, result = check(
        six(**missing),
        "joints:\n"
        + "\n".join(
            f"  joint_{n}: {{axis: rax_{n}, lower: -10, upper: 10, speed: 5}}" for n in range(1, 7)
        ),
    )
    assert not errors(result)
    assert config.groups[0].joints[2].upper == math.radians(10)


@pytest.mark.parametrize("figures", [{"velocity": 0}, {"lower": 0, "upper": 0}])
def test_09_placeholders_are_errors(check, figures):
    only("RG039", check(six(**figures)))


def test_09_a_velocity_of_100_is_a_warning_and_unsure(check):
    config, result = check(six(velocity=100))
    assert result["RG039"].severity is Severity.WARNING
    assert config.groups[0].joints[2].unsure


def test_10_a_continuous_robot_axis(check):
    fault = only("RG040", check(six(kind="continuous")))
    assert 'joint_3: {lower: "???", upper: "???"}' in fault.help


def test_10_a_continuous_external_axis_is_an_independent_one(check):
    text = robot(BASE, arm(), joint("table", "base_link", "top", "continuous"), links("top"))
    config, result = check(text, f"{SIX}\n  table: {{axis: eax_a}}")
    assert result["RG040"].severity is Severity.WARNING
    assert axes(config)["table"] == "eax_a"


@pytest.mark.parametrize(
    ("given", "wanted"), [("lower: -90", (-90, None)), ("upper: 45", (None, 45))]
)
def test_10_one_end_of_a_range_leaves_the_other_without_end(check, given, wanted):
    text = robot(BASE, arm(), joint("table", "base_link", "top", "continuous"), links("top"))
    config, _ = check(text, f"{SIX}\n  table: {{axis: eax_a, {given}}}")
    table = config.groups[0].joints[-1]
    ends = (math.degrees(table.lower), math.degrees(table.upper))
    assert ends == pytest.approx((wanted[0] or -18000, wanted[1] or 18000))


SCARA = "joints:\n" + "\n".join(
    f"  joint_{n}: {{axis: rax_{n}{', unit: mm' if n == 3 else ''}}}" for n in range(1, 5)
)


def scara(lower, upper):
    return robot(
        BASE,
        arm(["joint_1", "joint_2"]),
        joint("joint_3", "link_2", "link_3", "prismatic", lower=lower, upper=upper, velocity=1),
        joint("joint_4", "link_3", "link_4"),
        links("link_3", "link_4"),
    )


def test_11_metres_become_millimetres_with_a_note(check):
    config, result = check(scara(-0.18, 0), SCARA)
    assert result["RG041"].severity is Severity.INFO
    third = config.groups[0].joints[2]
    assert (third.kind, third.lower, third.upper, third.speed) == ("prismatic", -0.18, 0, 1.0)


@pytest.mark.parametrize(
    ("lower", "upper", "severity"),
    [(0, 180, Severity.ERROR), (0, 0.0005, Severity.ERROR), (0, 60, Severity.WARNING)],
)
def test_11_strokes_that_are_none(check, lower, upper, severity):
    _, result = check(scara(lower, upper), SCARA)
    assert result["RG041"].severity is severity


def test_11_a_unit_that_contradicts_the_joint(check):
    only("RG041", check(scara(-0.18, 0), SCARA.replace("unit: mm", "unit: deg")))


def mimicking(of="joint_3", kind="continuous"):
    more = f'<mimic joint="{of}" multiplier="-1"/>'
    lever = joint("joint_lever", "link_2", "lever", kind, limit=False, more=more)
    return robot(BASE, arm(), lever, links("lever"))


def test_12_mimic_joints_are_left_out(check):
    config, result = check(mimicking())
    assert not result
    assert len(config.groups[0].joints) == 6


def test_12_a_mimic_of_nothing(check):
    only("RG042", check(mimicking("joint_9")))


def test_12_a_mapped_mimic(check):
    lines = "\n".join(f"  joint_{n}: {{axis: rax_{n}}}" for n in (1, 2, 4, 5, 6))
    only("RG042", check(mimicking(), f"joints:\n{lines}\n  joint_lever: {{axis: rax_3}}"))


def test_12_a_mimic_in_the_chain_follows(check):
    inner = joint("joint5b", "link_5", "link_5b", more='<mimic joint="joint_5" multiplier="-1"/>')
    text = robot(
        BASE,
        arm([f"joint_{n}" for n in range(1, 6)]),
        inner,
        joint("joint_6", "link_5b", "link_6"),
        links("link_5b", "link_6"),
    )
    config, result = check(text)
    assert not result
    assert config.groups[0].chain[5].follows == (("joint_5", -1.0),)


def test_12_the_offset_of_a_mimic_in_the_chain_is_kept(check):
    more = '<mimic joint="joint_5" multiplier="2" offset="0.25"/>'
    text = robot(
        BASE,
        arm([f"joint_{n}" for n in range(1, 6)]),
        joint("between", "link_5", "middle", more=more),
        joint("joint_6", "middle", "link_6"),
        links("middle", "link_6"),
    )
    config, _ = check(text)
    link = config.groups[0].chain[5]
    assert link.follows == (("joint_5", 2.0),)
    assert link.rpy == pytest.approx((0, 0, 0.25))
    assert link.xyz == pytest.approx((0, 0, 0.1))


def test_13_a_passive_joint_that_is_not_marked(check):
    still = joint("tail", "link_2", "tail_link", lower=0, upper=0)
    text = robot(BASE, arm(), still, links("tail_link"))
    fault = only("RG043", check(text))
    assert "ignore_joints: [tail]" in fault.help
    config, result = check(text, urdf="  ignore_joints: [tail]")
    assert not result
    assert len(config.groups[0].joints) == 6


def test_13_an_ignored_joint_that_does_not_exist(check):
    only("RG043", check(robot(BASE, arm()), urdf="  ignore_joints: [jiont_7]"))


def test_14_a_gripper(check):
    finger = joint("finger_joint", "link_6", "finger", "prismatic", lower=0, upper=0.025)
    text = robot(BASE, arm(), finger, links("finger"))
    only("RG044", check(text))
    only("RG044", check(text, SIX))
    _, result = check(text, urdf="  ignore_joints: [finger_joint]")
    assert not result


def test_15_seven_joints_need_a_mapping(check):
    names = [f"joint_{n}" for n in (1, 2, 7, 3, 4, 5, 6)]
    text = robot(BASE, arm(names))
    fault = only("RG045", check(text))
    only("RG022", check(text, fault.help))  # nothing tells which it is
    lines = fault.help
    for n in (1, 2, 3, 4, 5, 6):
        lines = lines.replace(f'joint_{n}: {{axis: "???"}}', f"joint_{n}: {{axis: rax_{n}}}")
    config, result = check(text, lines.replace('"???"', "eax_a"))
    assert not result
    assert axes(config)["joint_7"] == "eax_a"


def test_15_two_joints_cannot_drive_one_axis(check):
    names = [f"joint_{n}" for n in range(1, 8)]
    lines = "\n".join(f"  {name}: {{axis: rax_{min(n, 6)}}}" for n, name in enumerate(names, 1))
    only("RG013", check(robot(BASE, arm(names)), f"joints:\n{lines}"))


def track():
    slide = joint("rail", "world", "base_link", "prismatic", lower=0, upper=4.2)
    return robot(links("world", "base_link"), arm(), slide)


def test_16_a_track_under_the_robot_is_external(check):
    fault = only("RG046", check(track()))
    assert "rail" in fault.message
    config, result = check(track(), f"{SIX}\n  rail: {{axis: eax_a, unit: mm}}")
    assert not errors(result)
    assert "its base moves" in result["RG046"].message
    assert config.groups[0].chain[0].joint == "rail"
    assert config.groups[0].joints[6].upper == 4.2


def test_16_a_joint_on_another_branch_is_no_robot_axis(check):
    text = robot(BASE, arm(), joint("table", "base_link", "top"), links("top"))
    lines = "\n".join(f"  joint_{n}: {{axis: rax_{n}}}" for n in range(1, 6))
    more = f"joints:\n{lines}\n  table: {{axis: rax_6}}\n  joint_6: {{axis: eax_a}}"
    only("RG046", check(text, more))


def test_17_a_lever_robot_needs_its_coupling(check):
    text = robot(BASE, arm(), name="abb_irb2400_12_155")
    only("RG047", check(text))
    config, result = check(text, "coupling: 1")
    assert not result
    assert config.groups[0].coupling == 1


def test_17_a_palletiser_of_nobodys_list_needs_its_coupling_too(check):
    text = robot(BASE, arm())
    axes = {1: 1, 2: 2, 3: 3, 6: 6}
    lines = "\n".join(f"  joint_{n}: {{axis: rax_{axis}}}" for n, axis in axes.items())
    passive = "  ignore_joints: [joint_4, joint_5]"
    only("RG047", check(text, f"joints:\n{lines}", urdf=passive))
    only("RG021", check(text, f"coupling: 0\njoints:\n{lines}", urdf=passive))
    saved = "coupling: 0\nheld_axes: {rax_4: 0, rax_5: 30}"
    config, _ = check(text, f"{saved}\njoints:\n{lines}", urdf=passive)
    assert config.groups[0].coupling == 0
    assert [(k.axis, k.must_stand) for k in config.groups[0].kept] == [
        ("rax_4", True),
        ("rax_5", True),
    ]
    fifth = config.groups[0].chain[4]
    assert fifth.rpy[2] == pytest.approx(30 * DEGREE)


def test_17_a_serial_robot_has_none(check):
    _, result = check(robot(BASE, arm(), name="irb6700_200_260"), "coupling: 1")
    assert result["RG047"].severity is Severity.WARNING


def test_20_four_joints(check):
    text = robot(BASE, arm([f"joint_{n}" for n in range(1, 5)]))
    only("RG050", check(text))
    lines = "coupling: 1\njoints:\n" + "\n".join(
        f"  joint_{n}: {{axis: rax_{axis}}}" for n, axis in ((1, 1), (2, 2), (3, 3), (4, 6))
    )
    config, result = check(text, lines)
    assert not result
    assert axes(config)["joint_4"] == "rax_6"


@pytest.mark.parametrize(
    "extra",
    [
        joint("rod", "base_link", "link_3"),  # two parents: a closed loop
        joint("joint_2", "link_6", "x") + links("x"),  # a name twice
        links("link_1"),  # a link twice
        joint("rod", "link_6", "nowhere"),  # undefined child
        joint("rod", "nowhere", "x") + links("x"),  # undefined parent
        joint("back", "link_6", "base_link"),  # a circle
    ],
)
def test_21_no_tree(check, extra):
    only("RG051", check(robot(BASE, arm(), extra)))


def test_21_two_roots_are_a_warning(check):
    config, result = check(robot(BASE, links("world"), arm()))
    assert result["RG051"].severity is Severity.WARNING
    assert config is not None


def two_arms():
    left = arm([f"left_joint_{n}" for n in range(1, 7)], link="left_")
    right = arm([f"right_joint_{n}" for n in range(1, 7)], link="right_")
    return robot(BASE, left, right)


def test_22_two_robots_in_one_description(check):
    fault = only("RG052", check(two_arms()))
    assert "left_6, right_6" in fault.message
    config, result = check(two_arms(), urdf="  tip: right_6")
    assert not errors(result)
    assert axes(config)["right_joint_6"] == "rax_6"


def test_22_a_group_for_each(tmp_path):
    (tmp_path / "robot.urdf").write_text(two_arms())
    (tmp_path / "cell.yaml").write_text(
        "groups:\n"
        "  a: {urdf: {file: robot.urdf, tip: left_6}}\n"
        "  b: {urdf: {file: robot.urdf, tip: right_6}}\n"
    )
    config = load_config(tmp_path / "cell.yaml")
    assert [g.joints[0].name for g in config.groups] == ["left_joint_1", "right_joint_1"]


def test_22_a_tip_that_does_not_exist(check):
    fault = only("RG052", check(two_arms(), urdf="  tip: rihgt_6"))
    assert "right_6" in fault.help


@pytest.mark.parametrize(
    "changes",
    [
        {"kind": "floating", "limit": False},
        {"kind": "planar", "limit": False},
        {"kind": "screw"},
        {"lower": 2, "upper": -2},
        {"lower": "nan"},
        {"upper": "inf"},
        {"upper": "2,9"},
        {"velocity": "fast"},
    ],
)
def test_23_joints_that_cannot_be(check, changes):
    fault = only("RG053", check(six(**changes)))
    assert "joint_3" in fault.message


@pytest.mark.parametrize("kind", ["revolute", "continuous", "prismatic"])
def test_23_an_axis_without_a_direction(check, kind):
    text = six(kind=kind)
    at = text.index('<joint name="joint_3"')
    text = text[:at] + text[at:].replace('<axis xyz="0 0 1"/>', '<axis xyz="0 0 0"/>', 1)
    fault = only("RG053", check(text))
    assert "joint_3" in fault.message
    assert fault.help


@pytest.mark.parametrize("ignored", [False, True])
def test_23_a_joint_that_no_axis_is_needs_no_direction(check, ignored):
    kind = "revolute" if ignored else "fixed"
    more = joint("more", "link_6", "tool0", kind).replace("0 0 1", "0 0 0")
    urdf = "  ignore_joints: [more]" if ignored else ""
    _, result = check(robot(BASE, arm(), more, links("tool0")), urdf=urdf)
    assert not result


@pytest.mark.parametrize("old", [' name="joint_3"', '<parent link="link_2"/>', ' type="revolute"'])
def test_23_missing_parts(check, old):
    text = six()
    at = text.index('<joint name="joint_3"')
    only("RG053", check(text[:at] + text[at:].replace(old, "", 1)))


def test_24_a_limit_rounded_outwards_comes_back(check):
    config, result = check(six(lower=-3.1416, upper=3.1416))
    assert result["RG054"].severity is Severity.INFO
    third = config.groups[0].joints[2]
    assert (third.lower, third.upper) == (-math.pi, math.pi)


def test_24_other_limits_are_rounded_inwards(check):
    config, _ = check(six(lower=-1.4855, upper=2.967))
    third = config.groups[0].joints[2]
    assert math.degrees(third.lower) == pytest.approx(-85.0, abs=1e-9)  # -85.11
    assert math.degrees(third.upper) == pytest.approx(169.99, abs=1e-9)  # 169.9966


@pytest.mark.parametrize(
    ("given", "wanted"), [("lower: -30.1", (-30.1, 80)), ("upper: 20.9", (-80, 20.9))]
)
def test_24_own_limit_stays_and_urdf_completes_the_other(check, given, wanted):
    text = six(lower=-80 * DEGREE, upper=80 * DEGREE)
    config, _ = check(text, f"joints:\n  joint_3: {{{given}, source: fence}}")
    third = config.groups[0].joints[2]
    assert (math.degrees(third.lower), math.degrees(third.upper)) == pytest.approx(wanted)


def test_24_own_limit_is_checked_with_the_urdf_limit(check):
    _, result = check(six(lower=-1.4, upper=1.4), "joints:\n  joint_3: {lower: 85}")
    assert errors(result) == ["RG014"]


def test_25_no_mesh_is_opened(check, tmp_path, monkeypatch):
    import builtins
    import io

    (tmp_path / "link.stl").write_bytes(b"not a mesh")
    opened = []
    original = builtins.open

    def spy(file, *arguments, **options):
        opened.append(str(file))
        return original(file, *arguments, **options)

    monkeypatch.setattr(builtins, "open", spy)
    monkeypatch.setattr(io, "open", spy)
    mesh = '<visual><geometry><mesh filename="{}"/></geometry></visual>'
    text = robot(BASE, arm()).replace(
        '<link name="base_link"/>',
        f'<link name="base_link">{mesh.format("link.stl")}{mesh.format("package://a/b.dae")}</link>',
    )
    config, result = check(text)
    assert not result
    assert config is not None
    assert not [name for name in opened if name.endswith((".stl", ".dae"))]


ARGUMENT = (
    f'<robot name="r" {XACRO}><xacro:arg name="prefix" default=""/>'
    + BASE
    + arm([f"$(arg prefix)joint_{n}" for n in range(1, 7)])
    + "</robot>"
)


def test_26_an_argument_that_no_file_declares(check):
    fault = only("RG056", check(ARGUMENT, urdf="  args: {prefx: a_}", suffix=".xacro"))
    assert "did you mean 'prefix'?" in fault.help
    config, result = check(ARGUMENT, urdf="  args: {prefix: a_}", suffix=".xacro")
    assert not errors(result)
    assert axes(config)["a_joint_1"] == "rax_1"


def test_27_two_packages_of_one_name(check, tmp_path):
    for fork in ("one", "two"):
        folder = tmp_path / "forks" / fork
        folder.mkdir(parents=True)
        (folder / "package.xml").write_text("<package><name>arm_pkg</name></package>")
        (folder / "a.xacro").write_text(f"<robot {XACRO}>{BASE}{arm()}</robot>")
    text = f'<robot name="r" {XACRO}><xacro:include filename="$(find arm_pkg)/a.xacro"/></robot>'
    config, result = check(text, suffix=".xacro", package_paths=[tmp_path / "forks"])
    assert result["RG057"].severity is Severity.WARNING
    assert str(tmp_path / "forks" / "one") in result["RG057"].label
    assert config is not None
