"""Find measures that are slower in a new tree than in an old one.

    python benchmarks/side_by_side.py OLD_PYTHON NEW_PYTHON [--only NAME ...] [--rounds N]

Each tree has an environment of its own. Each measure runs in a fresh process of the old and the new
environment in turn, N times (default 10, after one that does not count). The figure is the median
of the rounds' ratios of CPU time, new to old. Exits with 1 if one is above 1.05. The tree of this
script provides the inputs.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(Path(__file__).resolve().parent))

from backup import write_backup
from kernels import KERNELS, RAPID
from parsing import module

LIMIT = 1.05
REPEATED = {"bubble": 40, "matrix": 40, "calls": 15, "words": 15}
"""Repetitions of a kernel that is fast."""
CLOCK = "import gc, json, time\nfrom pathlib import Path\n"
CONTROLLER = """
try:
    from rapidgen.controller import VirtualController
except ModuleNotFoundError:
    from rapidgen.virtual import VirtualController  # as it was called
"""
COMMANDS = """
import json, os, resource, subprocess, sys
def spent(*words):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", "rapidgen.cli", *words]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
"""


@dataclass(frozen=True)
class Measure:
    """A program that prints a JSON object of CPU seconds by name."""

    name: str
    code: str


MEASURES = (
    Measure(
        "kernels",
        CLOCK
        + CONTROLLER
        + """
from rapidgen.system import ModuleFile, System, TaskSpec
found = {}
gc.disable()
for path in sorted(Path("kernels").glob("*.mod")):
    for accounting in ("none", "block", "statement"):
        task = TaskSpec("T_ROB1", modules=(ModuleFile("kernels", path.name, path.read_bytes()),))
        system = System("kernels", (task,))
        with VirtualController(system, accounting=accounting, cycle="once") as controller:
            started = time.process_time()
            ended = controller.run(max_time=36000)
            taken = time.process_time() - started
            assert ended == "finished" and controller.operator.rows[-1] == "done", ended
        found[path.stem] = found.get(path.stem, 0) + taken
print(json.dumps(found))
""",
    ),
    Measure(
        "parse",
        CLOCK
        + """
from rapidgen.rapid import parse
texts = [path.read_text() for path in sorted(Path("modules").iterdir())]
parse(texts[0])
started = time.process_time()
for text in texts:
    parse(text)
print(json.dumps({"parse": time.process_time() - started}))
""",
    ),
    Measure(
        "check",
        CLOCK
        + """
from rapidgen.rapid import check
from rapidgen.system import ModuleFile, System, TaskSpec
files = [
    ModuleFile(path.stem, path.name, path.read_bytes())
    for path in sorted(Path("modules").iterdir())
]
system = System("modules", (TaskSpec("T_ROB1", modules=tuple(files)),))
started = time.process_time()
check(system)
print(json.dumps({"check": time.process_time() - started}))
""",
    ),
    Measure(
        "load",
        CLOCK
        + CONTROLLER
        + """
started = time.process_time()
VirtualController.from_folder("backup", autostart=False)
print(json.dumps({"load": time.process_time() - started}))
""",
    ),
    Measure(
        "idle",
        CLOCK
        + CONTROLLER
        + """
with VirtualController.from_config("irb120") as controller:
    controller.run_for(5)
    started = time.process_time()
    controller.run_for(1800)
    print(json.dumps({"idle": time.process_time() - started}))
""",
    ),
    Measure(
        "commands",
        COMMANDS
        + """
print(json.dumps({
    "--help": sum(spent("--help") for _ in range(5)),
    "run hello.mod": sum(spent("run", "hello.mod") for _ in range(5)),
    "build": sum(spent("build", "irb120", "-o", "out") for _ in range(5)),
    "build, URDF": spent("build", "cell.yaml", "-o", "urdf"),
}))
""",
    ),
    Measure(
        "schedules",
        COMMANDS
        + """
taken = sum(spent("test", "irb120", "--replay", str(seed)) for seed in range(8))
print(json.dumps({"schedules": taken}))
""",
    ),
)


def inputs(folder: Path, new: str) -> None:
    """Write the inputs of the measures."""
    for place in ("kernels", "modules"):
        (folder / place).mkdir()
    for kernel in KERNELS:
        name = kernel.__name__
        repeated = f"FOR n FROM 1 TO {REPEATED.get(name, 5)} DO\n      x := {name}();\n    ENDFOR"
        call = f'PROC main()\n    VAR num x;\n    {repeated}\n    TPWrite "done";\n'
        text = RAPID.replace("PROC main()\n", call, 1)
        (folder / "kernels" / f"{name}.mod").write_text(text)
    for number in range(200):
        (folder / "modules" / f"m{number}.mod").write_text(module(number, 12))
    write_backup(folder / "backup", 200, 13)
    (folder / "hello.mod").write_text(
        'MODULE hello\n  PROC main()\n    TPWrite "hello";\n  ENDPROC\nENDMODULE\n'
    )
    urdf = Path(__file__).resolve().parents[1] / "robots" / "urdf" / "irb120.urdf"
    subprocess.run(
        [new, "-m", "rapidgen.cli", "new", "cell.yaml", "--urdf", str(urdf)],
        cwd=folder,
        check=True,
        capture_output=True,
    )


def seconds(python: str, measure: Measure, folder: Path) -> dict[str, float]:
    """Return CPU s of each part of the measure, in one process."""
    done = subprocess.run(
        [python, "-c", measure.code],
        cwd=folder,
        capture_output=True,
        text=True,
        env={**os.environ, "NO_COLOR": "1", "PYTHONHASHSEED": "0"},
        check=False,
    )
    if done.returncode:
        raise SystemExit(f"{measure.name}, {python}: {done.stderr}")
    return json.loads(done.stdout.splitlines()[-1])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old", type=os.path.abspath)
    parser.add_argument("new", type=os.path.abspath)
    names = [measure.name for measure in MEASURES]
    parser.add_argument("--only", action="append", choices=names)
    parser.add_argument("--rounds", type=int, default=10)
    arguments = parser.parse_args()
    slower = []
    for python in (arguments.old, arguments.new):
        # Without written bytecode, every process would compile the package again.
        where = "import compileall, rapidgen; compileall.compile_dir(*rapidgen.__path__, quiet=2)"
        subprocess.run([python, "-c", where], cwd="/", check=True)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        inputs(folder, arguments.new)
        print(f"{'':16}{'old':>10}{'new':>10}{'ratio':>8}")
        for measure in MEASURES:
            if arguments.only and measure.name not in arguments.only:
                continue
            rounds = []
            for number in range(arguments.rounds + 1):
                both = [arguments.old, arguments.new]
                # The order alternates: a delay of the machine affects both.
                order = both if number % 2 else both[::-1]
                text = {python: seconds(python, measure, folder) for python in order}
                rounds.append((text[arguments.old], text[arguments.new]))
            for what in rounds[0][0]:
                old, new = ([pair[i][what] for pair in rounds[1:]] for i in (0, 1))
                ratio = statistics.median(n / o for o, n in zip(old, new, strict=True))
                middle = f"{statistics.median(old):10.3f}{statistics.median(new):10.3f}"
                print(f"{what:16}{middle}{ratio:8.3f}{'  slower' * (ratio > LIMIT)}", flush=True)
                slower += [what] * (ratio > LIMIT)
    return bool(slower)


if __name__ == "__main__":
    sys.exit(main())
