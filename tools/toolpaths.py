"""Export toolpaths and plans of a folder; print for each what became of it.

    python -m tools.toolpaths FOLDER --config CONFIG [OPTIONS of `rapidgen export`]

Files of all kinds that `export` reads are tried, with the same options. The last line has the sums.
"""

import sys
import tempfile
from collections import Counter
from contextlib import redirect_stderr
from io import StringIO
from pathlib import Path

from rapidgen.cli.app import main
from rapidgen.cli.export import _GCODE, _TABLES

KINDS = (*_GCODE, *_TABLES, ".yaml", ".yml")


def export(path: Path, options: list[str]) -> str:
    """Return the first line of what `rapidgen export` says about a file."""
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "toolpath.mod"
        said = StringIO()
        with redirect_stderr(said):
            code = main(["export", str(path), "-o", str(output), *options])
        lines = [line for line in said.getvalue().splitlines() if line.strip()]
        if code == 0:
            assert output.exists()
            return f"exported: {lines[-1].rpartition(': ')[2]}"
        assert not output.exists(), "a rejected source leaves no module"
        place = next((line.strip() for line in lines if line.strip().startswith("--> ")), "")
        error = next((line for line in lines if line.startswith("error")), lines[0])
        return f"{error} {place.replace(str(path), path.name)}"


def run(folder: Path, options: list[str]) -> None:
    """Export all files of a folder, the smallest first."""
    files = [path for path in folder.rglob("*") if path.suffix.lower() in KINDS]
    counts: Counter[str] = Counter()
    for path in sorted(files, key=lambda path: path.stat().st_size):
        outcome = export(path, options)
        counts[outcome.partition(":")[0]] += 1
        print(f"{path.name}: {outcome}", flush=True)
    print(dict(counts))


if __name__ == "__main__":
    run(Path(sys.argv[1]), sys.argv[2:])
