"""Trial: RWS clients with test suites of their own, and one in C++.

    python -m tools.interop.rws_suites FOLDER   (or: make interop PROGRAM=rws_suites FOREIGN=FOLDER)

FOLDER has checkouts of abb-rws-client (after `npm ci`) and abb_librws under these names, or one of
them; the second needs CMake and libpoco-dev. Both are unchanged. Of the first, the cells of its
structural suite run, which are for live controllers: one virtual controller serves RWS 1.0, another
2.0. Of the second each call is a line. The suite itself injects faults between client and
controller.
"""

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from rapidgen.config import load_config
from rapidgen.controller.runner import ControllerRunner
from rapidgen.servers.rws.server import serve_rws
from rapidgen.system import read_files
from rapidgen.system.model import SignalSpec
from rapidgen.wire.rws.bodies import Generation

MAIN = """MODULE MainModule
    PERS num x := 1;
    VAR num count := 0;
    PROC main()
        WHILE TRUE DO
            count := count + x;
            WaitTime 0.1;
        ENDWHILE
    ENDPROC
ENDMODULE
"""
RELEASES = {Generation.ONE: (6, 15), Generation.TWO: (7, 6)}


@contextmanager
def controller(generation: Generation) -> Iterator[int]:
    """Run a controller in real time; yield the port of its web services."""
    with tempfile.TemporaryDirectory() as scratch:
        path = Path(scratch) / "MainModule.mod"
        path.write_text(MAIN)
        signals = (SignalSpec("doGrip", "DO", access="All"),)
        system = read_files([path])
        system = replace(system, robotware=RELEASES[generation], signals=signals, name="cell")
        groups = load_config("irb120").groups
        with ControllerRunner(system, robots=groups, clock="real", autostart=False) as runner:
            runner.start()
            service = serve_rws(runner, generation)
            try:
                yield service.port
            finally:
                service.close()


def abb_rws_client(folder: Path) -> Iterator[str]:
    """Yield each cell of the structural suite, with its failures."""
    with controller(Generation.ONE) as one, controller(Generation.TWO) as two:
        ports = {"RWS_TEST_PORT_RW6": str(one), "RWS_TEST_PORT_RW7": str(two)}
        subprocess.run(
            ["node", "scripts/structural.mjs"],
            cwd=folder,
            env={**os.environ, **ports, "RWS_STRUCTURAL": "1"},
            stdout=subprocess.DEVNULL,
            check=False,
        )
    report = folder / "docs" / "structural" / ".vitest-results.json"
    cells: dict[str, list[str]] = {}
    for file in json.loads(report.read_text())["testResults"]:
        for test in file["assertionResults"]:
            cell = next(title for title in test["ancestorTitles"] if title)
            failed = [f"    {test['title']}: {line[:200]}" for line in test["failureMessages"][:1]]
            cells.setdefault(cell, []).extend(failed if test["status"] == "failed" else [])
    for cell, failures in sorted(cells.items()):
        yield "\n".join([f"{'FAILED' if failures else 'ok    '} {cell}", *failures])


def abb_librws(folder: Path) -> Iterator[str]:
    """Yield each call and its result."""
    with tempfile.TemporaryDirectory() as scratch, controller(Generation.ONE) as port:
        program = built(folder, "abb_librws.cpp", scratch)
        yield from output_of(program, port)


def built(folder: Path, source: str, scratch: str) -> str:
    """Build abb_librws and a program of this folder that uses it; return the program's path."""
    quiet = {"stdout": subprocess.DEVNULL, "check": True}
    subprocess.run(["cmake", "-S", folder, "-B", scratch], **quiet)
    subprocess.run(["cmake", "--build", scratch], **quiet)
    program = f"{scratch}/trial"
    where = [f"-I{folder}/include", f"-I{scratch}", f"-L{scratch}", f"-Wl,-rpath,{scratch}"]
    libraries = ["-labb_librws", "-lPocoNet", "-lPocoXML", "-lPocoUtil", "-lPocoFoundation"]
    path = str(Path(__file__).with_name(source))
    subprocess.run(["g++", "-o", program, path, *where, *libraries], check=True)
    return program


def output_of(program: str, port: int) -> Iterator[str]:
    """Yield the lines that a program writes about a controller."""
    ran = subprocess.run(
        [program, "127.0.0.1", str(port)], capture_output=True, text=True, check=False
    )
    yield from ran.stdout.splitlines()


TRIALS = {"abb-rws-client": abb_rws_client, "abb_librws": abb_librws}


def main(folder: Path) -> None:
    """Print the results of both."""
    for name, trial in TRIALS.items():
        if (folder / name).is_dir():
            print(f"{name}:")
            for line in trial(folder / name):
                print(f"  {line}", flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
