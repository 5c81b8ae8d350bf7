"""Broken and hostile descriptions: short diagnostics with a fix, quickly."""

import os

import pytest

from rapidgen.cli.configuration import new
from rapidgen.config import load_config
from rapidgen.diagnostics import DiagnosticError, render
from tests.config.drawing import BASE, XACRO, arm, drawn, joint, links, only, robot, six

FOUR_KB = 4000


def refused(tmp_path, text, name="robot.urdf"):
    """What `new` and the configuration say of a description; both are short."""
    (tmp_path / name).write_text(text)
    (tmp_path / "cell.yaml").write_text(f"urdf: {{file: {name}}}\n")
    messages = []
    for ask in (
        lambda: load_config(tmp_path / "cell.yaml"),
        lambda: new(tmp_path / "made.yaml", urdf=tmp_path / name, force=True),
    ):
        with pytest.raises(DiagnosticError) as caught:
            ask()
        assert len(render(caught.value.diagnostics)) < FOUR_KB
        without = [d.message for d in caught.value.diagnostics if not d.help]
        assert [words for words in without if not words.startswith("and ")] == []
        messages.append({d.code: d for d in caught.value.diagnostics})
    return messages


@pytest.mark.parametrize("count", [200, 2000, 20000])
def test_very_many_joints(tmp_path, count):
    first, _ = refused(tmp_path, robot(BASE, arm([f"a{n}" for n in range(count)])))
    assert set(first) == {"RG043"}
    assert f"{count:,}" in first["RG043"].message or str(count) in first["RG043"].message


def test_very_many_faults(tmp_path):
    text = robot(BASE, arm([f"a{n}" for n in range(900)], lower="x")) + "\n" * 3
    first, second = refused(tmp_path, text)
    assert set(first) == set(second) == {"RG053"}


def test_very_long_names(tmp_path):
    first, _ = refused(tmp_path, robot(BASE, arm(["j" * 100_000 + str(n) for n in range(1, 7)])))
    assert set(first) == {"RG053"}


@pytest.mark.parametrize("length", ["270", "1e300", "5.1"])
def test_a_chain_of_absurd_length(check, length):
    text = drawn("irb120").replace('xyz="0.0 0.0 0.27"', f'xyz="0.0 0.0 {length}"')
    fault = only("RG062", check(text))
    assert "m long before 'joint_3'" in fault.message


def test_a_chain_of_absurd_length_in_a_configuration(tmp_path):
    step = "chain: [{joint: joint_1}, {joint: joint_2, xyz: [0, 0, 9000]}]\n"
    (tmp_path / "c.yaml").write_text("model: irb120\n" + step)
    with pytest.raises(DiagnosticError) as caught:
        load_config(tmp_path / "c.yaml")
    assert ("RG062", 2) in [(d.code, d.span.line) for d in caught.value.diagnostics]


def test_a_mimic_joint_is_the_reason(tmp_path):
    first, second = refused(tmp_path, six(more='<mimic joint="joint_2"/>'))
    for messages in (first, second):
        assert "'joint_3' mimics 'joint_2'" in messages["RG042"].message
        assert messages["RG042"].span.path.endswith("robot.urdf")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes here")
@pytest.mark.parametrize("what", ["pipe", "folder", "device"])
def test_a_description_is_a_file(tmp_path, what):
    path = tmp_path / "robot.urdf"
    if what == "pipe":
        os.mkfifo(path)
    elif what == "folder":
        path.mkdir()
    else:
        path.symlink_to("/dev/zero")
    (tmp_path / "cell.yaml").write_text("urdf: {file: robot.urdf}\n")
    with pytest.raises(DiagnosticError) as caught:
        load_config(tmp_path / "cell.yaml")
    assert [d.code for d in caught.value.diagnostics] == ["RG060"]


@pytest.mark.parametrize(
    "head",
    ["<?x <!-- ?>", "<!-- a -->", '<?xml version="1.0"?>', "<?x ]]> ?>", "\n\n<?a?><!-- <?b -->"],
)
@pytest.mark.parametrize("name", ["robot.urdf", "robot.xacro"])
def test_document_type_after_any_prefix_is_refused(tmp_path, head, name):
    text = f'{head}<!DOCTYPE r [<!ENTITY e "x">]>{robot(BASE, arm())}<!-- -->'
    first, _ = refused(tmp_path, text, name)
    assert "no document type" in first["RG060"].message


def test_a_document_type_inside_of_a_text_is_none(check):
    text = robot(
        BASE, "<!-- <!DOCTYPE x> -->", '<link name="a"><![CDATA[<!DOCTYPE]]></link>', arm()
    )
    _, result = check(text)
    assert "RG060" not in result


@pytest.mark.parametrize("name", ["a&#10;b", "a&#x9;b", "a&#x85;b", "a&#x200B;b"])
def test_a_name_that_is_not_printed(tmp_path, name):
    first, _ = refused(tmp_path, robot(BASE, arm(), joint(name, "link_6", "x"), links("x")))
    assert set(first) == {"RG053"}


def included(tmp_path, part, top=""):
    (tmp_path / "part.xacro").write_text(f"<robot {XACRO}>\n{part}</robot>")
    return f'<robot name="r" {XACRO}>{top}<xacro:include filename="part.xacro"/>{BASE}</robot>'


@pytest.mark.parametrize(
    ("part", "code", "line"),
    [
        (arm(lower="1,5").replace("<joint", "\n<joint", 1), "RG053", 3),
        ("<link name='a'>", "RG060", 2),
        ("<xacro:nowhere/>", "RG061", 1),
        ("<link name='${1/0}'/>", "RG061", 1),
    ],
)
def test_fault_of_an_included_file_is_reported_there(tmp_path, part, code, line):
    first, second = refused(tmp_path, included(tmp_path, part), "robot.xacro")
    for message in (first, second):
        assert message[code].span.path.endswith("part.xacro"), message[code]
        assert message[code].span.line == line


@pytest.mark.parametrize("name", ["arm\x1b[31m.urdf", "a\nb.urdf", "\udcff.urdf"])
def test_invalid_file_name_is_reported(tmp_path, name):
    path = tmp_path / name
    path.write_text(drawn("irb120"))
    with pytest.raises(DiagnosticError) as caught:
        new(tmp_path / "cell.yaml", urdf=path)
    assert [d.code for d in caught.value.diagnostics] == ["RG020"]
    assert not (tmp_path / "cell.yaml").exists()


@pytest.mark.parametrize(
    ("part", "named"),
    [
        ('<xacro:a name="a"/>', "<xacro:a>"),
        ("<gazebo><model:pose><joint/></model:pose></gazebo>", "<model:pose>"),
        ('<link name="extra" model:kind="a"/>', "model:kind of <link>"),
        ("<model:a/><model:b/>", "<model:a>"),
    ],
)
def test_urdf_with_unbound_prefix_is_read_with_warning(tmp_path, part, named):
    """The URDF parser of ROS (tinyxml2) knows no namespaces and skips such elements."""
    text = robot(BASE, arm(), part)
    (tmp_path / "robot.urdf").write_text(text)
    (tmp_path / "cell.yaml").write_text("urdf: {file: robot.urdf}\n")
    config = load_config(tmp_path / "cell.yaml")
    assert len(config.groups[0].joints) == 6
    (warning,) = [d for d in config.diagnostics if d.code == "RG060"]
    assert warning.severity.value == "warning"
    assert named in warning.message
    assert warning.span.line == text[: text.index(part)].count("\n") + 1


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("<joint ", "<x:group><joint "),
        ("<link ", "<x:link "),
        ("<joint ", "<x:joint "),
        ("<origin", "<x:origin"),
        ("<axis", "<x:axis"),
        ("<robot", "<x:robot"),
    ],
)
def test_unbound_prefix_on_the_chain_is_refused(tmp_path, old, new):
    text = robot(BASE, arm().replace("<axis", '<origin xyz="0 0 0.1"/><axis'))
    tag = old.strip("<").strip()
    before, found, after = text.partition(old)
    assert found
    if "group" in new:
        after = after.replace("</joint>", "</joint></x:group>", 1)
    elif f"</{tag}>" in after and "/>" not in after.split(">")[0] + ">":
        after = after.replace(f"</{tag}>", f"</x:{tag}>", 1)
    first, _ = refused(tmp_path, before + new + after)
    assert set(first) == {"RG060"}
    assert "has no namespace, and the element" in first["RG060"].message
