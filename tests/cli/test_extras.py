"""What an installation without extras does, and which extra it names where it cannot."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from rapidgen._extras import EXTRAS

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib


# Importable names of rapidgen that need no extra are all but those below these.
BEYOND = {
    "rapidgen.client.egm": "egm",
    "rapidgen.client.rws.": "web",
    "rapidgen.ros.delayed_session": "egm",
    "rapidgen.ros.stream_execution": "egm",
    "rapidgen.ros.twist_motion": "egm",
    "rapidgen.testing.egm": "egm",
    "rapidgen.deploy.transports.rws": "web",
    "rapidgen.servers.rws.server": "web",
    "rapidgen.servers.aiohttp_thread": "web",
    "rapidgen.verification.cluster": "cluster",
    "rapidgen.viewer.auth": "web",
    "rapidgen.wire.egm.codec": "egm",
    "rapidgen.viewer.matplotlib_charts": "plot",
    "rapidgen.viewer.recording": "recording",
    "rapidgen.viewer.server": "web",
}
PLAIN = f"""
import json, sys
for name in {sorted(EXTRAS)!r}:
    sys.modules[name] = None
"""
ALL = """
import importlib, pkgutil, rapidgen
failed = {}
for module in pkgutil.walk_packages(rapidgen.__path__, "rapidgen.", onerror=lambda name: None):
    if module.name in (
        "rapidgen.cli.__main__",
        "rapidgen.ros.node",
        "rapidgen.ros.operator_interface",
        "rapidgen.ros.stream_interface",
    ):
        continue
    try:
        importlib.import_module(module.name)
    except ModuleNotFoundError as fault:
        failed[module.name] = fault.name
print(json.dumps(failed))
"""
ROBOTS = Path(__file__).parents[2] / "robots"
MAIN = "from rapidgen.cli.app import main; sys.exit(main(sys.argv[1:]))"
SHIPPED = """
from rapidgen.config import load_config
from rapidgen.generate import build
from rapidgen.viewer.appearance import PLAIN
for name in sys.argv[1:]:
    groups = load_config(name).groups
    assert all(PLAIN.of(group) for group in groups), name
assert build(load_config("irb2400")).files
"""


def plain(text, *words):
    """Exit code and output of a program in a Python without any extra."""
    done = subprocess.run(
        [sys.executable, "-c", PLAIN + text, *words],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "RAPIDGEN_PASSWORD": "x"},
    )
    return done.returncode, done.stdout, done.stderr


def test_missing_package_names_its_extra():
    project = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text("utf-8"))
    extras = dict(project["project"]["optional-dependencies"])
    every = extras.pop("all")
    # The import name of protobuf is google.protobuf.
    extras["egm"] = [line.replace("protobuf", "google") for line in extras["egm"]]
    # NumPy is a dependency anyway; coal needs a newer one.
    listed = {
        line.partition(">=")[0]: extra
        for extra, lines in extras.items()
        for line in lines
        if not line.startswith("numpy")
    }
    assert listed == EXTRAS
    assert every == [f"rapidgen[{','.join(sorted(extras))}]"]


def test_extra_is_needed_only_by_its_modules():
    code, out, err = plain(ALL)
    assert code == 0, err
    failed = json.loads(out)
    for module, package in failed.items():
        extra = EXTRAS[package.partition(".")[0]]
        assert any(module.startswith(name) and BEYOND[name] == extra for name in BEYOND), module
    for name in BEYOND:
        assert any(module.startswith(name) for module in failed), f"{name} needs no extra"


@pytest.mark.parametrize(
    ("text", "extra"),
    [
        ("status rws://192.0.2.1", "web"),
        ("plan irb120 --to rws://192.0.2.1", "web"),
        ("sim irb120 --ports auto --rws 1", "web"),
        ("sim irb120 --ports auto --view", "web"),
        ("sim irb120 --ports auto --record never.mcap", "recording"),
        ("view never.mcap", "recording"),
        ("egm irb120 --port 0", "egm"),
        ("test irb120 --cluster tcp://127.0.0.1:1", "cluster"),
    ],
)
def test_a_command_names_its_extra(text, extra):
    code, out, err = plain(MAIN, *text.split())
    assert code == 2
    assert "error[RG905]" in err
    assert f"pip install 'rapidgen[{extra}]'" in err
    assert out == ""
    assert not Path("never.mcap").exists()


def test_missing_extra_is_reported_in_python():
    code, _, err = plain("from rapidgen.client import Controller")
    assert code == 1
    assert err.splitlines()[-1] == (
        "ModuleNotFoundError: this needs httpx2, which is not installed: "
        "pip install 'rapidgen[web]', or 'rapidgen[all]'"
    )


def test_description_without_its_extra_is_reported_with_place(tmp_path):
    config = tmp_path / "cell.yaml"
    config.write_text(f"model: irb2400\nurdf:\n  file: {ROBOTS / 'urdf' / 'irb2400.urdf'}\n")
    code, out, _ = plain(MAIN, "check", str(config))
    assert code == 1
    assert "error[RG905]" in out
    assert "cell.yaml:3:9" in out
    assert "pip install 'rapidgen[urdf]'" in out


def test_shipped_robots_need_no_extra():
    names = sorted(path.stem for path in ROBOTS.glob("*.yaml"))
    assert len(names) > 10
    code, _, err = plain(SHIPPED, *names)
    assert code == 0, err
