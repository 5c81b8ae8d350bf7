"""Lines printed by findings about descriptions work when pasted.

The result builds and moves correctly, or stays open. Every code from RG031 to RG059 has a case: in
LINES one whose lines are pasted, in WORDS one that shows it has none.
"""

import json
import math
import re
from dataclasses import dataclass, field

import pytest
import yaml

from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config
from rapidgen.diagnostics.pages import codes as known_codes
from rapidgen.generate import build, make_system
from rapidgen.verification.testbench import Bench
from tests.config.drawing import BASE, XACRO, arm, drawn, errors, links, robot

GRIPPER = (
    '<joint name="finger" type="prismatic"><parent link="tool0"/><child link="f"/>'
    '<axis xyz="0 1 0"/><limit lower="0" upper="0.02" velocity="0.1"/></joint>'
)


def renamed(name, names, **more):
    """A shipped model drawn with other joint names, in the order of the chain."""
    text = drawn(name, name_of="x", **more)
    order = [step.joint for step in load_config(name).groups[0].chain if step.joint]
    for old, new in zip(order, names, strict=True):
        text = text.replace(f'name="{old}"', f'name="{new}!"')
    return text.replace("!", "")


def with_gripper(name):
    text = drawn(name, name_of="x")
    return text.replace("</robot>", f"{GRIPPER}{links('f')}</robot>")


def on_track(name):
    text = drawn(name, name_of="x").replace('<parent link="base_link"/>', '<parent link="car"/>')
    track = (
        '<joint name="slide" type="prismatic"><parent link="base_link"/><child link="car"/>'
        '<axis xyz="1 0 0"/><limit lower="0" upper="3" velocity="1"/></joint>'
    )
    return text.replace("</robot>", f"{track}{links('car')}</robot>")


@dataclass(frozen=True)
class Case:
    """A description that yields a finding; `model` is the robot that it describes."""

    code: str
    text: str
    model: str = "irb120"
    config: dict[str, str] = field(default_factory=dict)
    """Further keys, as text; `urdf` is what stands below it."""
    suffix: str = ".urdf"


IRB120 = drawn("irb120", name_of="x")
MACRO = (
    f'<robot {XACRO}><xacro:macro name="arm" params="prefix">'
    f"{IRB120[IRB120.index('>') + 1 : -len('</robot>')]}</xacro:macro></robot>"
)
MAPPED = "joints:\n" + "\n".join(f"  joint_{n}: {{axis: rax_{n}}}" for n in range(1, 7))


def sixth(new):
    """An IRB 120 with another limit of joint_6."""
    start = IRB120.index('<joint name="joint_6"')
    return IRB120[:start] + re.sub("<limit[^>]*/>", new, IRB120[start:], count=1)


def with_part(part):
    return IRB120.replace("</robot>", f"{part}</robot>")


def without_axis_4():
    """A SCARA whose last joint was left out of the export."""
    text = drawn("irb910sc", name_of="x")
    start = text.index('<joint name="joint_4"')
    return text[:start] + text[start:].replace('type="revolute"', 'type="fixed"', 1)


LEVER = with_part(
    '<joint name="lever" type="revolute"><parent link="d1"/><child link="lv"/><axis xyz="0 1 0"/>'
    f'<mimic joint="joint_3"/></joint>{links("lv")}'
)
TWO = robot(
    BASE,
    arm([f"l_joint_{n}" for n in range(1, 7)], link="l"),
    arm([f"r_joint_{n}" for n in range(1, 7)], link="r"),
)
FIND = '<xacro:include filename="$(find abb_arm)/urdf/arm.xacro"/><xacro:arm prefix=""/>'

LINES = {
    "a macro": Case("RG031", MACRO, suffix=".xacro"),
    "a package": Case("RG032", f'<robot name="x" {XACRO}>{FIND}</robot>', suffix=".xacro"),
    "swapped": Case("RG034", renamed("irb120", [f"joint_{n}" for n in (1, 3, 2, 4, 5, 6)])),
    "off by one": Case("RG035", renamed("irb120", [f"joint_{n}" for n in range(2, 8)])),
    "blanks": Case(
        "RG035", renamed("irb1200", [f"Revolute {n}" for n in range(14, 20)]), "irb1200"
    ),
    "no limits": Case("RG038", sixth("")),
    "no speed": Case("RG038", sixth('<limit lower="-6.981317" upper="6.981317"/>')),
    "placeholder": Case("RG039", sixth('<limit lower="0" upper="0" velocity="0"/>')),
    "continuous": Case(
        "RG040",
        IRB120.replace('name="joint_6" type="revolute"', 'name="joint_6" type="continuous"'),
    ),
    "not all mapped": Case(
        "RG043", IRB120, config={"joints": MAPPED.replace("  joint_5: {axis: rax_5}\n", "")}
    ),
    "gripper": Case("RG044", with_gripper("irb120")),
    "gripper, mapped": Case("RG044", with_gripper("irb120"), config={"joints": MAPPED}),
    "seven": Case("RG045", renamed("irb14050", [f"joint_{n}" for n in range(1, 8)]), "irb14050"),
    "seven, in order": Case(
        "RG045", renamed("irb14050", [f"joint_{n}" for n in (1, 2, 7, 3, 4, 5, 6)]), "irb14050"
    ),
    "track": Case("RG046", on_track("irb120")),
    "lever": Case("RG047", drawn("irb2400", name_of="x"), "irb2400"),
    "turned": Case(
        "RG048",
        drawn("crb15000", turned=["rax_3"], mirrored=["rax_3"], name_of="x"),
        "crb15000",
    ),
    "turned, other names": Case(
        "RG035",
        renamed("crb15000", [f"r{n}" for n in range(7, 13)], turned=["rax_3"], mirrored=["rax_3"]),
        "crb15000",
    ),
    "mirrored": Case("RG048", drawn("irb120", mirrored=["rax_3"], name_of="x")),
    "scara": Case("RG050", drawn("irb910sc", name_of="x"), "irb910sc"),
    "scara, three axes": Case("RG034", without_axis_4(), "irb910sc"),
    "two arms": Case("RG052", TWO, ""),
}
WORDS = {
    "left over": Case("RG033", '<robot name="x"><macro name="arm"/></robot>'),
    "prefix": Case("RG036", renamed("irb120", [f"l_joint_{n}" for n in range(1, 7)])),
    "degrees": Case("RG037", sixth('<limit lower="-400" upper="400" velocity="7"/>')),
    "millimetres": Case(
        "RG041",
        on_track("irb120").replace('upper="3"', 'upper="3000"'),
        config={"joints": MAPPED + "\n  slide: {axis: eax_a}"},
    ),
    "mimic": Case("RG042", LEVER, config={"joints": MAPPED.replace("joint_3", "lever")}),
    "wider": Case(
        "RG049",
        IRB120,
        config={"model": "model: irb120", "joints": "joints:\n  joint_1: {upper: 170}"},
    ),
    "loop": Case(
        "RG051",
        with_part(
            '<joint name="rod" type="fixed"><parent link="base_link"/><child link="d3"/></joint>'
        ),
    ),
    "comma": Case("RG053", sixth('<limit lower="-2,9" upper="2.9" velocity="4"/>')),
    "rounded": Case("RG054", sixth('<limit lower="-3.1416" upper="3.1416" velocity="4"/>')),
    "another arm": Case("RG055", drawn("irb1200", name_of="x"), config={"model": "model: irb120"}),
    "argument": Case(
        "RG056", MACRO, config={"urdf": "  macro: arm\n  args: {prefx: a}"}, suffix=".xacro"
    ),
}
ELSEWHERE = {
    "RG057": "tests/config/test_xacro.py: words only, a warning",
    "RG059": "tests/config/test_new.py: only `new` says it, and it makes no driver",
}


def test_every_code_about_descriptions_has_its_case():
    codes = {code for code in known_codes() if "RG031" <= code <= "RG059"}
    tried = {case.code for case in (*LINES.values(), *WORDS.values())}
    assert codes == tried | ELSEWHERE.keys()


def lines_of(help_text):
    """Return the configuration lines of a help text, by key."""
    text = help_text.replace("\n  urdf:\n    ", "\nurdf:\n  ")
    pattern = r"^((?:model|urdf|joints|coupling|held_axes|groups|tool)):.*(?:\n .*)*"
    return {hit[1]: hit[0] for hit in re.finditer(pattern, text, re.MULTILINE)}


def paste(config, help_text):
    """Return a configuration with the lines of a help text replaced."""
    result = lines_of(help_text)
    for key, block in result.items():
        if key == "urdf":
            config["urdf"] = config.get("urdf", "") + block.split("urdf:", 1)[1]
        elif key == "joints" and "joints" in config:
            merged, more = (yaml.safe_load(text)["joints"] for text in (config["joints"], block))
            for joint, figures in more.items():
                merged[joint] = merged.get(joint, {}) | figures
            config["joints"] = f"joints: {json.dumps(merged)}"
        else:
            config[key] = block
    return bool(result)


def load(check, case, config):
    more = "\n".join(v for k, v in config.items() if k != "urdf")
    return check(case.text, more, urdf=config.get("urdf", ""), suffix=case.suffix)


@pytest.mark.parametrize("name", WORDS)
def test_a_finding_without_lines_has_none(check, name):
    case = WORDS[name]
    _, result = load(check, case, case.config)
    assert not lines_of(result[case.code].help)


@pytest.mark.parametrize("name", LINES)
def test_a_printed_line_is_safe_to_paste(tmp_path, check, name):
    case, message = LINES[name], set()
    config = dict(case.config)
    known = load_config(case.model).groups[0] if case.model else None
    for _ in range(6):
        made, result = load(check, case, config)
        if made:
            break
        (first, *_) = errors(result)
        if case.code not in message:
            assert case.code in result, result
        if "???" in config.get("joints", ""):
            assert first == "RG022"
            config["joints"] = answered(config["joints"], known)
            continue
        message.add(first)
        if not paste(config, result[first].help):
            break
        if "FOLDER" in config.get("urdf", ""):
            assert load(check, case, config)[0] is None
            (tmp_path / "arm" / "urdf").mkdir(parents=True)
            (tmp_path / "arm" / "urdf" / "arm.xacro").write_text(MACRO)
            config["urdf"] = config["urdf"].replace("FOLDER", str(tmp_path / "arm"))
    assert case.code in message
    assert made, result
    if known is None:
        assert [j.name for j in made.groups[0].joints] == [f"l_joint_{n}" for n in range(1, 7)]
        return
    own = made.groups[0]
    assert own.coupling == known.coupling
    limits = {j.axis: (j.lower, j.upper) for j in known.joints}
    saved = {axis.axis for axis in own.kept}
    assert limits.keys() <= {j.axis for j in own.joints} | saved
    for joint in own.joints:
        if joint.axis in limits:
            assert (joint.lower, joint.upper) == pytest.approx(limits[joint.axis], abs=2e-4)
    moved_as(own, known)
    with Bench(made, make_system(made, build(made))) as bench:
        bench.assert_moves_through(bench.motion(), bench.wave(3, duration=1.0))
        bench.assert_healthy()


def answered(joints, known):
    """Open lines answered as the robot's data sheet does; a track is eax_a."""
    sheet = {j.axis: j for j in known.joints}

    given = yaml.safe_load(joints)["joints"]
    for name, figures in given.items():
        for figure in [key for key, value in figures.items() if value == "???"]:
            if figure == "axis":
                figures[figure] = "eax_a"
            else:
                joint = sheet[figures.get("axis", f"rax_{name[-1]}")]
                figures[figure] = math.degrees(getattr(joint, figure))
    return f"joints: {json.dumps(given)}"


def moved_as(own, known):
    """Each axis of the controller moves the flange as the model's does."""
    mine, theirs = Kinematics.of(own), Kinematics.of(known)
    driven = {j.axis for j in own.joints}
    for axis in [j.axis for j in known.joints if j.axis in driven]:
        value = {j.axis: 0.0 for j in (*known.joints, *own.joints)} | {axis: 0.2, "rax_2": 0.1}
        place, _ = mine.forward(tuple(value[j.axis] for j in own.joints))
        other, _ = theirs.forward(tuple(value[j.axis] for j in known.joints))
        assert place == pytest.approx(other, abs=1e-9), axis
