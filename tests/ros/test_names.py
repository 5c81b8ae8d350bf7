"""Names of a configuration stay names in every generated file.

For every reader of the file.
"""

import ast
import re
import xml.etree.ElementTree as ET
from dataclasses import replace

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from ruamel.yaml import YAML

from rapidgen.config import load_config
from rapidgen.config.draft import DescriptionChoices
from rapidgen.config.scaffold import from_urdf, write_new
from rapidgen.config.yaml_text import yaml_flow, yaml_text
from rapidgen.ros.package import CellMember, ros1_package, ros2_cell, ros2_packages

HOSTILE = [
    "null", "Null", "~", "on", "off", "yes", "n", "Y", "True", "1", "-1", "1e3", "0x1", "0o7",
    "1_000", "1:30", "2001-01-01", ".inf", ".nan", "-.INF", "=", "<<", "!t", "&a", "*a", "- a",
    "a: b", "a #b", "#", "{a", "a}", "[a", "a,b", "? a", "|", ">", "%a", "@a", "`a", "'", '"', "''",
    "a\\", "\\n", " a", "a ", "-", "--", "a--b", "a-", "-->", "<!--", "]]>", "<b>", "&amp;", "&x;",
    "$(eval 1)", "$(env HOME)", "${X}", "{{ 1 }}", "{% raw %}", '"""', "'''", "\\N{DASH}",
    "é", "名",    "\N{ROBOT FACE}", "a\N{NO-BREAK SPACE}b", "\N{ZERO WIDTH NO-BREAK SPACE}", "…",
]  # fmt: skip
printed = st.text(
    st.characters(exclude_categories=["Cs", "Cc", "Zl", "Zp", "Cn", "Co"]), min_size=1, max_size=12
)
names = st.lists(
    st.sampled_from(HOSTILE) | printed.filter(str.strip), min_size=6, max_size=6, unique=True
)
folders = st.text(min_size=1, max_size=12) | st.sampled_from(HOSTILE)


def yamls(text):
    """Return the values that readers of YAML 1.1 and of 1.2 get."""
    for version in ((1, 1), (1, 2)):
        yaml = YAML(typ="safe", pure=True)
        yaml.version = version
        yield yaml.load(text)


@settings(max_examples=50)
@given(st.lists(st.text(st.characters(exclude_categories=["Cs"])), min_size=1, max_size=3))
@example(HOSTILE)
def test_a_text_stays_one(texts):
    text, *_ = texts
    for result in yamls(yaml_flow(texts)):
        assert result == texts
    for result in yamls(f"{yaml_text(text)}: {yaml_flow([text, 'x'])}"):
        assert result == {text: [text, "x"]}
    for result in yamls(yaml_flow({text: text, "b": True, "c": 1.5})):
        assert result == {text: text, "b": True, "c": 1.5}


def code(text):
    """The nodes of a Python program without the values of its texts."""
    return [type(node).__name__ for node in ast.walk(ast.parse(text))]


def packages(config, folder):
    """Every kind of package; `folder` is what they are called after."""
    members = [CellMember(config, "one.yaml"), CellMember(replace(config, name="b"), "b.yaml")]
    return {
        "cell": ros2_cell(members, folder),
        "ros2": ros2_packages(config, "it's.yaml", folder, ['joints={"\N{ROBOT FACE}": {}}']),
        "ros1": ros1_package(config, "one.yaml", folder),
    }


PLAIN = packages(load_config("irb120"), "plain")


def check(kind, files):
    """Every file is what its ending says, and has no name in the place of code."""
    plain = {path.rpartition("/")[2]: text for path, text in PLAIN[kind].items()}
    assert len(files) == len(PLAIN[kind])
    for path, text in files.items():
        if path.endswith(".py"):
            assert code(text) == code(plain[path.rpartition("/")[2]])
        elif path.endswith((".xml", ".urdf", ".srdf", ".launch")):
            ET.fromstring(text.encode())
        elif path.endswith((".yaml", ".rviz")):
            old, new = yamls(text)
            assert old == new
        elif path.endswith("CMakeLists.txt"):
            assert re.search(r"^project\([a-z][a-z0-9_]* NONE\)$", text, re.MULTILINE)


def one(files, ending):
    return next(text for path, text in files.items() if path.endswith(ending))


def check_joints(files, names):
    """Files of a package have the joints of the configuration."""
    drawn = {joint.get("name") for joint in ET.fromstring(one(files, ".urdf").encode())}
    assert set(names) <= drawn
    if launch := files.get("launch/robot.launch"):
        lists = [ET.fromstring(launch.encode()).findtext("group/rosparam")]
        return [list(yamls(text)) for text in lists] == [[names, names]]
    for result in yamls(one(files, "joint_limits.yaml")):
        assert [name for name in result["joint_limits"] if name in names] == names
    return True


@settings(max_examples=8)
@given(names, folders, st.from_regex(r"[A-Za-z][A-Za-z0-9_-]{0,39}", fullmatch=True))
@example(HOSTILE[:6], '"""\n1/0\n"""', "a--b")
@example(HOSTILE[6:12], "\x01&<\\N{DASH}", "a-")
def test_packages(joints, folder, name):
    displayed = ", ".join(f"{yaml_text(n)}: {{axis: rax_{i}}}" for i, n in enumerate(joints, 1))
    config = replace(load_config("irb120", overrides=[f"joints={{{displayed}}}"]), name=name)
    assert [joint.name for joint in config.groups[0].joints] == joints
    for kind, files in packages(config, folder).items():
        check(kind, files)
        assert check_joints(files, [("b_" if kind == "cell" else "") + n for n in joints])


def urdf(joints, links):
    """A chain of six axes and a gripper after it."""
    root = ET.Element("robot", name="abb")
    for link in links:
        ET.SubElement(root, "link", name=link)
    for joint, parent, child in zip([*joints, "grip"], links[:-1], links[1:], strict=True):
        kind = "prismatic" if joint == "grip" else "revolute"
        element = ET.SubElement(root, "joint", name=joint, type=kind)
        ET.SubElement(element, "parent", link=parent)
        ET.SubElement(element, "child", link=child)
        ET.SubElement(element, "axis", xyz="0 0 1")
        ET.SubElement(element, "limit", lower="-1", upper="1", velocity="1", effort="0")
    return ET.tostring(root)


IN_URDF = [name for name in HOSTILE if name.isprintable() and "$" not in name]
"""Names that a description may have: no others are read (RG033, RG053)."""


@pytest.mark.parametrize("first", range(0, len(IN_URDF) - 11, 3))
def test_a_new_configuration(tmp_path, first):
    joints, links = IN_URDF[first : first + 6], IN_URDF[first + 6 : first + 12]
    links = ["base", *links, "finger"]
    (tmp_path / "r.urdf").write_bytes(urdf(joints, links))
    axes = {name: f"rax_{number}" for number, name in enumerate(joints, 1)}
    message = DescriptionChoices(joints=axes, coupling=0.0)
    text = from_urdf(tmp_path / "r.urdf", folder=tmp_path, answers=message)
    write_new(tmp_path / "cell.yaml", text)
    assert [j.name for j in load_config(tmp_path / "cell.yaml").groups[0].joints] == joints
    for result in yamls(text):
        assert list(result["joints"]) == joints
        assert result["urdf"]["tip"] == links[6]
