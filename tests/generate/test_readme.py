"""What the README of a build tells an integrator, by generation and by what the driver serves."""

import pytest

from rapidgen.config import load_config
from rapidgen.generate import build


def readme(name, *overrides):
    config = load_config(name, overrides=tuple(overrides))
    (file,) = [f for f in build(config).files if f.path == "README.md"]
    return file.data.decode("ascii")


@pytest.mark.parametrize(
    ("robot", "overrides", "told", "untold"),
    [
        (
            "irb120",
            (),
            ("X6, WAN", "616-1", "no firewall", "network: {bind: service}"),
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
        ("irb14000", (), ("XP23 is the service port", "604-1"), ("X6",)),
        ("crb15000", (), ("into **WAN**", "3114-1", "`EnableOnPublicNet`", "SIO.cfg"), ("616-1",)),
        ("crb15000", ("network.bind=service",), ("`EnableOnPrivateNet`",), ("PublicNet",)),
    ],
)
def test_socket_options_and_firewall(robot, overrides, told, untold):
    text = readme(robot, *overrides)
    assert [words for words in told if words not in text] == []
    assert [words for words in untold if words in text] == []


@pytest.mark.parametrize("robot", ["irb120", "irb14000", "crb15000"])
def test_what_comes_first_and_the_way_back(robot):
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
    assert "\n## The robot stands and nothing says why\n" in text
    assert "\n\n\n" not in text
    assert "{" not in text.replace("{bind: service}", "")
