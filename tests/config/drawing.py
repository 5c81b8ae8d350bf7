"""Small URDFs for tests: joints, links, arms, and shipped models drawn as their files have them."""

import math

from rapidgen.config import load_config
from rapidgen.diagnostics import Severity

DEGREE = math.pi / 180
XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'


def joint(name, parent, child, kind="revolute", *, limit=True, more="", **limits):
    """One <joint>; limits in the units of the file (rad, m)."""
    given = {"lower": -1.5, "upper": 1.5, "velocity": 2.0, "effort": 0, **limits}
    words = " ".join(f'{key}="{value}"' for key, value in given.items() if value is not None)
    inner = f"<limit {words}/>" if limit and kind != "fixed" else ""
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="0 0 0.1"/><axis xyz="0 0 1"/>{inner}{more}</joint>'
    )


def links(*names):
    return "".join(f'<link name="{name}"/>' for name in names)


def robot(*parts, name="test"):
    return f'<robot name="{name}">{"".join(parts)}</robot>'


def arm(names=None, *, start="base_link", link="link_", kind="revolute", **limits):
    """Joints in one chain with their links (without the first)."""
    names = names or [f"joint_{n}" for n in range(1, 7)]
    parents = [start, *(f"{link}{n}" for n in range(1, len(names)))]
    return "".join(
        joint(name, parent, f"{link}{n}", kind, **limits) + links(f"{link}{n}")
        for n, (name, parent) in enumerate(zip(names, parents, strict=True), 1)
    )


def six(**changes):
    """A plain six-axis robot; `changes` are the parts of joint_3."""
    first = arm([f"joint_{n}" for n in (1, 2)])
    third = joint("joint_3", "link_2", "link_3", **changes) + links("link_3")
    remaining = "".join(
        joint(f"joint_{n}", f"link_{n - 1}", f"link_{n}") + links(f"link_{n}") for n in (4, 5, 6)
    )
    return robot(links("base_link"), first, third, remaining)


BASE = links("base_link")
SIX = "joints:\n" + "\n".join(f"  joint_{n}: {{axis: rax_{n}}}" for n in range(1, 7))


def errors(result):
    return sorted(code for code, d in result.items() if d.severity is Severity.ERROR)


def only(code, checked):
    """Return the one error of a check with this code; it has a help text."""
    assert errors(checked[1]) == [code]
    assert checked[1][code].help
    return checked[1][code]


def axes(config):
    return {j.name: j.axis for j in config.groups[0].joints}


def drawn(name, *, turned=(), mirrored=(), name_of=None):
    """The URDF of a shipped model; some axes drawn the other way round, or ranges mirrored."""
    group = load_config(name).groups[0]
    by_name = {j.name: j for j in group.joints}
    parts, parent = [BASE], "base_link"
    names = [*(f"d{n}" for n in range(len(group.chain) - 1)), "tool0"]
    for n, step in enumerate(group.chain):
        known = by_name.get(step.joint)
        xyz, turn = (" ".join(map(str, v)) for v in (step.xyz, step.rpy))
        axis, limit, kind = "", "", "fixed"
        if known:
            sign = -1 if known.axis in turned else 1
            ends = (known.lower, known.upper)
            lower, upper = (-ends[1], -ends[0]) if known.axis in mirrored else ends
            axis = f'<axis xyz="{" ".join(str(sign * v) for v in step.axis)}"/>'
            limit = f'<limit lower="{lower}" upper="{upper}" velocity="{known.speed}" effort="0"/>'
            kind = "prismatic" if known.kind == "prismatic" else "revolute"
        parts.append(
            f'<joint name="{step.joint or f"fixed_{n}"}" type="{kind}"><parent link="{parent}"/>'
            f'<child link="{names[n]}"/><origin xyz="{xyz}" rpy="{turn}"/>{axis}{limit}</joint>'
        )
        parts.append(links(names[n]))
        parent = names[n]
    return robot(*parts, name=name_of or name)
