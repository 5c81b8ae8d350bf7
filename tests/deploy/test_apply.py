"""Deploy, deploy again, roll back, uninstall: on a folder."""

import json
import os

import pytest

from rapidgen.deploy import TransportFault, apply, backup_set, make_plan
from rapidgen.deploy.command_run import check_names
from rapidgen.deploy.plan_text import plan_text
from rapidgen.deploy.transports.folder import FolderTransport
from tests.refusal import refused

OLD, NEW = "aaaaaaaaaaaa", "bbbbbbbbbbbb"


def tree(folder):
    return {
        str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()
    } | {str(p.relative_to(folder)) + "/": b"" for p in folder.rglob("*") if p.is_dir()}


@pytest.fixture
def transport(home):
    return FolderTransport(home)


def test_first_deployment_and_nothing_to_do_after_it(kit, home, transport):
    wanted = kit.driver(OLD)
    plan = kit.deploy(transport, wanted)
    assert {c.action for c in plan.changes} == {"add"}
    assert kit.verdict(home, wanted) == "set 0"
    assert (home / "rapidgen_deploy/SYS.cfg").is_file()
    names = {p.name for p in (home / "rapidgen_deploy").iterdir()}
    assert names == {"SYS.cfg", "EIO.cfg", "manifest.json"}
    before = tree(home)
    again = kit.deploy(transport, wanted)
    assert again.is_empty
    assert tree(home) == before


def test_a_manifest_that_says_otherwise_is_written_anew(kit, home, transport):
    wanted = kit.driver(OLD)
    kit.deploy(transport, wanted)
    path = home / "rapidgen_deploy/manifest.json"
    message = json.loads(path.read_text())
    message["files"][0]["sha256"] = "0" * 64
    path.write_text(json.dumps(message))
    plan = make_plan(transport, wanted)
    assert {c.action for c in plan.changes} == {"same"}
    assert not plan.is_empty
    assert "no restart: no module and no loaded file changes" in plan_text(plan)
    kit.deploy(transport, wanted)
    assert make_plan(transport, wanted).is_empty
    assert "0" * 64 not in path.read_text()


def test_a_manifest_without_files_is_uninstalled(kit, home, transport):
    wanted = kit.driver(OLD)
    kit.deploy(transport, wanted)
    for file in wanted.files:
        (home / file.path).unlink()
    plan = make_plan(transport, None, verb="uninstall")
    assert not plan.changes
    assert not plan.is_empty
    kit.deploy(transport, None, verb="uninstall")
    assert not (home / "rapidgen_deploy").exists()


def test_update_keeps_a_backup_and_rollback_restores_it_with_fresh_stamps(kit, home, transport):
    old, new = kit.driver(OLD), kit.driver(NEW, drop=("rapidgen/ROS_stateServer.mod",))
    kit.deploy(transport, old)
    for path in kit.MODULES:
        os.utime(home / path, (1_000_000_000, 1_000_000_000))
    plan = kit.deploy(transport, new)
    assert {c.path: c.action for c in plan.changes if c.kind == "module"} == {
        "rapidgen/ROS_common.sys": "change",
        "rapidgen/ROS_motion.mod": "change",
        "rapidgen/ROS_motionServer.mod": "change",
        "rapidgen/ROS_stateServer.mod": "remove",
    }
    assert kit.verdict(home, new, old) == "set 0"
    stamps = {p: (home / p).stat().st_mtime_ns for p in kit.modules_on(home)}
    manifest = make_plan(transport, new).had
    assert manifest is not None
    (past,) = manifest.history
    assert (past.id, past.build_id) == (2, OLD)
    back = backup_set(transport, "", past.id)
    kit.deploy(transport, back, verb="rollback")
    assert kit.verdict(home, new, old) == "set 1"
    for path in kit.modules_on(home):
        assert (home / path).stat().st_mtime_ns > stamps.get(path, 0)


def test_uninstall_leaves_the_state_before_the_first_deployment(kit, home, transport):
    (home / "mine.mod").write_text("MODULE mine\nENDMODULE\n")
    (home / "rapidgen").mkdir()
    before = tree(home)
    del before["rapidgen/"]  # an empty folder of that name is taken away with ours
    kit.deploy(transport, kit.driver(OLD))
    kit.deploy(transport, kit.driver(NEW))
    kit.deploy(transport, None, verb="uninstall")
    assert tree(home) == before
    assert refused(make_plan, transport, None, verb="uninstall") == ["RG529"]


def test_an_edit_by_hand_is_kept_until_overwrite_and_then_saved(kit, home, transport):
    old, new = kit.driver(OLD), kit.driver(NEW)
    kit.deploy(transport, old)
    target = home / "rapidgen/ROS_motion.mod"
    edited = target.read_bytes().replace(b"line 1 of", b"line 1, by hand, of")
    target.write_bytes(edited)
    assert [c.note for c in make_plan(transport, old).conflicts] == ["lines 4"]
    before = tree(home)
    for wanted in (old, new, None):
        plan = make_plan(transport, wanted, verb="deploy" if wanted else "uninstall")
        assert refused(apply, transport, plan) == ["RG520"]
        assert tree(home) == before
    kit.deploy(transport, new, overwrite=True)
    assert kit.verdict(home, new) == "set 0"
    kit.deploy(transport, backup_set(transport, "", 2), verb="rollback")
    assert target.read_bytes() == edited


def test_foreign_file_is_refused_then_kept_and_restored(kit, home, transport):
    target = home / "rapidgen/ROS_motion.mod"
    target.parent.mkdir()
    target.write_text("MODULE ROS_motion\nENDMODULE\n")
    equal = home / "rapidgen/ROS_common.sys"
    wanted = kit.driver(OLD)
    equal.write_bytes(next(f.data for f in wanted.files if f.path.endswith("common.sys")))
    before = tree(home)
    assert refused(kit.deploy, transport, wanted) == ["RG521"]
    assert tree(home) == before
    kit.deploy(transport, wanted, overwrite=True)
    kit.deploy(transport, kit.driver(NEW))
    kit.deploy(transport, None, verb="uninstall")
    assert tree(home) == before


@pytest.mark.parametrize("left", [b"MODULE", None], ids=["damaged", "gone"])
def test_rollback_keeps_foreign_file_with_damaged_copy(kit, home, transport, left):
    target = home / "rapidgen/ROS_motion.mod"
    target.parent.mkdir()
    target.write_text("MODULE theirs\nENDMODULE\n")
    kit.deploy(transport, kit.driver(OLD), overwrite=True)
    copy = home / "rapidgen_deploy/backup/origin/0.bin"
    copy.unlink() if left is None else copy.write_bytes(left)
    before = tree(home)
    assert refused(kit.deploy, transport, None, verb="uninstall") == ["RG528"]
    assert tree(home) == before
    kit.deploy(transport, kit.driver(NEW))
    kit.deploy(transport, None, verb="uninstall", overwrite=True)
    there = tree(home)
    there.pop("rapidgen/", None)
    assert there == ({"rapidgen/ROS_motion.mod": left} if left is not None else {})


def test_the_plan_is_refused_when_the_controller_moved_on(kit, home, transport):
    old, new = kit.driver(OLD), kit.driver(NEW)
    kit.deploy(transport, old)
    plan = make_plan(transport, new)
    (home / "rapidgen/ROS_motion.mod").write_text("x")
    assert refused(apply, transport, plan, overwrite=True) == ["RG522"]


def test_another_robots_driver_is_not_replaced(kit, transport):
    kit.deploy(transport, kit.driver(OLD))
    assert refused(make_plan, transport, kit.driver(NEW, name="cell2")) == ["RG524"]


def test_a_first_deployment_that_was_cut_keeps_other_robots_away(kit, home):
    class Cut(FolderTransport):
        def rename(self, old, new):
            if old.endswith("ROS_motion.mod.rg-new"):
                raise TransportFault("lost", "cut")
            super().rename(old, new)

    transport = FolderTransport(home)
    assert refused(kit.deploy, Cut(home), kit.driver(OLD)) == ["RG505", "RG527"]
    assert refused(make_plan, transport, kit.driver(NEW, name="cell2")) == ["RG524"]
    plan = make_plan(transport, None, verb="uninstall")
    assert refused(check_names, [plan], "cell2") == ["RG524"]
    check_names([plan], "cell1")
    apply(transport, plan)
    assert tree(home) == {}


def test_restored_foreign_file_after_change_is_kept_again(kit, home, transport):
    target, other = home / "rapidgen/ROS_motion.mod", home / "rapidgen/ROS_stateServer.mod"
    target.parent.mkdir()
    target.write_text("MODULE first\nENDMODULE\n")
    without = ("rapidgen/ROS_motion.mod", "rapidgen/ROS_stateServer.mod")
    kit.deploy(transport, kit.driver(OLD, drop=without[1:]), overwrite=True)
    kit.deploy(transport, kit.driver(NEW, drop=without))
    target.write_text("MODULE second\nENDMODULE\n")
    kit.deploy(transport, kit.driver(OLD, drop=without[1:]), overwrite=True)
    other.write_text("MODULE third\nENDMODULE\n")
    kit.deploy(transport, kit.driver(OLD), overwrite=True)
    kit.deploy(transport, None, verb="uninstall")
    assert target.read_text() == "MODULE second\nENDMODULE\n"
    assert other.read_text() == "MODULE third\nENDMODULE\n"


@pytest.mark.parametrize(
    ("moment", "codes"),
    [("ROS_motion.mod.rg-new", ["RG522"]), ("switching", ["RG506", "RG527"])],
)
def test_of_two_deployments_at_once_one_is_refused_and_nothing_is_left(kit, home, moment, codes):
    transport, other = FolderTransport(home), kit.driver(NEW)
    kit.deploy(transport, kit.driver(OLD))

    class Slow(FolderTransport):
        """Another deployment runs completely right after this file was written."""

        reached = False

        def write(self, path, data):
            super().write(path, data)
            if path.endswith(moment) and not self.reached:
                self.reached = True
                kit.deploy(transport, other)

    assert refused(kit.deploy, Slow(home), kit.driver("cccccccccccc")) == codes
    assert kit.verdict(home, other) == "set 0"
    kit.deploy(transport, other)
    assert make_plan(transport, other).is_empty
    state = {p.name for p in (home / "rapidgen_deploy").iterdir()}
    assert state == {"manifest.json", "backup", "SYS.cfg", "EIO.cfg"}
    assert not [p for p in home.rglob("*") if ".rg-" in p.name]


def test_apply_end_does_not_overwrite_other_deployment(kit, home):
    """Its files lie there, read back as its own, and the other run's notes say otherwise."""

    class Slow(FolderTransport):
        def rename(self, old, new):
            super().rename(old, new)
            if new.endswith("ROS_common.sys") and old.endswith(".rg-new"):
                for journal in (home / "rapidgen_deploy").glob("journal.*"):
                    journal.write_bytes(journal.read_bytes().replace(b"aaaaaaaaaaaa", b"b" * 12))

    assert refused(kit.deploy, Slow(home), kit.driver(OLD)) == ["RG522", "RG527"]
    assert not (home / "rapidgen_deploy/manifest.json").exists()


def test_backups_are_pruned_and_all_of_them_can_be_restored(kit, home, transport):
    sets = [kit.driver(f"{n:012x}") for n in range(1, 9)]
    for wanted in sets:
        kit.deploy(transport, wanted)
    retained = {p.name for p in (home / "rapidgen_deploy/backup").iterdir()}
    assert retained == {"4", "5", "6", "7", "8"}
    history = make_plan(transport, sets[-1]).had.history
    assert {str(p.id) for p in history} == retained
    for past in history:
        assert backup_set(transport, "", past.id).build_id == past.build_id


def test_a_damaged_backup_is_refused(kit, home, transport):
    kit.deploy(transport, kit.driver(OLD))
    kit.deploy(transport, kit.driver(NEW))
    (home / "rapidgen_deploy/backup/2/0.bin").write_bytes(b"damaged")
    for number in (2, 7):
        assert refused(backup_set, transport, "", number) == ["RG528"]


@pytest.mark.parametrize(
    "spoil",
    [
        lambda m: b"{",
        lambda m: b"[" * 100_000,
        lambda m: b"\xff\xfe",
        lambda m: json.dumps({**m, "files": [{**m["files"][0], "path": "../../etc/x"}]}).encode(),
        lambda m: json.dumps({**m, "files": [{**m["files"][0], "sha256": "0"}]}).encode(),
        lambda m: json.dumps({**m, "id": float("inf")}).encode(),
        lambda m: json.dumps({**m, "history": {"id": 1}}).encode(),
    ],
)
@pytest.mark.parametrize("sets", [1, 2])
def test_a_damaged_manifest_is_refused_and_overwrite_is_the_way_out(
    kit, home, transport, spoil, sets
):
    foreign = home / "rapidgen/ROS_motion.mod"
    foreign.parent.mkdir()
    foreign.write_text("MODULE ROS_motion\nENDMODULE\n")
    before = tree(home)
    old, new = kit.driver(OLD), kit.driver(NEW)
    kit.deploy(transport, old, overwrite=True)
    if sets == 2:
        kit.deploy(transport, new)
    path = home / "rapidgen_deploy/manifest.json"
    path.write_bytes(spoil(json.loads(path.read_bytes())))
    damaged = tree(home)
    for wanted in (old, new):
        assert refused(kit.deploy, transport, wanted) == ["RG531"]
    for verb in ("uninstall", "rollback"):
        assert refused(make_plan, transport, None, verb=verb) == ["RG531"]
    assert tree(home) == damaged
    kit.deploy(transport, new, overwrite=True)
    assert kit.verdict(home, new) == "set 0"
    assert make_plan(transport, new).is_empty
    history = make_plan(transport, new).had.history
    assert [past.id for past in history] == ([1] if sets == 1 else [2, 3])
    lay = backup_set(transport, "", history[-1].id)
    assert {f.path: f.data for f in lay.files} == {
        f.path: f.data for f in (old, new)[sets - 1].files
    }
    kit.deploy(transport, None, verb="uninstall")
    # The replaced foreign file is in the manifest, and in every backup.
    assert tree(home) == (before if sets == 2 else {})


def test_a_manifest_of_a_later_rapidgen_is_left_alone(kit, home, transport):
    wanted = kit.driver(OLD)
    kit.deploy(transport, wanted)
    path = home / "rapidgen_deploy/manifest.json"
    path.write_text(json.dumps({**json.loads(path.read_bytes()), "format": 2}))
    assert refused(kit.deploy, transport, wanted, overwrite=True) == ["RG531"]


def test_a_hostile_journal_deletes_nothing(kit, home, transport):
    wanted = kit.driver(OLD)
    (home / "mine.mod").write_text("mine")
    kit.deploy(transport, wanted)
    journal = {
        "format": 1,
        "id": 9,
        "attempt": 1,
        "verb": "deploy",
        "started": "",
        "old": None,
        "new": None,
        "known": {},
        "staged": ["mine.mod"],
    }
    (home / "rapidgen_deploy/journal.a").write_text(json.dumps(journal))
    kit.deploy(transport, kit.driver(NEW))
    assert (home / "mine.mod").read_text() == "mine"


def test_a_link_out_of_home_is_refused(kit, home, tmp_path):
    (tmp_path / "elsewhere").mkdir()
    (home / "rapidgen").symlink_to(tmp_path / "elsewhere")
    assert refused(kit.deploy, FolderTransport(home), kit.driver(OLD)) == ["RG508"]
    assert list((tmp_path / "elsewhere").iterdir()) == []
