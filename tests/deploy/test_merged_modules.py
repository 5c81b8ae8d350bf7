"""From a driver of 16 modules to one of 10, and back: each task loads the present modules only."""

import hashlib
import json
import re
from pathlib import PurePosixPath

import pytest

from rapidgen.config import load_config
from rapidgen.deploy import backup_set, make_plan
from rapidgen.deploy.driver_set import from_files
from rapidgen.deploy.transports.folder import FolderTransport
from rapidgen.generate import build
from rapidgen.system import parse_cfg

SERVERS = ("T_ROS_RECV", "T_ROS_CONTROL", "T_ROS_STATE")
EARLIER = {
    "ROS_events.sys": ("T_ROB1",),
    "ROS_instructions.sys": ("T_ROB1", "T_ROS_RECV"),
    "ROS_limits.sys": SERVERS,
    "ROS_messages.sys": SERVERS,
    "ROS_socket.sys": SERVERS,
    "ROS_acceptance.mod": ("T_ROS_RECV",),
    "ROS_download.mod": ("T_ROS_RECV",),
}
"""Modules of the earlier driver that the present one has no more, with their tasks."""
LATER = "ROS_server.sys"


@pytest.fixture(scope="module")
def present():
    return {file.path: file.data for file in build(load_config("irb120")).files}


@pytest.fixture(scope="module")
def earlier(present):
    """The same files with the modules of the earlier driver."""
    manifest = json.loads(present["manifest.json"])
    build_id = "0123456789ab"
    old = manifest["build_id"].encode()
    files = {
        path: data.replace(old, build_id.encode())
        for path, data in present.items()
        if not path.endswith(LATER)
    }
    added = {f"HOME/rapidgen/{name}": tasks for name, tasks in EARLIER.items()}
    for path in added:
        name = PurePosixPath(path).stem
        files[path] = f'MODULE {name}\n CONST string {name} := "{build_id}";\nENDMODULE\n'.encode()
    sys = files["SYS.cfg"].decode()
    entry = re.compile(rf'\n *-File "HOME:/rapidgen/{LATER}"[^\n]*\\\r?\n[^\n]*\n')
    assert len(entry.findall(sys)) == len(SERVERS)
    entries = "".join(
        f'\n      -File "HOME:/rapidgen/{name}" -ModName "{name[:-4]}" -Task "{task}"\r\n'
        for name, tasks in EARLIER.items()
        for task in tasks
    )
    sys = entry.sub("", sys).replace("CAB_TASK_MODULES:\r\n", f"CAB_TASK_MODULES:\r\n{entries}", 1)
    files["SYS.cfg"] = sys.encode()
    rows = {row["path"]: row for row in manifest["files"]}
    manifest["build_id"] = build_id
    manifest["files"] = [
        {
            **rows.get(path, {"kind": "module", "task": list(added.get(path, ()))}),
            "path": path,
            "sha256": hashlib.sha256(data).hexdigest(),
            "size": len(data),
        }
        for path, data in files.items()
        if path != "manifest.json"
    ]
    files["manifest.json"] = json.dumps(manifest).encode()
    return files


@pytest.fixture
def controller(tmp_path):
    """The folder of a controller that shows its parameters, too."""
    (tmp_path / "HOME").mkdir()
    (tmp_path / "SYSPAR").mkdir()
    text = 'SYS:CFG_1.0:6:0::\n#\nCAB_TASKS:\n\n      -Name "T_ROB1" -Type "NORMAL" -MotionTask\n'
    (tmp_path / "SYSPAR/SYS.cfg").write_text(text)
    (tmp_path / "SYSPAR/EIO.cfg").write_text("EIO:CFG_1.0:6:1::\n#\nEIO_SIGNAL:\n")
    return tmp_path


def loaded(controller):
    """What the controller loads at a restart: (file, task)."""
    text = parse_cfg((controller / "SYSPAR/SYS.cfg").read_bytes())
    return sorted((i.text("File"), i.text("Task")) for i in text.instances("CAB_TASK_MODULES"))


def written(files):
    text = parse_cfg(files["SYS.cfg"])
    return sorted((i.text("File"), i.text("Task")) for i in text.instances("CAB_TASK_MODULES"))


def modules(controller):
    return {f"HOME/rapidgen/{p.name}": p.read_bytes() for p in controller.glob("HOME/rapidgen/*")}


def homes(files):
    return {path: data for path, data in files.items() if path.startswith("HOME/")}


def test_merged_modules_are_removed_and_rollback_restores_them(kit, controller, earlier, present):
    transport = FolderTransport(controller)
    kit.deploy(transport, from_files(earlier))
    assert modules(controller) == homes(earlier)
    assert loaded(controller) == written(earlier)
    plan = kit.deploy(transport, from_files(present))
    assert {c.path for c in plan.changes if c.action == "remove"} == {
        f"rapidgen/{name}" for name in EARLIER
    }
    assert modules(controller) == homes(present)
    assert loaded(controller) == written(present)
    assert make_plan(transport, from_files(present)).is_empty
    kit.deploy(transport, backup_set(transport, "HOME/", 2), verb="rollback")
    assert modules(controller) == homes(earlier)
    assert loaded(controller) == written(earlier)


def test_steps_name_the_merged_modules_where_only_home_is_visible(
    kit, controller, earlier, present
):
    transport = FolderTransport(controller / "HOME")
    kit.deploy(transport, from_files(earlier))
    steps = [step.what for step in kit.deploy(transport, from_files(present)).steps]
    deleted = " ".join(step for step in steps if "delete in" in step)
    assert set(re.findall(r"ROS_\w+\.\w+", deleted)) == set(EARLIER)
    assert modules(controller) == homes(present)
