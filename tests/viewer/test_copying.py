"""Postures as text for a program."""

import json

import pytest

from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config
from rapidgen.viewer.messages import Copy
from rapidgen.viewer.pose_snippets import copied
from rapidgen.viewer.provider import RequestRejected
from rapidgen.viewer.robots import ToolAndWorkObject


def text(name, form, posture):
    group = load_config(name).groups[0]
    kinematics = Kinematics.of(group)
    request = Copy(group=group.name, form=form)
    return copied(request, kinematics.map, kinematics, posture, ToolAndWorkObject.configured(group))


def test_rapid_and_python():
    posture = (0.5235987755982988, -0.1, 0.2, 0.0, -0.0, 3.0)
    assert text("irb120", "jointtarget", posture) == (
        "[[30,-5.7296,11.4592,0,0,171.8873],[9E9,9E9,9E9,9E9,9E9,9E9]]"
    )
    assert json.loads(text("irb120", "python", posture))["joint_1"] == 0.523599
    # The zero of the model's own sheet: flange at x 374, z 630 mm, its z along x of the base.
    assert text("irb120", "robtarget", (0.0,) * 6) == (
        "[[374,0,630],[0.7071068,0,0.7071068,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
    )


def test_external_axes_are_mm():
    axes = load_config("irb120_track").groups[0].joints
    posture = tuple(0.25 if joint.kind == "prismatic" else 0.0 for joint in axes)
    assert text("irb120_track", "jointtarget", posture).endswith(",[250,0,9E9,9E9,9E9,9E9]]")


def test_without_geometry_there_is_no_robtarget():
    group = load_config("irb120").groups[0]
    map = Kinematics.of(group).map
    with pytest.raises(RequestRejected, match="no geometry"):
        copied(
            Copy(group="rob1", form="robtarget"),
            map,
            None,
            (0.0,) * 6,
            ToolAndWorkObject.configured(group),
        )
