"""A small driver made by hand, controllers to put it on, and a judge of what lies there."""

import hashlib
import json
import os
import re
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from rapidgen.config import load_config, to_manifest
from rapidgen.deploy import DriverSet, apply, from_files, make_plan

CONFIGURATION = to_manifest(load_config("irb120"))
TASKS = ("T_ROB1", "T_ROS_server", "T_ROS_state")
MODULES = {
    "rapidgen/ROS_common.sys": TASKS,
    "rapidgen/ROS_motion.mod": ("T_ROB1",),
    "rapidgen/ROS_motionServer.mod": ("T_ROS_server",),
    "rapidgen/ROS_stateServer.mod": ("T_ROS_state",),
}


def driver_files(
    build: str = "0123456789ab",
    *,
    name: str = "cell1",
    lines: int = 3,
    robotware=(6, 15),
    drop: tuple[str, ...] = (),
    signals: tuple[str, ...] = ("signalMotorOn",),
    motion_task: bool = True,
    outputs: str = "",
    opened: tuple[str, ...] = (),
) -> dict[str, bytes]:
    """The files of a generated folder by path, manifest.json among them."""
    files: dict[str, bytes] = {}
    tasks: dict[str, list[str]] = {}
    for path, members in MODULES.items():
        if path in drop:
            continue
        module = Path(path).stem
        body = "".join(f"    ! line {n} of build {build}\r\n" for n in range(lines))
        text = (
            f'MODULE {module}\r\n    CONST string {module}_ID := "{build}";\r\n{body}ENDMODULE\r\n'
        )
        files[f"HOME/{path}"] = text.encode()
        tasks[f"HOME/{path}"] = list(members)
    major = robotware[0]
    sys = f"SYS:CFG_1.0:{major}:0::\n#\nCAB_TASKS:\n"
    for task in TASKS if motion_task else TASKS[1:]:
        kind = ' -Type "NORMAL" -MotionTask' if task == "T_ROB1" else ' -TrustLevel "None"'
        sys += f'\n      -Name "{task}"{kind}\n'
    sys += "#\nCAB_TASK_MODULES:\n"
    for path, members in tasks.items():
        for task in members:
            sys += f'\n      -File "HOME:{path[4:]}" -Task "{task}"\n'
    files["SYS.cfg"] = sys.encode()
    eio = f"EIO:CFG_1.0:{major}:1::\n#\nEIO_SIGNAL:\n"
    for signal in signals:
        eio += f'\n      -Name "{signal}" -SignalType "DO"\n'
    files["EIO.cfg"] = (eio + outputs).encode()
    if opened:
        text = eio.partition("EIO_SIGNAL:")[0] + "EIO_SIGNAL:\n"
        for signal in opened:
            text += f'\n      -Name "{signal}" -SignalType "DO"\n'
        files["EIO_open.cfg"] = text.encode()
    files["README.md"] = b"# not for the controller\n"
    kinds = {name: "cfg" for name in files if name.endswith(".cfg")} | {"README.md": "readme"}
    manifest = {
        "format": 1,
        "rapidgen": "0.1.0",
        "name": name,
        "build_id": build,
        "robotware": list(robotware),
        "groups": {},
        "configuration": CONFIGURATION,
        "files": [
            {
                "path": path,
                "sha256": hashlib.sha256(data).hexdigest(),
                "size": len(data),
                "task": tasks.get(path, []),
                "kind": kinds.get(path, "module"),
            }
            for path, data in files.items()
        ],
        "lines": {},
    }
    files["manifest.json"] = json.dumps(manifest).encode()
    return files


def driver(build: str = "0123456789ab", **options) -> DriverSet:
    return from_files(driver_files(build, **options))


def modules_on(home: Path) -> dict[str, bytes]:
    """Modules in the places that cfg names, also foreign ones."""
    return {p: (home / p).read_bytes() for p in MODULES if (home / p).is_file()}


def verdict(home: Path, *sets: DriverSet | None) -> str:
    """Result of a restart: 'set 0', 'set 1', ..., 'empty' or 'refuses'.

    Written without the code under test. A module that is missing, or truncated, keeps its tasks
    from loading; and ROS_common refuses if any BUILD_ID differs. 'MIXED' must never occur.
    """
    result = modules_on(home)
    for number, wanted in enumerate(sets):
        expected = {f.path: f.data for f in wanted.files if f.kind == "module"} if wanted else {}
        if result == expected:
            return f"set {number}" if wanted else "empty"
    paths = {f.path for s in sets if s is not None for f in s.files if f.kind == "module"}
    for task in TASKS:
        ids = set()
        loads = True
        for path in (p for p in paths if task in MODULES[p]):
            data = result.get(path, b"")
            loads &= re.fullmatch(rb"MODULE .*ENDMODULE\s*", data, re.S) is not None
            ids |= set(re.findall(rb'CONST string \w+ := "([^"]*)"', data))
        if loads and len(ids) == 1:
            return "MIXED"
    return "refuses"


@dataclass
class Says:
    lines: list[str] = field(default_factory=list)

    def __call__(self, line: str) -> None:
        self.lines.append(line)


def deploy(transport, wanted, *, verb="deploy", overwrite=False):
    plan = make_plan(transport, wanted, verb=verb)
    apply(transport, plan, overwrite=overwrite)
    return plan


@pytest.fixture
def home(tmp_path) -> Path:
    folder = tmp_path / "HOME"
    folder.mkdir()
    return folder


class Kit:
    """The functions above, for tests (test folders are no packages)."""

    driver = staticmethod(driver)
    driver_files = staticmethod(driver_files)
    verdict = staticmethod(verdict)
    deploy = staticmethod(deploy)
    modules_on = staticmethod(modules_on)
    MODULES = MODULES
    TASKS = TASKS


@pytest.fixture(scope="session")
def kit() -> type[Kit]:
    return Kit


@pytest.fixture(autouse=True)
def _no_fsync(monkeypatch):
    monkeypatch.setattr(os, "fsync", lambda descriptor: None)
