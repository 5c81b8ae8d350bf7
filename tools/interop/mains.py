"""Count the ends of the mains of many repositories in inferred cells, and their causes.

    python -m tools.interop.mains FOLDER [RESULTS.jsonl]

FOLDER has one subfolder for each repository. Each main, backups included, runs as with
`rapidgen run --cell infer`, at most 4 of a repository, each in a process of its own with a limit
of CPU time. Mains that are equal to an earlier one are left out. The first mains of all
repositories come first. RESULTS.jsonl receives one line
for each main; mains that are in it already are not repeated.

"waits for a peer" is a main that waits at a named socket, file, dialog or guide, or that stops at
what an inferred peer sent. A server that has answered several messages and waits for the next one,
or for the next client, cycles.
"""

import hashlib
import json
import multiprocessing
import re
import resource
import sys
from collections import Counter
from collections.abc import Iterator
from itertools import islice, zip_longest
from pathlib import Path

from tools.interop.programs import Program, programs
from tools.interop.trial import Outcome, cycles

_MOST = 4
"""Mains of one repository."""
_CPU = 40
"""Seconds of CPU of one main."""
_STATEMENTS = 200_000
_FIRST_WORD = re.compile(r"(?:[A-Z]+_[A-Z0-9_]+|RG\d+|\b\d{5}\b)")
GROUPS = {
    "whole": "finishes",
    "goes round": "cycles",
    "waits for the next message": "cycles",
    "waits for a partner": "waits for a peer",
    "stops after a partner": "waits for a peer",
}


def run(program: Program) -> dict[str, object]:
    """Run one main in a process of its own; return its row."""
    context = multiprocessing.get_context("fork")
    receiving, sending = context.Pipe(duplex=False)

    def work() -> None:
        resource.setrlimit(resource.RLIMIT_CPU, (_CPU, _CPU + 5))
        sending.send(cycles(program, "", "once", _STATEMENTS))

    process = context.Process(target=work)
    process.start()
    sending.close()
    try:
        outcome = receiving.recv()
    except EOFError:
        outcome = Outcome("no result", notes=(f"more than {_CPU} s of CPU, or a traceback",))
    process.join()
    end = outcome.end.split(" (")[0]
    return {
        "end": GROUPS.get(end, end),
        "lines": outcome.lines,
        "reached": outcome.reached,
        "notes": outcome.notes,
    }


def sorted_programs(repositories: list[Path]) -> Iterator[tuple[Path, Program]]:
    """Iterate over the mains: the first of each repository, then the second."""
    lists = [list(islice(programs(repository), _MOST)) for repository in repositories]
    for row in zip_longest(*lists):
        yield from ((r, p) for r, p in zip(repositories, row, strict=True) if p is not None)


def digest(program: Program) -> str:
    """Return a key of the contents of a main."""
    first = program.files[0]
    files = sorted(first.rglob("*")) if first.is_dir() else program.files
    total = hashlib.sha256()
    for file in files:
        if file.is_file() and file.suffix.lower() in (".mod", ".modx", ".sys", ".sysx", ".prg"):
            total.update(file.read_bytes())
    return total.hexdigest()


def cause(row: dict[str, object]) -> str:
    """Return the class of what ended a main: the first error name, code or number."""
    notes = [str(note) for note in row["notes"]] if isinstance(row["notes"], (list, tuple)) else []
    for note in notes:
        found = _FIRST_WORD.findall(note)
        if found:
            return str(found[-1] if found[0].startswith("T_") else found[0])
    return notes[0][:40] if notes else ""


def main(folder: Path, results: Path) -> None:
    """Run all mains that are not in the results; print the table."""
    rows = [json.loads(line) for line in results.open()] if results.exists() else []
    known = {row["key"] for row in rows}
    repositories = sorted(p for p in folder.iterdir() if p.is_dir())
    with results.open("a", encoding="utf-8") as file:
        for repository, program in sorted_programs(repositories):
            key = digest(program)
            if key in known:
                continue
            known.add(key)
            row = {
                "key": key,
                "repository": repository.name,
                "main": program.name,
                "backup": program.is_backup,
                **run(program),
            }
            rows.append(row)
            file.write(json.dumps(row) + "\n")
            file.flush()
    names = {p.name for p in folder.iterdir()}
    rows = [row for row in rows if row["repository"] in names]
    ends = Counter(row["end"] for row in rows)
    for end, count in ends.most_common():
        print(f"{count:4} {count / len(rows):4.0%} {end}")
        if end not in ("finishes", "cycles"):
            causes = Counter(cause(row) for row in rows if row["end"] == end)
            print("".join(f"          {n:3} {text}\n" for text, n in causes.most_common()), end="")
    print(f"{len(rows):4} mains of {len({row['repository'] for row in rows})} repositories")


if __name__ == "__main__":
    output = sys.argv[2] if len(sys.argv) > 2 else "mains.jsonl"
    main(Path(sys.argv[1]), Path(output))
