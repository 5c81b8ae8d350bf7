"""README of a build, by generation and driver features."""

import re
from pathlib import PurePosixPath

import pytest

from rapidgen.config import load_config
from rapidgen.generate import build


def readme(name, *overrides):
    config = load_config(name, overrides=tuple(overrides))
    (file,) = [f for f in build(config).files if f.path == "README.md"]
    return file.data.decode("ascii")


@pytest.mark.parametrize(
    ("robot", "overrides", "present", "absent"),
    [
        (
            "irb120",
            (),
            ("X6, WAN", "616-1", "no firewall", "network: {bind: service}", '"alike" in'),
            ("SIO.cfg",),
        ),
        ("irb120", ("controller.robotware=6.03",), ("X6, WAN",), ("CollisionErrorHandling",)),
        (
            "irb120",
            ("controller.robotware=5.15",),
            ("672-1",),
            ("SIO.cfg", "CollisionErrorHandling"),
        ),
        ("irb120", ("network.bind=service",), ("**service port**, 192.168.125.1",), ("X6",)),
        ("irb120", ("network.bind=10.0.0.7",), ("serves 10.0.0.7 and nothing else",), ("X6",)),
        ("irb140_6_81", (), ("X6, WAN",), ("XP23",)),
        ("irb14000", (), ("XP23 is the service port", "604-1"), ("X6",)),
        ("crb15000", (), ("into **WAN**", "3114-1", "`EnableOnPublicNet`", "SIO.cfg"), ("616-1",)),
        ("crb15000", ("network.bind=service",), ("`EnableOnPrivateNet`",), ("PublicNet",)),
    ],
)
def test_socket_options_and_firewall(robot, overrides, present, absent):
    text = readme(robot, *overrides)
    assert [words for words in present if words not in text] == []
    assert [words for words in absent if words in text] == []


@pytest.mark.parametrize("robot", ["irb120", "irb14000", "crb15000"])
def test_readme_has_first_steps_and_removal(robot):
    text = readme(robot)
    places = [
        text.index(words)
        for words in (
            "## Install",
            "abb_driver",
            "Make a backup",
            "Restart the",
            "## Try STOP first",
        )
    ]
    assert places == sorted(places)
    assert "ROS_StateServer" in text
    assert "rapidgen uninstall" in text
    assert "\n## The robot does not move, without an error\n" in text
    assert "\n\n\n" not in text
    assert "{" not in text.replace("{bind: service}", "")


TWO = """
controller: {robotware: 6.13}
groups:
  left: {model: irb120, task: T_ROB1, mechanical_unit: ROB_1}
  right:
    model: irb120
    task: T_ROB2
    mechanical_unit: ROB_2
    tool: {name: tSpindle, declared: elsewhere}
"""


@pytest.fixture
def two_groups(tmp_path):
    (tmp_path / "two.yaml").write_text(TWO)
    return tmp_path / "two.yaml"


def test_files_copied_as_documented_are_where_cfg_expects(two_groups):
    for config in map(load_config, ("irb120", two_groups)):
        files = {f.path: f.data.decode("ascii") for f in build(config).files}
        text = files["README.md"]
        (copied,) = re.findall(
            r"^2\. Copy `(HOME/[^`]+)` with all that is in it", text, re.MULTILINE
        )
        saved = PurePosixPath(copied)
        target = {
            "HOME:/" + str(PurePosixPath(path).relative_to(saved.parent))
            for path in files
            if PurePosixPath(path).is_relative_to(saved)
        }
        assert set(re.findall(r'-File "([^"]+)"', files["SYS.cfg"])) == target
        assert f"delete `HOME:/{saved.name}`" in text


def test_each_group_is_tried_at_its_own_ports(two_groups):
    assert "left is `ROBOT:11000,11002`, right is `ROBOT:11010,11012`." in readme(two_groups)


def test_data_that_a_module_of_the_customers_declares_are_named(two_groups):
    text = readme(two_groups)
    assert (
        "   T_ROB2 has to have, global and in a module of yours: `tSpindle` (PERS tooldata)."
        in text
    )
    assert "T_ROB1 has to have" not in text
    assert "the tool `tool0` weighs nothing" in text
    assert "the tool `tSpindle`" not in text  # its load is what that module says


@pytest.mark.parametrize(("profile", "streams"), [("full", True), ("basic", False)])
def test_readme_mentions_streams_only_if_supported(profile, streams):
    text = readme("irb120", f"profile={profile}")
    assert ("\n- A stream has any number of points" in text) is streams
