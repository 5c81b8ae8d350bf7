"""Overlapping bars of a drawing in one posture.

Within a chain of links or between fixed ones. Bars are thicker than a wrist is long. Their contacts
there say nothing about the robot, and MoveIt could not plan from any start: its Setup Assistant
excludes such pairs as "Default".
"""

from collections.abc import Container, Iterator, Mapping
from itertools import combinations
from xml.etree import ElementTree as ET

import numpy as np

from rapidgen.axes.frames import IDENTITY, ORIGIN, UNIT, Pose, about, compose, from_rpy, transform
from rapidgen.client.trajectory import Array
from rapidgen.config.vectors import Vector, scale

_SHARES = np.linspace(0.0, 1.0, 41)[:, None]


def overlapping(
    root: ET.Element, posture: Mapping[str, float], shaped: Container[str]
) -> Iterator[tuple[str, str]]:
    """Return pairs of links whose bars touch at `posture` (rad or m).

    Only pairs in one chain, or without relative motion. The links `shaped` are no bars.
    """
    joints = {_attribute(joint, "child", "link"): joint for joint in root.iter("joint")}
    bars = {
        link.attrib["name"]: (_line(bar, _pose(link.attrib["name"], joints, posture)), _radius(bar))
        for link in root.iter("link")
        if link.attrib["name"] not in shaped
        and (bar := link.find("collision")) is not None
        and bar.find("geometry/cylinder") is not None
    }
    before = {link: set(_before(link, joints)) for link in bars}
    for one, other in combinations(bars, 2):
        is_chain = one in before[other] or other in before[one]
        if not is_chain and _carrier(one, joints) != _carrier(other, joints):
            continue
        (a, radius), (b, another) = bars[one], bars[other]
        if np.linalg.norm(a[:, None] - b[None], axis=2).min() < radius + another:
            yield one, other


def _before(link: str, joints: Mapping[str, ET.Element]) -> Iterator[str]:
    while link in joints:
        link = _attribute(joints[link], "parent", "link")
        yield link


def _carrier(link: str, joints: Mapping[str, ET.Element]) -> str:
    """Return the link after the last joint that moves."""
    while link in joints and joints[link].attrib["type"] == "fixed":
        link = _attribute(joints[link], "parent", "link")
    return link


def _pose(link: str, joints: Mapping[str, ET.Element], posture: Mapping[str, float]) -> Pose:
    if link not in joints:
        return IDENTITY
    joint = joints[link]
    parent = _pose(_attribute(joint, "parent", "link"), joints, posture)
    at = compose(parent, _origin(joint))
    if joint.find("axis") is None:
        return at
    name, factor = joint.attrib["name"], 1.0
    if joint.find("mimic") is not None:
        name, factor = (
            _attribute(joint, "mimic", "joint"),
            float(_attribute(joint, "mimic", "multiplier")),
        )
    axis, value = _vector(_attribute(joint, "axis", "xyz")), factor * posture.get(name, 0.0)
    if joint.attrib["type"] == "prismatic":
        return compose(at, (scale(axis, value), UNIT))
    return compose(at, (ORIGIN, about(axis, value)))


def _line(bar: ET.Element, link: Pose) -> Array:
    """Points (n, 3) on its axis, m."""
    half = float(_attribute(bar, "geometry/cylinder", "length")) / 2
    at = compose(link, _origin(bar))
    first, last = (np.array(transform(at, (0.0, 0.0, end))) for end in (-half, half))
    line: Array = first + _SHARES * (last - first)
    return line


def _radius(bar: ET.Element) -> float:
    return float(_attribute(bar, "geometry/cylinder", "radius"))


def _origin(element: ET.Element) -> Pose:
    xyz, rpy = (_vector(_attribute(element, "origin", key)) for key in ("xyz", "rpy"))
    return xyz, from_rpy(*rpy)


def _vector(text: str) -> Vector:
    x, y, z = (float(value) for value in text.split())
    return x, y, z


def _attribute(element: ET.Element, path: str, key: str) -> str:
    result = element.find(path)
    assert result is not None
    return result.attrib[key]
