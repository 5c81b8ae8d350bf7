"""xacro without ROS: packages, macros, hostile XML, restored names."""

import os
import sys

import pytest

from rapidgen.config import load_config
from rapidgen.config.urdf.packages import PackageNotFound, Packages
from tests.refusal import refusal, refused

XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'


def body(prefix=""):
    parts = [f'<link name="{prefix}l0"/>']
    for n in range(1, 7):
        parts.append(
            f'<link name="{prefix}l{n}"/><joint name="{prefix}joint_{n}" type="revolute">'
            f'<parent link="{prefix}l{n - 1}"/><child link="{prefix}l{n}"/><axis xyz="0 0 1"/>'
            '<limit lower="-1" upper="1" velocity="1" effort="0"/></joint>'
        )
    return "".join(parts)


def package(folder, name):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "package.xml").write_text(f"<package><name>{name}</name></package>")
    return folder


def codes(path, **options):
    return refused(load_config, path, **options)


def configure(tmp_path, more=""):
    path = tmp_path / "cell.yaml"
    path.write_text(f"urdf:\n  file: robot.xacro\n{more}")
    return path


INCLUDE = f'<robot name="r" {XACRO}><xacro:include filename="$(find arm_pkg)/arm.xacro"/></robot>'


@pytest.fixture
def arm_package(tmp_path):
    """A package whose folder is not called like it."""
    folder = package(tmp_path / "elsewhere" / "checkout", "arm_pkg")
    (folder / "arm.xacro").write_text(f"<robot {XACRO}>{body()}</robot>")
    (tmp_path / "cell").mkdir()
    (tmp_path / "cell" / "robot.xacro").write_text(INCLUDE)
    return folder


def test_a_package_from_the_configuration(arm_package, tmp_path):
    path = configure(tmp_path / "cell", "  packages: {arm_pkg: ../elsewhere/checkout}")
    config = load_config(path)
    assert [name for name, _ in config.inputs] == ["cell.yaml", "robot.xacro", "arm.xacro"]


def test_a_package_from_the_command_line(arm_package, tmp_path):
    path = configure(tmp_path / "cell")
    assert codes(path) == ["RG032"]
    assert load_config(path, package_paths=[tmp_path / "elsewhere"])


@pytest.mark.parametrize("way", ["command line", "ROS_PACKAGE_PATH"])
def test_a_package_path_may_be_relative(arm_package, tmp_path, monkeypatch, way):
    path = configure(tmp_path / "cell")
    monkeypatch.chdir(tmp_path)
    if way == "ROS_PACKAGE_PATH":
        monkeypatch.setenv(way, "elsewhere")
    config = load_config(path, package_paths=["elsewhere"] if way == "command line" else [])
    assert len(config.groups[0].joints) == 6


def test_a_package_from_ros_package_path(arm_package, tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_PACKAGE_PATH", os.pathsep.join(["/none", str(tmp_path / "elsewhere")]))
    assert load_config(configure(tmp_path / "cell"))


def test_a_package_from_ament(tmp_path, monkeypatch):
    (tmp_path / "robot.xacro").write_text(INCLUDE)
    share = tmp_path / "install" / "share"
    marker = share / "ament_index" / "resource_index" / "packages" / "arm_pkg"
    marker.parent.mkdir(parents=True)
    marker.touch()
    (share / "arm_pkg").mkdir()
    (share / "arm_pkg" / "arm.xacro").write_text(f"<robot {XACRO}>{body()}</robot>")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "install"))
    assert load_config(configure(tmp_path))


def test_a_neighbour_of_the_files_own_package(arm_package, tmp_path):
    own = package(tmp_path / "elsewhere" / "cell_description", "cell_description")
    (own / "urdf").mkdir()
    (own / "urdf" / "robot.xacro").write_text(INCLUDE)
    assert load_config(configure(own / "urdf"))


def test_the_configuration_goes_before_the_search(tmp_path):
    one = package(tmp_path / "one" / "p", "p")
    two = package(tmp_path / "two" / "p", "p")
    packages = Packages({"p": one}, [tmp_path / "two"], tmp_path, {})
    assert packages.find("p") == one
    assert Packages({}, [tmp_path / "two"], tmp_path, {}).find("p") == two
    with pytest.raises(PackageNotFound, match="does not exist"):
        Packages({"p": tmp_path / "three"}, [tmp_path / "two"], tmp_path, {}).find("p")


def test_replaced_names_of_xacro_are_restored(arm_package, tmp_path):
    import xacro
    from xacro import substitution_args

    before = (xacro.parse, substitution_args._eval_find, substitution_args._eval_dict["find"])
    load_config(configure(tmp_path / "cell"), package_paths=[tmp_path / "elsewhere"])
    codes(configure(tmp_path / "cell"))
    after = (xacro.parse, substitution_args._eval_find, substitution_args._eval_dict["find"])
    assert before == after


MACRO = (
    f'<robot {XACRO}><xacro:macro name="arm" params="prefix *origin size:=1 kind">'
    f"{body('${prefix}')}</xacro:macro></robot>"
)


def test_a_macro_is_called_through_a_wrapper(tmp_path):
    (tmp_path / "robot.xacro").write_text(MACRO)
    path = configure(tmp_path, "  macro: arm\n  macro_args: {kind: small, prefix: a_}\n")
    assert load_config(path).groups[0].joints[0].name == "a_joint_1"
    path = configure(tmp_path, "  macro: arm\n  macro_args: {kind: small}\n")
    assert load_config(path).groups[0].joints[0].name == "joint_1"


def test_macro_without_arguments_lists_them(tmp_path):
    (tmp_path / "robot.xacro").write_text(MACRO)
    assert codes(configure(tmp_path, "  macro: arm\n  macro_args: {knid: x}\n")) == ["RG056"] * 2
    assert codes(configure(tmp_path, "  macro: amr\n")) == ["RG031"]


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (f'<robot name="$(arg who)" {XACRO}>{body()}</robot>', "RG061"),
        (f'<robot name="${{undefined}}" {XACRO}>{body()}</robot>', "RG061"),
        (f'<robot name="${{1/0}}" {XACRO}>{body()}</robot>', "RG061"),
        (f'<robot {XACRO}><xacro:include filename="none.xacro"/></robot>', "RG060"),
        ('<robot name="r"><xacro:if value="1"/></robot>', "RG060"),
        (
            f'<robot {XACRO}><xacro:macro name="m"><xacro:m/></xacro:macro><xacro:m/></robot>',
            "RG061",
        ),
        (f'<robot {XACRO}><xacro:arg name="a"/></robot>', "RG061"),
        (f"<robot {XACRO}><link", "RG060"),
        (f"<machine {XACRO}/>", "RG060"),
        (f"<robot {XACRO}/>", "RG031"),
        ("", "RG060"),
    ],
)
def test_failed_expansion_is_one_finding(tmp_path, text, code):
    (tmp_path / "robot.xacro").write_text(text)
    assert codes(configure(tmp_path)) == [code]


def test_an_argument_can_be_given(tmp_path):
    (tmp_path / "robot.xacro").write_text(f'<robot name="$(arg who)" {XACRO}>{body()}</robot>')
    assert load_config(configure(tmp_path, "  args: {who: me}"))


BOMB = "".join(f'<!ENTITY e{n} "&e{n - 1};&e{n - 1};">' for n in range(1, 40))


@pytest.mark.parametrize(
    "data",
    [
        f'<!DOCTYPE r [<!ENTITY e0 "ha">{BOMB}]><robot name="r">&e39;</robot>'.encode(),
        b'<!DOCTYPE r [<!ENTITY x SYSTEM "file:///etc/passwd">]><robot name="r">&x;</robot>',
        b'<!DOCTYPE r SYSTEM "http://localhost/x.dtd"><robot name="r"/>',
        '<robot name="r"/>'.encode("utf-16"),
        b'<robot name="\xff"/>',
        b"<robot" + b" " * 20_000_001,
        b"",
    ],
)
@pytest.mark.parametrize("name", ["robot.urdf", "robot.xacro"])
def test_hostile_xml_is_refused(tmp_path, data, name):
    (tmp_path / name).write_bytes(data)
    (tmp_path / "cell.yaml").write_text(f"urdf: {{file: {name}}}\n")
    assert codes(tmp_path / "cell.yaml") == ["RG060"]


@pytest.mark.parametrize(
    "inside",
    [
        '<xacro:macro name="a" params="n"><xacro:a n="${n + 1}"/></xacro:macro><xacro:a n="0"/>',
        '<xacro:include filename="robot.xacro"/>',
        "<a>" * 5000 + "</a>" * 5000,
    ],
    ids=["macro", "include", "elements"],
)
def test_nesting_without_end_is_refused_where_rapid_ran_before(tmp_path, inside):
    """Python 3.10 died of it, later ones took minutes: RAPID's stack needs a larger limit."""
    path = configure(tmp_path)
    (tmp_path / "robot.xacro").write_text(f'<robot name="r" {XACRO}>{inside}</robot>')
    limit = sys.getrecursionlimit()
    try:
        sys.setrecursionlimit(20_000)
        assert "nests too deep" in str(refusal(load_config, path))
        assert sys.getrecursionlimit() == 20_000
    finally:
        sys.setrecursionlimit(limit)


def test_hostile_xml_is_refused_in_an_included_file(tmp_path):
    (tmp_path / "robot.xacro").write_text(
        f'<robot name="r" {XACRO}><xacro:include filename="part.xacro"/></robot>'
    )
    (tmp_path / "part.xacro").write_text(f'<!DOCTYPE r [<!ENTITY e0 "ha">{BOMB}]><robot/>')
    assert codes(configure(tmp_path)) == ["RG060"]


def test_a_word_of_a_doctype_in_a_comment_is_harmless(tmp_path):
    text = f'<robot name="r" {XACRO}><!-- <!DOCTYPE r> -->{body()}</robot>'
    (tmp_path / "robot.xacro").write_text(text)
    assert load_config(configure(tmp_path))


def test_a_plain_urdf_takes_no_arguments(tmp_path):
    (tmp_path / "robot.urdf").write_text(f'<robot name="r">{body()}</robot>')
    path = tmp_path / "cell.yaml"
    path.write_text("urdf: {file: robot.urdf, args: {prefix: a_}}\n")
    assert codes(path) == ["RG056"]


def test_places_of_a_plain_urdf_are_its_own_lines(tmp_path):
    text = f'<robot name="r">\n{body()}\n</robot>'.replace('lower="-1"', 'lower="-1,5"', 1)
    (tmp_path / "robot.urdf").write_text(text)
    (tmp_path / "cell.yaml").write_text("urdf: {file: robot.urdf}\n")
    (fault,) = refusal(load_config, tmp_path / "cell.yaml").diagnostics
    assert fault.span is not None
    assert (fault.span.path, fault.span.line) == (str(tmp_path / "robot.urdf"), 2)
    assert "decimal point" in fault.help


COLOURED = (
    f'<robot name="r" {XACRO}>'
    '<xacro:include filename="$(find abb_resources)/urdf/common_materials.xacro"/>{}</robot>'
)
PAINTED = '<link name="hand"><visual><geometry><box size="1 1 1"/></geometry>{}</visual></link>'
HAND = '<joint name="fixed" type="fixed"><parent link="l6"/><child link="hand"/></joint>'


@pytest.mark.parametrize(
    "colours",
    [
        "",
        PAINTED.format("<xacro:material_abb_yellow/>") + HAND,
        PAINTED.format('<material name="m"><xacro:yellow/></material>') + HAND,
        PAINTED.format('<material name="m"><color rgba="${yellow} 1"/></material>') + HAND,
        "<xacro:all_colours/>",
    ],
)
def test_robot_without_the_package_of_its_colours_is_read(tmp_path, colours):
    """Support packages of ROS-Industrial include abb_resources for their colours."""
    (tmp_path / "robot.xacro").write_text(COLOURED.format(body() + colours))
    config = load_config(configure(tmp_path))
    assert len(config.groups[0].joints) == 6
    (warning,) = [d for d in config.diagnostics if d.code == "RG032"]
    assert warning.severity.value == "warning"
    assert "abb_resources" in warning.message
    assert "common_materials.xacro" in warning.message


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("common_materials", "common_parts"),
        ('<link name="l0"/>', "<xacro:base/>"),
        ('xyz="0 0 1"', 'xyz="${up}"'),
        ('<link name="l0"/>', '<link name="l0"/><link name="$(find abb_resources)"/>'),
    ],
)
def test_package_that_gives_more_than_colours_must_be_there(tmp_path, old, new):
    text = COLOURED.format(body() + PAINTED.format("<xacro:material_abb_yellow/>") + HAND)
    assert old in text
    (tmp_path / "robot.xacro").write_text(text.replace(old, new, 1))
    assert codes(configure(tmp_path)) == ["RG032"]
