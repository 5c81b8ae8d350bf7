"""What a finding about a description prints is pasted: it builds and moves right, or stays open."""

import re

import pytest

from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.proving.bench import Bench
from tests.config.drawing import drawn, errors, links

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


CASES = {
    "off by one": ("irb120", renamed("irb120", [f"joint_{n}" for n in range(2, 8)])),
    "swapped": ("irb120", renamed("irb120", [f"joint_{n}" for n in (1, 3, 2, 4, 5, 6)])),
    "blanks": ("irb1200", renamed("irb1200", [f"Revolute {n}" for n in range(14, 20)])),
    "turned": (
        "crb15000",
        renamed("crb15000", [f"r{n}" for n in range(7, 13)], turned=["rax_3"], mirrored=["rax_3"]),
    ),
    "seven": ("irb14050", renamed("irb14050", [f"joint_{n}" for n in range(1, 8)])),
    "seven, in order": (
        "irb14050",
        renamed("irb14050", [f"joint_{n}" for n in (1, 2, 7, 3, 4, 5, 6)]),
    ),
    "scara": ("irb910sc", drawn("irb910sc", name_of="x")),
    "gripper": ("irb120", with_gripper("irb120")),
    "track": ("irb120", on_track("irb120")),
    "lever": ("irb2400", drawn("irb2400", name_of="x")),
    "mirrored": ("irb120", drawn("irb120", mirrored=["rax_3"], name_of="x")),
}


def paste(config, help_text):
    """A configuration with the lines of a mend in place of those that it had."""
    blocks = re.findall(r"^(?:urdf|joints|coupling):.*(?:\n .*)*", clean(help_text), re.MULTILINE)
    for block in blocks:
        key = block.split(":")[0]
        if key == "urdf":
            config["urdf"] += block.split("urdf:", 1)[1]
        elif key == "joints" and "joints" in config:
            merged = {line.split(":")[0]: line for line in config["joints"].splitlines()}
            merged |= {line.split(":")[0]: line for line in block.splitlines()[1:]}
            config["joints"] = "\n".join(merged.values())
        else:
            config[key] = block
    return bool(blocks)


def clean(text):
    return text.replace("\n  urdf:\n    ", "\nurdf:\n  ")


@pytest.mark.parametrize("case", CASES)
def test_a_printed_line_is_safe_to_paste(tmp_path, check, case):
    name, text = CASES[case]
    config = {"urdf": ""}
    for _ in range(6):
        joints = config.get("joints", "")
        more = "\n".join(v for k, v in config.items() if k not in ("urdf",))
        made, found = check(text, more, urdf=config["urdf"])
        if made:
            break
        if errors(found) == ["RG022"]:
            config["joints"] = joints.replace('axis: "???", unit: mm', "axis: eax_a, unit: mm")
            continue
        assert paste(config, found[errors(found)[0]].help), found
    assert made, found
    own, known = made.groups[0], load_config(name).groups[0]
    assert own.coupling == known.coupling
    limits = {j.axis: (j.lower, j.upper) for j in known.joints}
    assert limits.keys() <= {j.axis for j in own.joints}
    for joint in own.joints:
        if joint.axis in limits:
            assert (joint.lower, joint.upper) == pytest.approx(limits[joint.axis], abs=2e-4)
    moved_as(own, known)
    with Bench(made, make_system(made, build(made))) as bench:
        bench.moves_through(bench.motion(), bench.wave(3, duration=1.0))
        bench.healthy()


def moved_as(own, known):
    """Each axis of the controller moves the flange as the model's does."""
    mine, theirs = Kinematics.of(own), Kinematics.of(known)
    for axis in [j.axis for j in known.joints]:
        value = {a: 0.0 for a in (j.axis for j in own.joints)} | {axis: 0.2, "rax_2": 0.1}
        place, _ = mine.forward(tuple(value[j.axis] for j in own.joints))
        other, _ = theirs.forward(tuple(value[j.axis] for j in known.joints))
        assert place == pytest.approx(other, abs=1e-9), axis
