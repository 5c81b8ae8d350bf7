"""Trial: deploy a driver into copies of real backups, and uninstall it.

    python -m tools.interop.deployed FOLDER    (or: make interop PROGRAM=deployed FOREIGN=FOLDER)

FOLDER holds backups at any depth. A copy of each gets the driver for its MOC.cfg (else an irb120 or
a crb15000). It is planned once more (no change expected), read as a controller, and uninstalled:
then every file must be unchanged. A cell with another driver is rejected and not changed.
"""

import shutil
import sys
import tempfile
from collections import Counter
from pathlib import Path

from rapidgen.deploy import apply, from_files, make_plan
from rapidgen.deploy.transports.folder import FolderTransport
from rapidgen.diagnostics import DiagnosticError
from rapidgen.generate import build
from rapidgen.generate.existing_controller import fit, read_cell
from rapidgen.system import is_backup, read_system
from tools.interop.backups import robot


def answer(folder: Path) -> str:
    """Return the result of a copy as a sentence."""
    before = files(folder)
    try:
        cell = read_cell(folder)
        config = fit(robot(cell), cell)
        desired = from_files({file.path: file.data for file in build(config).files})
        transport = FolderTransport(folder)
        plan = make_plan(transport, desired)
        apply(transport, plan)
        done = make_plan(transport, desired).is_empty
        read_system(folder)
        apply(transport, make_plan(transport, None, verb="uninstall"))
    except DiagnosticError as refused:
        codes = ", ".join(d.code or "?" for d in refused.diagnostics)
        return f"refused ({codes}), {'not touched' if files(folder) == before else 'TOUCHED'}"
    counts = Counter(change.action for change in plan.cfg)
    text = ", ".join(f"{count} to {action}" for action, count in sorted(counts.items()))
    left = "as before" if files(folder) == before else "NOT AS BEFORE"
    return f"{text}; then {'nothing' if done else 'SOMETHING'} to do; uninstalled: {left}"


def files(folder: Path) -> dict[Path, bytes]:
    """Return every file of a folder."""
    return {p.relative_to(folder): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def main(folder: Path) -> None:
    """Print a line for each backup."""
    for place in sorted(p for p in (folder, *folder.rglob("*")) if p.is_dir() and is_backup(p)):
        with tempfile.TemporaryDirectory() as scratch:
            copy = Path(scratch) / "backup"
            shutil.copytree(place, copy)
            (copy / "HOME").mkdir(exist_ok=True)
            print(f"{place.relative_to(folder)}: {answer(copy)}")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
