"""docs/rapid/cfg.md has exactly one row for each written cfg line."""

import re
from pathlib import Path

import pytest

from rapidgen.config import load_config
from rapidgen.diagnostics import DiagnosticError
from rapidgen.generate import build
from rapidgen.system import parse_cfg

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "rapid" / "cfg.md"
MULTIMOVE, OMNICORE = "controller.multimove=true", "controller.type=omnicore"
BUILDS = {
    "5.15": [("irb120",), ("irb120", "commissioning=true", MULTIMOVE)],
    "5.61": [("irb120",), ("irb120", "commissioning=true", MULTIMOVE)],
    "6": [
        ("irb120",),
        ("irb120", "commissioning=true"),
        ("two_arms_track-rw6",),
        ("irb14000-rw6",),
    ],
    "7": [("crb15000",), ("irb460", OMNICORE, "commissioning=true", MULTIMOVE)],
}
"""Configurations that together write every line of a release."""
RELEASE = {"5.15": "5.15", "5.61": "5.61", "6": "6.13", "7": "7.10"}
WORDS = ("Type", "TrustLevel", "Shelf", "Status", "SignalType", "Access")
"""Attributes whose values are words of RobotWare's."""


def table(heading):
    """Cells by the line that they are of."""
    text = PAGE.read_text(encoding="utf-8").split(f"## {heading}\n")[1].split("\n## ")[0]
    match = re.findall(r"^\| `([^`]+)` \| (.+) \|$", text, re.M)
    columns = (*BUILDS, "source")
    return {line: dict(zip(columns, cells.split(" | "), strict=True)) for line, cells in match}


def cfg_texts(release):
    """(path, text) of each cfg file that the builds of a release write."""
    for name, *overrides in BUILDS[release]:
        example = ROOT / "robots" / "examples" / f"{name}.yaml"
        versioned = [f"controller.robotware={RELEASE[release]}", *overrides]
        config = load_config(example if example.exists() else name, overrides=versioned)
        for file in build(config).files:
            if file.kind == "cfg":
                yield file.path, parse_cfg(file.data)


def lines_of(text):
    for section in text.sections:
        for instance in section.instances:
            for attribute in instance.attributes:
                line = f"{text.domain} {section.name} -{attribute.name}"
                if attribute.name in WORDS or (text.domain == "SIO" and attribute.values):
                    line += f' "{attribute.values[0]}"'
                elif attribute.values:
                    line += " ..."
                yield line


@pytest.mark.parametrize("release", BUILDS)
def test_each_line_has_a_row_and_each_row_a_line(release):
    rows = table("Lines")
    displayed = {line for line, cells in rows.items() if cells[release] != "-"}
    written = {line for _, text in cfg_texts(release) for line in lines_of(text)}
    assert written == displayed


@pytest.mark.parametrize("release", BUILDS)
def test_unconfirmed_rows_are_in_optional_files(release):
    rows = table("Lines")
    statuses = {line for line in rows if "-Status" in line}
    for path, text in cfg_texts(release):
        for line in set(lines_of(text)) & statuses:
            assert (rows[line][release] == "open") == path.endswith("_open.cfg"), (path, line)


@pytest.mark.parametrize("release", BUILDS)
def test_the_first_lines(release):
    rows = table("The first line of a file")
    displayed = {line: cells[release].split()[0] for line, cells in rows.items()}
    for _, text in cfg_texts(release):
        assert displayed[text.domain] == "{}:{}".format(*text.version)


def test_every_row_has_marks_and_a_source():
    marks = set(table("Marks")) | set(re.findall(r"^\| (\w[\w ]*|-) \|", PAGE.read_text(), re.M))
    for line, cells in table("Lines").items():
        assert {cells[release] for release in BUILDS} <= marks, line
        assert cells["source"].strip(), line


@pytest.mark.parametrize(
    ("version", "domains"),
    [("5.30", ["EIO"]), ("5.60", ["EIO"]), ("8.0", ["SYS", "EIO", "SIO"])],
)
def test_a_release_without_known_digits_is_asked_for(version, domains):
    kind = "omnicore" if version.startswith("8") else "irc5"
    overrides = [f"controller.robotware={version}", f"controller.type={kind}"]
    with pytest.raises(DiagnosticError) as caught:
        build(load_config("irb120", overrides=overrides))
    for result, domain in zip(caught.value.diagnostics, domains, strict=True):
        assert result.code == "RG105"
        assert f"SYSPAR/{domain}.cfg" in result.help
    given = [f"controller.cfg_header.{d}=9:77" for d in ("SYS", "EIO", "SIO")]
    files = build(load_config("irb120", overrides=[*overrides, *given])).files
    assert {parse_cfg(f.data).version for f in files if f.kind == "cfg"} == {(9, 77)}


@pytest.mark.parametrize(
    ("bind", "public"),
    [("lan", True), ("10.0.0.3", True), ("service", False), ("192.168.125.1", False)],
)
def test_the_firewall_opens_the_net_that_is_served(bind, public):
    config = load_config("crb15000", overrides=[f"network.bind={bind}"])
    (sio,) = [f for f in build(config).files if f.path == "SIO.cfg"]
    (rule,) = parse_cfg(sio.data).instances("FIREWALL_MANAGEMENT")
    assert rule.text("Name") == "RapidSockets"
    assert rule.flag("EnableOnPrivateNet")
    assert rule.flag("EnableOnPublicNet") == public
