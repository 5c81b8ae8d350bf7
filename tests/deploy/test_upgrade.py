"""From the first release to now, and back: other folder, other cfg, T_ROB1 no longer ours.

`first_release.json` is the tree that the first release's own deployment left, of a driver in its
shape: modules in HOME:/ROS; T_ROB1, a unit group and the tasks with -BindRef, -Entry and
-UseMechanicalUnitGroup; manifest with its keys. T_ROB1 was there before it, without those.
"""

import itertools
import json
import re
import shutil
from pathlib import Path

import pytest

from rapidgen.deploy import backup_set, make_plan
from rapidgen.deploy.command_run import earlier_set
from rapidgen.deploy.syspar import loaded_cfg
from rapidgen.deploy.transports.folder import FolderTransport
from rapidgen.diagnostics import DiagnosticError
from rapidgen.system import parse_cfg
from tests.deploy.cutting import EVERY, MODES, Cutting

RECORDED = json.loads((Path(__file__).parent / "first_release.json").read_text())
OLD_TASKS = {
    "T_ROB1": ("ROS_common.sys", "ROS_motion.mod"),
    "T_ROS_RECV": ("ROS_common.sys", "ROS_motionServer.mod"),
    "T_ROS_STATE": ("ROS_common.sys", "ROS_stateServer.mod"),
}
BEFORE = '-Name "T_ROB1" -Type "NORMAL" -MotionTask'


@pytest.fixture
def controller(tmp_path):
    """A system folder with the first release's driver, deployed and loaded."""
    lay(tmp_path / "c", RECORDED)
    return tmp_path / "c"


@pytest.fixture
def home(tmp_path):
    """The same with only HOME visible, as over FTP.

    Earlier loaded cfg is unknown.
    """
    tree = {p.removeprefix("HOME/"): t for p, t in RECORDED.items() if p.startswith("HOME/")}
    manifest = json.loads(tree["rapidgen_deploy/manifest.json"])
    tree["rapidgen_deploy/manifest.json"] = json.dumps(manifest | {"cfg_before": {}, "origin": []})
    lay(tmp_path / "h", tree)
    return tmp_path / "h"


def lay(folder, tree):
    for path, text in tree.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(text.encode("latin-1"))


def new(kit, build="dddddddddddd", **options):
    return kit.driver(build, motion_task=False, **options)


def old_world(home):
    """Result of a restart with the first release's cfg: 'old' or 'refuses'."""
    result = {
        name: (home / "ROS" / name).read_text() if (home / "ROS" / name).is_file() else ""
        for names in OLD_TASKS.values()
        for name in names
    }
    if all(
        text == RECORDED[f"HOME/ROS/{name}"].replace("\r\n", "\n") for name, text in result.items()
    ):
        return "old"
    for names in OLD_TASKS.values():
        complete = all(re.fullmatch(r"MODULE .*ENDMODULE\s*", result[n], re.S) for n in names)
        if complete and len({re.search('"(.*)"', result[n])[1] for n in names}) == 1:
            return "MIXED"
    return "refuses"


def instances(folder, section):
    texts = [parse_cfg(f.read_bytes()) for f in sorted((folder / "SYSPAR").glob("*.cfg"))]
    return [i for text in texts for i in text.instances(section)]


def test_the_plan_names_what_moves_what_goes_and_the_restart(kit, controller):
    plan = make_plan(FolderTransport(controller), new(kit))
    assert plan.neighbour is None
    assert plan.conflicts == ()
    assert {c.path.partition("/")[0] for c in plan.changes if c.action == "add"} == {"rapidgen"}
    assert {c.path for c in plan.changes if c.action == "remove"} == {
        f"ROS/{name}" for names in OLD_TASKS.values() for name in names
    }
    actions = {c.key: c.action for c in plan.cfg}
    assert actions["CAB_TASKS T_ROB1"] == "restore"
    assert actions["MECHANICAL_UNIT_GROUP rob1"] == "leave"
    assert actions["CAB_TASKS T_ROS_RECV"] == "remove"
    assert actions["CAB_TASKS T_ROS_state"] == "change"
    assert actions["CAB_EXEC_HOOKS ROS_on_stop QSTOP T_ROB1"] == "remove"
    assert any(step.stops_motion for step in plan.steps)


def test_upgraded_and_rolled_back_and_taken_off(kit, controller):
    transport = FolderTransport(controller)
    kit.deploy(transport, new(kit))
    assert kit.verdict(controller / "HOME", new(kit)) == "set 0"
    assert not (controller / "HOME/ROS").exists()
    (motion,) = [i for i in instances(controller, "CAB_TASKS") if i.text("Name") == "T_ROB1"]
    assert [a.name for a in motion.attributes] == ["Name", "Type", "MotionTask"]
    assert not instances(controller, "CAB_EXEC_HOOKS")
    assert make_plan(transport, new(kit)).is_empty
    kit.deploy(transport, backup_set(transport, "HOME/", 2), verb="rollback")
    assert old_world(controller / "HOME") == "old"
    assert not (controller / "HOME/rapidgen").exists()
    for domain in ("SYS", "EIO"):
        now, then = (controller / f"SYSPAR/{domain}.cfg").read_bytes(), RECORDED
        assert by_section(now) == by_section(then[f"SYSPAR/{domain}.cfg"])
    kit.deploy(transport, None, verb="uninstall")
    assert {str(p.relative_to(controller)) for p in controller.rglob("*") if p.is_file()} == {
        "HOME/mine.mod",
        "SYSPAR/SYS.cfg",
    }
    assert (controller / "SYSPAR/SYS.cfg").read_text().count(BEFORE) == 1


def by_section(data):
    text = parse_cfg(data)
    return {s.name: sorted(map(attributes, s.instances)) for s in text.sections}


def attributes(instance):
    return [(a.name, a.values) for a in instance.attributes]


def test_where_only_home_is_seen_each_step_has_its_instances_and_t_rob1_is_kept(kit, home):
    transport = FolderTransport(home)
    steps = [s.what for s in kit.deploy(transport, new(kit)).steps]
    assert kit.verdict(home, new(kit)) == "set 0"
    deleted = " ".join(s for s in steps if "delete in" in s)
    assert "Task: T_ROS_RECV loading" in deleted
    assert "Group: " not in deleted
    assert "ROS_on_power POWER_ON T_ROB1" in deleted
    assert "HOME:/ROS/ROS_common.sys in T_ROB1, T_ROS_RECV, T_ROS_STATE;" in deleted
    (retained,) = [s for s in steps if s.startswith("keep T_ROB1 ")]
    assert retained.endswith('(-BindRef 0 -Entry "main" -UseMechanicalUnitGroup "rob1")')
    (load,) = [s for s in steps if s.startswith("load HOME:/rapidgen_deploy/SYS.cfg")]
    assert load.endswith("Load parameters and replace duplicates")
    places = [
        next(n for n, s in enumerate(steps) if word in s) for word in ("delete", "load", "Restart")
    ]
    assert places == sorted(places)


def test_rolled_back_where_only_home_is_seen(kit, home):
    transport = FolderTransport(home)
    kit.deploy(transport, new(kit))
    plan = kit.deploy(transport, backup_set(transport, "", 2), verb="rollback")
    assert old_world(home) == "old"
    steps = [s.what for s in plan.steps]
    assert any("HOME:/rapidgen/ROS_motion.mod in T_ROB1" in s for s in steps if "delete" in s)
    (load,) = [s for s in steps if s.startswith("load HOME:/rapidgen_deploy/SYS.cfg")]
    # T_ROB1 is in that file, and on every controller: adding it would be refused (120006).
    assert load.endswith("Load parameters and replace duplicates")


def test_uninstall_where_only_home_is_seen_wants_the_instances_out_first(kit, home, controller):
    transport = FolderTransport(home)
    kit.deploy(transport, new(kit))
    first = make_plan(transport, None, verb="uninstall").steps[0].what
    assert "before the files are removed" in first
    clean = 'SYS:CFG_1.0:6:0::\n#\nCAB_TASKS:\n\n      -Name "T_ROB1" -Type "NORMAL" -MotionTask\n'
    plan = make_plan(transport, None, verb="uninstall", loaded=(parse_cfg(clean),))
    assert not plan.cfg
    assert not any("delete" in step.what for step in plan.steps)


def test_a_backup_says_which_steps_are_left(kit, home, controller):
    transport = FolderTransport(home)
    loaded = loaded_cfg(controller)
    plan = make_plan(transport, new(kit), loaded=loaded)
    assert {c.key: c.action for c in plan.cfg}["CAB_TASKS T_ROS_RECV"] == "remove"
    kit.deploy(transport, new(kit))
    # The steps were done: what the other controller has is what this one has loaded now.
    kit.deploy(FolderTransport(controller), new(kit))
    done = make_plan(transport, new(kit), loaded=loaded_cfg(controller))
    assert {c.action for c in done.cfg} == {"same"}
    assert done.is_empty
    assert done.steps == ()


@pytest.mark.parametrize("mode", MODES)
def test_cut_everywhere(kit, tmp_path, controller, mode):
    wanted, work, undo = new(kit), tmp_path / "work", tmp_path / "undo"

    def fresh(folder, source):
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(source, folder)

    fresh(work, controller)
    line = Cutting(work, mode)
    kit.deploy(line, wanted)
    points = range(1 + MODES.index(mode) % EVERY, line.count + 1, EVERY)
    for at, how in itertools.product(points, ("before", "after")):
        fresh(work, controller)
        with pytest.raises(DiagnosticError):
            kit.deploy(Cutting(work, mode, at, how), wanted)
        place = f"{mode}: {how} {line.log[at - 1]} ({at}/{line.count})"
        assert old_world(work / "HOME") in ("old", "refuses"), place
        assert kit.verdict(work / "HOME", wanted, None) != "MIXED", place
        assert (work / "HOME/mine.mod").is_file(), place
        fresh(undo, work)
        kit.deploy(Cutting(work, mode), wanted)
        assert kit.verdict(work / "HOME", wanted) == "set 0", place
        assert not (work / "HOME/ROS").exists(), place
        transport = Cutting(undo, mode)
        if make_plan(transport, None, verb="rollback").repair:
            kit.deploy(transport, earlier_set(transport, "cell1", None), verb="rollback")
            assert old_world(undo / "HOME") == "old", place
            assert not (undo / "HOME/rapidgen").exists(), place
