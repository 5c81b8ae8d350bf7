"""A cut at every single file operation: before it, after it, and in the middle of a write.

Three kinds of server: rename replaces, rename takes only free names, no rename. After each cut
the controller holds the old set, the new set, or one that refuses; the next run, of whichever
kind, puts it right, and nothing that was not ours is lost.
"""

import itertools
import random
import shutil

import pytest

from rapidgen.deploy import backup_set, make_plan
from rapidgen.deploy.command_run import earlier_set
from rapidgen.deploy.transports.folder import FolderTransport
from rapidgen.diagnostics import DiagnosticError
from tests.deploy.cutting import EVERY, MODES, Cutting

OLD, NEW = "aaaaaaaaaaaa", "bbbbbbbbbbbb"


def leftovers(home):
    state = home / "rapidgen_deploy"
    names = {p.name for p in state.iterdir()} if state.is_dir() else set()
    odd = names - {"manifest.json", "SYS.cfg", "EIO.cfg", "backup"}
    return odd | {p.name for p in home.rglob("*") if ".rg-" in p.name}


def start_of(case, kit, home):
    """HOME before the run, the sets (before, after), and what the run is."""
    transport = FolderTransport(home)
    old, new = kit.driver(OLD), kit.driver(NEW)
    (home / "mine.mod").write_text("MODULE mine\nENDMODULE\n")
    if case == "first":
        return None, old, "deploy", False
    if case == "foreign":
        (home / "rapidgen").mkdir()
        (home / "rapidgen/ROS_motion.mod").write_text("MODULE mine\nENDMODULE\n")
        return None, old, "deploy", True
    kit.deploy(transport, old)
    if case == "update":
        return old, new, "deploy", False
    if case == "fewer":
        return old, kit.driver(NEW, drop=("rapidgen/ROS_stateServer.mod",)), "deploy", False
    if case == "uninstall":
        return old, None, "uninstall", False
    if case == "edited":  # two files edited, BUILD_ID as before: a mixture would not show it
        for name in ("ROS_motion.mod", "ROS_stateServer.mod"):
            path = home / "rapidgen" / name
            path.write_bytes(path.read_bytes().replace(b"line 1", b"LINE 1"))
        return old, old, "deploy", True
    kit.deploy(transport, new)
    return new, backup_set(transport, "", 2), "rollback", False


CASES = ("first", "foreign", "update", "fewer", "uninstall", "edited", "rollback")


def edited_set(kit, home, base):
    """Return the files in `home` as a set, local changes included."""
    files = tuple(
        type(f)(f.path, (home / f.path).read_bytes(), f.kind, f.tasks) for f in base.files
    )
    return type(base)(base.name, base.build_id, base.robotware, files)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("case", CASES)
def test_cut_everywhere(kit, tmp_path, case, mode):
    start = tmp_path / "start"
    start.mkdir()
    before, after, verb, overwrite = start_of(case, kit, start)
    if case == "edited":
        before = edited_set(kit, start, before)
    foreign = case == "foreign"
    work = tmp_path / "work"
    allowed = {"set 0", "set 1", "refuses", *(() if before and after else ("empty",))}

    def fresh():
        shutil.rmtree(work, ignore_errors=True)
        shutil.copytree(start, work)

    fresh()
    line = Cutting(work, mode)
    kit.deploy(line, after, verb=verb, overwrite=overwrite)
    assert not leftovers(work)
    total = line.count
    assert total > 10
    every = 1 if case in ("update", "edited") and mode != "move" else EVERY
    points = range(1 + MODES.index(mode) % every, total + 1, every)
    for at, how in itertools.product(points, ("before", "after", "partial")):
        name, path = line.log[at - 1]
        if how == "partial" and name != "write":
            continue
        fresh()
        with pytest.raises(DiagnosticError):
            kit.deploy(Cutting(work, mode, at, how), after, verb=verb, overwrite=overwrite)
        place = f"{case} {mode}: {how} {name} {path} ({at}/{total})"
        result = kit.verdict(work, before, after)
        if not foreign:
            assert result in allowed, place
        assert (work / "mine.mod").read_text() == "MODULE mine\nENDMODULE\n", place
        undo = tmp_path / "undo"
        shutil.rmtree(undo, ignore_errors=True)
        shutil.copytree(work, undo)
        # Finish: the same run again.
        codes = attempt(kit, Cutting(work, mode), after, verb=verb, overwrite=overwrite)
        # An uninstall may have been complete but for its last breath.
        assert codes == [] or (codes == ["RG529"] and verb == "uninstall"), place
        assert kit.verdict(work, after) == ("set 0" if after else "empty"), place
        assert not leftovers(work), place
        # Undo: where files were being switched, rollback goes back to the set from before.
        if not (undo / "rapidgen_deploy/switching").exists() or verb == "uninstall":
            continue
        transport = Cutting(undo, mode)
        if not make_plan(transport, None, verb="rollback").repair:
            continue
        back = earlier_set(transport, "cell1", None)
        kit.deploy(transport, back, verb="rollback", overwrite=overwrite)
        if foreign:
            target = undo / "rapidgen/ROS_motion.mod"
            assert target.read_text() == "MODULE mine\nENDMODULE\n", place
        else:
            assert kit.verdict(undo, before) == ("set 0" if before else "empty"), place
        assert not leftovers(undo), place


def attempt(kit, transport, aim, **options):
    """Codes of the refusal, none when it went through."""
    try:
        kit.deploy(transport, aim, **options)
    except DiagnosticError as error:
        return [d.code for d in error.diagnostics]
    return []


@pytest.mark.parametrize("mode", MODES)
def test_cut_again_and_again(kit, tmp_path, mode):
    """Runs that are cut one after the other, of changing aims; the last one is not cut."""
    rng = random.Random(f"cuts {mode}")
    old, new = kit.driver(OLD), kit.driver(NEW, drop=("rapidgen/ROS_stateServer.mod",))
    for round_ in range(15 * (4 - EVERY)):
        home = tmp_path / str(round_)
        home.mkdir()
        kit.deploy(FolderTransport(home), old)
        for _ in range(rng.randint(2, 5)):
            aim = rng.choice([old, new])
            how = rng.choice(["before", "after", "partial"])
            codes = attempt(kit, Cutting(home, mode, rng.randint(1, 70), how), aim)
            assert set(codes) <= {"RG505", "RG527"}
            assert kit.verdict(home, old, new) in ("set 0", "set 1", "refuses")
        aim = rng.choice([old, new])
        kit.deploy(Cutting(home, mode), aim)
        assert kit.verdict(home, aim) == "set 0"
        assert not leftovers(home)
        manifest = make_plan(FolderTransport(home), aim).had
        for past in manifest.history:
            assert backup_set(FolderTransport(home), "", past.id).build_id == past.build_id
        kit.deploy(Cutting(home, mode), None, verb="uninstall")
        assert list(home.iterdir()) == []


def test_uninstall_takes_the_common_module_first(kit, home):
    """Whatever the order of the manifest: without ROS_common no task loads."""
    from dataclasses import replace

    old = kit.driver(OLD)
    old = replace(old, files=tuple(reversed(old.files)))
    kit.deploy(FolderTransport(home), old)
    line = Cutting(home, "replace")
    plan = make_plan(line, None, verb="uninstall")
    assert [c.path for c in plan.changes if c.kind == "module"][-1].endswith("ROS_common.sys")
    kit.deploy(line, None, verb="uninstall")
    removed = [path for name, path in line.log if name == "delete" and path.startswith("rapidgen/")]
    assert removed[0] == "rapidgen/ROS_common.sys"
