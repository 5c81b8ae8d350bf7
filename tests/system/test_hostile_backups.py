"""Hostile backups: rejected or read, and no file outside is read."""

import os
import time

import pytest

from rapidgen.diagnostics import DiagnosticError, Severity
from rapidgen.rapid import parse
from rapidgen.system import read_backup

SECRET = "canary-content"
LIMIT = 5.0
"""s of CPU time for each backup."""
SYS = 'SYS:CFG_1.0:6:0::\n#\nCAB_TASKS:\n\n      -Name "T_ROB1" -MotionTask\n'
MODULES = SYS + "#\nCAB_TASK_MODULES:\n\n      -File {} -Task T_ROB1\n"
SIZE = 200_000
CFG = {
    "empty": b"",
    "no header": b"CAB_TASKS:\n",
    "noise": bytes(range(256)) * 400,
    "NUL": SYS.encode() + b"\0" * SIZE,
    "UTF-16": SYS.encode("utf-16"),
    "long line": SYS.encode() + b"      -Name " + b"a" * SIZE,
    "open quote": SYS.encode() + b'      -Name "' + b"a\n" * (SIZE // 2),
    "continued lines": SYS.encode() + b"      -Name a\\\n" * (SIZE // 16),
    "many sections": SYS.encode() + b"#\nA:\n" * (SIZE // 6),
    "many instances": SYS.encode() + b'\n      -Name "a"\n' * (SIZE // 18),
    "many modules": MODULES.format('"HOME:/a.mod" -AllTask').encode()
    + b'\n      -File "HOME:/a.mod" -AllTask\n' * (SIZE // 40),
    "many attributes": SYS.encode() + b"\n      " + b"-a 1 " * (SIZE // 5),
    "dashes": SYS.encode() + b"-" * SIZE,
    "quotes": SYS.encode() + b'"' * SIZE,
    "a task upwards": SYS.replace("T_ROB1", "../../outside").encode(),
    "a task with a line": SYS.replace("T_ROB1", "T_ROB1\n").encode(),
    "a module upwards": MODULES.format('"HOME:/../../outside"').encode(),
    "a module upwards with backslashes": MODULES.format('"HOME:\\..\\..\\outside"').encode(),
    "a module of the machine": MODULES.format('"/etc/passwd"').encode(),
    "a module of a drive": MODULES.format('"C:/outside"').encode(),
    "a module that is a folder": MODULES.format('"HOME:/"').encode(),
    "a module by a link": MODULES.format('"HOME:/link.mod"').encode(),
    "a module by a linked folder": MODULES.format('"HOME:/way/outside"').encode(),
    "a module that is a pipe": MODULES.format('"HOME:/pipe.mod"').encode(),
    "a module that is a device": MODULES.format('"HOME:/device.mod"').encode(),
    "a module in a circle": MODULES.format('"HOME:/circle.mod"').encode(),
    "a large module": MODULES.format('"HOME:/large.mod"').encode(),
    "a long name of a module": MODULES.format('"HOME:/' + "a" * 5000 + '"').encode(),
}
LINKS = [
    "SYSPAR", "RAPID", "RAPID/TASK1", "RAPID/TASK1/PROGMOD", "RAPID/TASK1/PROGMOD/a.mod", "HOME",
    "SYSPAR/SYS.cfg", "SYSPAR/EIO.cfg", "SYSPAR/MOC.cfg", "BACKINFO", "BACKINFO/backinfo.txt",
]  # fmt: skip
RAPID = {
    "brackets": "x := " + "(" * SIZE,
    "lists": "x := " + "[" * SIZE,
    "signs": "x := " + "-" * SIZE + "1;",
    "NOT": "x := " + "NOT " * (SIZE // 4) + "TRUE;",
    "sums": "x := 1" + "+1" * (SIZE // 2) + ";",
    "indices": "x" + "{1" * (SIZE // 2),
    "conditions": "IF TRUE THEN\n" * (SIZE // 13),
    "loops": "WHILE TRUE DO\n" * (SIZE // 14),
    "routines": "PROC a()\n" * (SIZE // 9),
    "records": "RECORD a\n" * (SIZE // 9),
    "text": 'x := "' + "a" * SIZE,
    "number": "x := " + "9" * SIZE + ";",
    "name": "a" * SIZE,
    "comments": "!\n" * (SIZE // 2),
    "statements": ";" * SIZE,
    "placeholders": "<SMT>" * (SIZE // 5),
    "modules": "MODULE a\n" * (SIZE // 9),
}


@pytest.fixture
def backup(tmp_path):
    folder = tmp_path / "backup"
    for part in ("SYSPAR", "RAPID/TASK1/PROGMOD", "HOME", "BACKINFO"):
        (folder / part).mkdir(parents=True)
    (folder / "SYSPAR/SYS.cfg").write_text(SYS)
    outside = tmp_path / "outside"
    outside.mkdir()
    for name in ("outside", "SYS.cfg", "a.mod", "backinfo.txt"):
        (outside / name).write_text(f"MODULE a\n! {SECRET}\nENDMODULE\n")
    home = folder / "HOME"
    (home / "link.mod").symlink_to(outside / "a.mod")
    (home / "way").symlink_to(outside)
    (home / "device.mod").symlink_to("/dev/zero")
    (home / "circle.mod").symlink_to("circle.mod")
    os.mkfifo(home / "pipe.mod")
    with (home / "large.mod").open("wb") as file:
        file.truncate(1 << 36)
    return folder


def read(folder):
    """What is said of a backup, and the bytes of its modules."""
    notes = []
    began = time.thread_time()
    try:
        system = read_backup(folder, notes=notes)
        modules = [module.data for task in system.tasks for module in task.modules]
    except DiagnosticError as refused:
        notes, modules = [*notes, *refused.diagnostics], []
    assert time.thread_time() - began < LIMIT
    for result in notes:
        assert SECRET not in result.message + result.help + result.label
        assert len(result.message) < 6000
    assert not any(SECRET.encode() in module for module in modules)
    return notes


@pytest.mark.parametrize("name", CFG)
def test_hostile_cfg(backup, name):
    (backup / "SYSPAR/SYS.cfg").write_bytes(CFG[name])
    result = read(backup)
    if name.startswith(("a module", "a large module", "a long name")):
        assert result


@pytest.mark.parametrize("name", LINKS)
def test_links_out_of_a_backup(backup, tmp_path, name):
    place = backup / name
    if place.is_dir():
        place.rename(tmp_path / "moved")
    else:
        place.unlink(missing_ok=True)
    place.symlink_to(tmp_path / "outside" / ("a.mod" if place.suffix else ""))
    assert any(d.severity is Severity.ERROR for d in read(backup))


@pytest.mark.parametrize("name", RAPID)
def test_hostile_rapid_is_parsed(name):
    began = time.thread_time()
    module = parse(f"MODULE m\nPROC main()\n{RAPID[name]}\nENDPROC\nENDMODULE\n")
    assert time.thread_time() - began < LIMIT
    assert module.diagnostics or name in ("comments", "placeholders")
