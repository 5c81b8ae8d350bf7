"""cfg instances next to HOME: read, merged, and removed."""

import json

import pytest

from rapidgen.deploy import make_plan
from rapidgen.deploy.transports.folder import FolderTransport
from rapidgen.system import parse_cfg
from tests.refusal import refused

OLD, NEW = "aaaaaaaaaaaa", "bbbbbbbbbbbb"
SYS = """SYS:CFG_1.0:6:0::\r
#\r
CAB_TASKS:\r
\r
      -Name "T_ROB1" -Type "NORMAL" -Entry "their_main" -MotionTask\r
\r
      -Name "T_THEIRS" -Type "STATIC"\r
#\r
MMC_REAL10:\r
\r
      -Name "theirs"\r
"""


@pytest.fixture
def controller(tmp_path):
    """A system folder: HOME and SYSPAR, as a backup has them. No EIO.cfg yet."""
    (tmp_path / "c/HOME").mkdir(parents=True)
    (tmp_path / "c/SYSPAR").mkdir()
    (tmp_path / "c/SYSPAR/SYS.cfg").write_text(SYS, newline="")
    return tmp_path / "c"


def actions(plan):
    return {c.key: c.action for c in plan.cfg}


def test_instances_are_added_changed_and_given_back_byte_for_byte(kit, controller):
    transport = FolderTransport(controller)
    plan = kit.deploy(transport, kit.driver(OLD))
    assert actions(plan)["CAB_TASKS T_ROB1"] == "change"
    assert actions(plan)["CAB_TASKS T_ROS_state"] == "add"
    assert not any("load HOME:" in step.what for step in plan.steps)
    assert kit.verdict(controller / "HOME", kit.driver(OLD)) == "set 0"
    merged = parse_cfg((controller / "SYSPAR/SYS.cfg").read_bytes())
    names = [i.text("Name") for i in merged.instances("CAB_TASKS")]
    assert names == ["T_ROB1", "T_THEIRS", "T_ROS_server", "T_ROS_state"]
    assert [i.text("Name") for i in merged.instances("MMC_REAL10")] == ["theirs"]
    assert b"\r\n" in (controller / "SYSPAR/SYS.cfg").read_bytes()
    assert make_plan(transport, kit.driver(OLD)).is_empty
    plan = kit.deploy(transport, kit.driver(NEW, signals=("signalOther",)))
    assert actions(plan)["EIO_SIGNAL signalOther"] == "add"
    assert actions(plan)["EIO_SIGNAL signalMotorOn"] == "remove"
    kit.deploy(transport, None, verb="uninstall")
    assert (controller / "SYSPAR/SYS.cfg").read_text() == SYS.replace("\r\n", "\n")
    assert (controller / "SYSPAR/SYS.cfg").read_bytes() == SYS.encode()
    assert not (controller / "SYSPAR/EIO.cfg").exists()
    assert list((controller / "HOME").iterdir()) == []


def test_what_others_changed_meanwhile_stays(kit, controller):
    transport = FolderTransport(controller)
    kit.deploy(transport, kit.driver(OLD))
    path = controller / "SYSPAR/SYS.cfg"
    text = path.read_bytes().decode()
    path.write_text(text.replace('"T_THEIRS"', '"T_RENAMED"'), newline="")
    assert make_plan(transport, kit.driver(OLD)).is_empty
    kit.deploy(transport, None, verb="uninstall")
    left = parse_cfg(path.read_bytes())
    assert [i.text("Name") for i in left.instances("CAB_TASKS")] == ["T_ROB1", "T_RENAMED"]
    assert next(left.instances("CAB_TASKS")).text("Entry") == "their_main"


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1"])
def test_texts_of_others_keep_their_letters(kit, controller, encoding):
    word = "Größe" if encoding == "latin-1" else "Größe 夹具"
    foreign = SYS.replace("theirs", word)
    path = controller / "SYSPAR/SYS.cfg"
    path.write_bytes(foreign.encode(encoding))
    kit.deploy(FolderTransport(controller), kit.driver(OLD))
    merged = path.read_bytes().decode(encoding)
    assert "T_ROS_server" in merged
    assert f'-Name "{word}"' in merged
    assert merged.encode(encoding) == path.read_bytes()


def test_a_backup_whose_folders_were_renamed_to_small_letters_is_one(kit, controller):
    (controller / "HOME").rename(controller / "home")
    (controller / "SYSPAR").rename(controller / "syspar")
    kit.deploy(FolderTransport(controller), kit.driver(OLD))
    assert {p.name for p in controller.iterdir()} == {"home", "syspar"}
    assert kit.verdict(controller / "home", kit.driver(OLD)) == "set 0"
    assert "T_ROS_server" in (controller / "syspar/SYS.cfg").read_text()


def test_the_wrong_robotware_is_refused_before_anything_changes(kit, controller):
    wrong = kit.driver(OLD, robotware=(7, 13))
    assert refused(kit.deploy, FolderTransport(controller), wrong)[0] == "RG525"
    assert list((controller / "HOME").iterdir()) == []


def test_without_syspar_loading_is_a_step_at_the_pendant(kit, home):
    transport = FolderTransport(home)
    plan = kit.deploy(transport, kit.driver(OLD))
    steps = [s.what for s in plan.steps]
    assert any(
        s.startswith("load HOME:/rapidgen_deploy/SYS.cfg (9 instances to add") for s in steps
    )
    assert any("read again: T_ROB1 2 files (NORMAL); T_ROS" in s for s in steps)
    assert [s.stops_motion for s in plan.steps if "Restart" in s.what] == [True]
    again = kit.deploy(transport, kit.driver(NEW, signals=("signalOther",)))
    steps = [s.what for s in again.steps]
    assert any("load HOME:/rapidgen_deploy/EIO.cfg (1 instances to add" in s for s in steps)
    assert not any("SYS.cfg" in s for s in steps)
    assert any("loading removes nothing" in s and "signalMotorOn" in s for s in steps)


@pytest.mark.parametrize("message", [7, "x", [["Name"]], [["Name", 3]], [[3, []]], [3], {"a": 1}])
def test_instances_in_a_manifest_that_are_none_make_it_damaged(kit, controller, message):
    transport = FolderTransport(controller)
    kit.deploy(transport, kit.driver(OLD))
    path = controller / "HOME/rapidgen_deploy/manifest.json"
    manifest = json.loads(path.read_text())
    key = next(key for key, old in manifest["cfg_before"].items() if old)
    manifest["cfg_before"][key] = message
    path.write_text(json.dumps(manifest))
    assert refused(make_plan, transport, None, verb="uninstall") == ["RG531"]
