"""Compare the behaviour of two checkouts before and after a refactoring.

    OLD/.venv/bin/python tools/unmoved.py record OLD_CHECKOUT before.json
    NEW/.venv/bin/python tools/unmoved.py record OLD_CHECKOUT after.json [--names NAMES.tsv]
    python tools/unmoved.py compare before.json after.json [--without-texts] [--names NAMES.tsv]

The checkout provides the inputs, so that both records are of the same programs: builds of the
examples, logs of 50 schedules, traces of the conformance programs, every page of `explain`, exit
code and output of some 40 commands, diagnostics of all conformance programs of the language, and
the bytes of a dialogue with a generated driver. `--only GROUP,...` records some of these groups.

`--without-texts` ignores sentences, comments and hashes of them. It compares diagnostic codes with
their places, exit codes, numbers, RAPID code without comments and texts, traces and wire bytes.
NAMES.tsv maps renamed identifiers, two columns: old and new. A line of three columns, `command`,
old and new, is a renamed command line: `record` runs the new one and stores it under the old one.
"""

import argparse
import hashlib
import importlib
import io
import json
import os
import re
import struct
import subprocess
import sys
import tempfile
from collections.abc import Callable, Collection, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from difflib import unified_diff
from pathlib import Path
from typing import Any, TypeAlias

Record: TypeAlias = dict[str, dict[str, object]]

SEEDS = range(50)
CODE = frozenset({".mod", ".sys", ".cfg", ".pgf"})
STOP = struct.pack("<5i12f", 64, 11, 2, 0, -4, *[0.0] * 12)
"""JOINT_TRAJ_PT with the sequence number -4, as a request."""
BROKEN_YAML = "robot: {name: x\n  ports: [\n"
BROKEN_MODULE = 'MODULE m\n  PROC main()\n    x := "a;\n  ENDPROC\nENDMODULE\n'
HELLO = 'MODULE hello\n  PROC main()\n    TPWrite "hello";\n  ENDPROC\nENDMODULE\n'
ENDS = "MODULE ends\n  PROC main()\n    VAR num a;\n    a := 1 / a;\n  ENDPROC\nENDMODULE\n"
UNKNOWN = "MODULE u\n  PROC main()\n    SetDO do1, 1;\n    nothing;\n  ENDPROC\nENDMODULE\n"
UGLY = 'module ugly\nproc main()\nif true then\ntpwrite "x" ;\nendif\nendproc\nendmodule\n'
COMMANDS = """
--version
robots
schema
check cell.yaml
check cell.yaml --format json
check broken.yaml
check broken.yaml --format json
check typo.yaml
check typo.yaml --format json
check range.yaml --format json
check hello.mod --format json
check broken.mod
check broken.mod --format json
check broken.mod --format concise
check broken.mod --format github
check unknown.mod --format json
check ends.mod unknown.mod broken.yaml --format json
check nowhere.mod
check nowhere.mod --format json
check hello.mod --robotware 9
explain RG999
explain
build cell.yaml --list
build cell.yaml --set motion.rate=abc
build cell.yaml --set ports.motion=80
build missing
build irb121
fmt ugly.mod --check
fmt ugly.mod --diff
fmt broken.mod --check
run hello.mod
run ends.mod
run unknown.mod
run broken.mod
run hello.mod --entry nothing
run hello.mod --robot irb999
run loop.mod --max-time 1
run hello.mod --cycle sometimes
plan cell.yaml --to dir://controller
plan cell.yaml --to gopher://x
deploy cell.yaml --to dir://nowhere/at/all
move cell.yaml nowhere.csv
move cell.yaml short.csv --to 127.0.0.1:1,2
test irb120 --case nothing
stop cell.yaml --to 127.0.0.1:1,2
nothing
new cell.yaml --robot irb120
new other.yaml --robot irb12
demo --nothing
"""


def write_inputs(folder: Path) -> None:
    """Write the inputs of the commands."""
    loop = "MODULE loop\n  PROC main()\n    WHILE TRUE DO\n      WaitTime 1;\n    ENDWHILE\n"
    texts = {
        "broken.yaml": BROKEN_YAML,
        "typo.yaml": "model: irb120\nname: t\ntrajectroy: {capacity: 10}\nports: {motoin: 1}\n",
        "range.yaml": "model: irb120\nname: r\nports: {motion: 99999}\nrates: {state: -1}\n",
        "hello.mod": HELLO,
        "broken.mod": BROKEN_MODULE,
        "ends.mod": ENDS,
        "unknown.mod": UNKNOWN,
        "ugly.mod": UGLY,
        "loop.mod": loop + "  ENDPROC\nENDMODULE\n",
        "short.csv": "time,joint_1\n0,0\n1,0.1\n",
    }
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    (folder / "controller").mkdir()


def command(words: list[str], folder: Path) -> dict[str, object]:
    """Return exit code and output of `rapidgen WORDS`, without times."""
    done = subprocess.run(
        [sys.executable, "-m", "rapidgen.cli", *words],
        cwd=folder,
        capture_output=True,
        text=True,
        env=dict(os.environ, NO_COLOR="1", COLUMNS="100", TERM="dumb"),
        stdin=subprocess.DEVNULL,
        check=False,
        timeout=300,
    )

    def without_times(text: str) -> str:
        text = text.replace(str(folder), "FOLDER")
        text = re.sub(r"\d{4}-\d\d-\d\d[T ][\d:.Z+]+", "TIME", text)
        return re.sub(r"\b\d+(\.\d+)? (ms|s)\b", "DURATION", text)

    output, errors = without_times(done.stdout), without_times(done.stderr)
    return {"exit": done.returncode, "out": output, "err": errors}


def builds(checkout: Path, folder: Path) -> dict[str, object]:
    """Return the text of every RAPID and cfg file of every example, of others the hash."""
    result: dict[str, object] = {}
    for example in sorted((checkout / "robots" / "examples").glob("*.yaml")):
        out = folder / "builds" / example.stem
        result[example.stem] = command(["build", str(example), "-o", str(out)], folder)["exit"]
        for path in sorted(p for p in out.rglob("*") if p.is_file()):
            data = path.read_bytes()
            is_code = path.suffix.lower() in CODE
            result[str(path.relative_to(folder / "builds"))] = (
                data.decode("latin-1") if is_code else hashlib.sha256(data).hexdigest()
            )
    return result


def wire(checkout: Path) -> dict[str, object]:
    """Return all messages of a driver while a client moves the robot and stops it."""
    testbench = either("rapidgen.verification.testbench", "rapidgen.proving.bench")
    load_config = importlib.import_module("rapidgen.config").load_config
    generate = importlib.import_module("rapidgen.generate")
    result: dict[str, object] = {}
    for name in ("irb120", "irb460"):
        example = checkout / "robots" / "examples" / f"{name}.yaml"
        config = load_config(example if example.exists() else name)
        system = generate.make_system(config, generate.build(config))
        with testbench.Bench(config, system) as bench:
            state, motion = bench.watcher(), bench.motion()
            points = bench.wave(6)
            motion.send(bench.download(points))
            bench.run(4)
            motion.send(bench.download(bench.wave(20)))
            bench.run(2)
            motion.send(STOP)
            bench.run(2)
            for label, link in (("state", state), ("motion", motion)):
                link.read()
                result[f"{name} {label}"] = [
                    [round(when, 6), *frame[:3], masked(frame[3], system.build_id)]
                    for when, frame in link.frames
                ]
    return result


def masked(data: bytes, build_id: str) -> str:
    """Return data as hexadecimal digits, with the build id, which texts change, masked."""
    return data.replace(build_id.encode(), b"BUILD-ID 123").hex()


def traces(checkout: Path) -> dict[str, object]:
    """Return the statements of every conformance program as a hash, and its output."""
    result: dict[str, object] = {}
    for folder in ("runtime/conformance", "runtime/builtins/conformance"):
        for file, name, text in programs(checkout / "tests" / folder):
            result[f"{folder}/{file}/{name}"] = trace(name, text)
    return result


def programs(folder: Path) -> Iterator[tuple[str, str, str]]:
    """Yield theme, name and text of each program, also of one that is a file of its own.

    Not imported from `tests`: those on the path may be another checkout's.
    """
    for path in sorted(folder.rglob("*.mod")):
        text = path.read_text(encoding="utf-8")
        parts = re.split(r"^!=== (\w+)\n", text, flags=re.MULTILINE)
        if len(parts) == 1:
            yield path.parent.name, path.stem, text
        for name, program in zip(parts[1::2], parts[2::2], strict=True):
            yield path.stem, name, program


def either(*names: str) -> Any:
    """Return the first of these modules that exists, as packages have moved."""
    for name in names:
        try:
            return importlib.import_module(name)
        except ModuleNotFoundError as error:
            if not str(error.name).startswith("rapidgen"):
                raise
    raise SystemExit(f"no module of {names}")


def trace(program: str, text: str) -> dict[str, object]:
    """Execute a conformance program; return its output, and a hash of its statements."""
    controller_package = either("rapidgen.controller", "rapidgen.virtual")
    tracing = either("rapidgen.controller.tracing", "rapidgen.virtual.tracing")
    switches = either(
        "rapidgen.rapid.switches", "rapidgen.runtime.switches", "rapidgen.virtual.dialect"
    )
    parse = getattr(switches, "parse_switches", None) or switches.parse_dialect
    mechanics = either("rapidgen.controller.mechanics", "rapidgen.virtual.mechanics")
    load_config = importlib.import_module("rapidgen.config").load_config
    model = importlib.import_module("rapidgen.system.model")

    def marks(marker: str) -> list[str]:
        return [m.strip() for m in re.findall(rf"^\s*! {marker}:(.*)$", text, re.MULTILINE)]

    starts = [m.start() for m in re.finditer(r"^MODULE", text, re.MULTILINE)]
    modules = tuple(
        model.ModuleFile(
            program, f"{program}.mod", ("\n" * text.count("\n", 0, a) + text[a:b]).encode("latin-1")
        )
        for a, b in zip([0, *starts[1:]], [*starts[1:], len(text)], strict=True)
    )
    tasks = [model.TaskSpec("T_ROB1", "NORMAL", "SysFail", "main", True, "", modules)]
    for line in marks("task"):
        name, entry, *type_ = line.split()
        kind = type_[0] if type_ else "NORMAL"
        tasks.append(model.TaskSpec(name, kind, "NoSafety", entry, "ROB" in name, "", modules))
    signals = tuple(
        model.SignalSpec(name, kind, size=int(size[0]) if size else 1)
        for name, kind, *size in map(str.split, marks("signal"))
    )
    system = model.System(program, tuple(tasks), signals)
    robots = [
        group
        for name in marks("robot")
        for group in mechanics.groups_for(system, load_config(name).groups)
    ]
    stream = io.StringIO()
    printed: list[str] = []
    with controller_package.VirtualController(
        system,
        robots,
        cycle="once",
        autostart=False,
        tracing=True,
        dialect=parse(",".join(marks("dialect"))),
    ) as controller:
        tracing.Trace(controller, stream)
        controller.operator.subscribe(lambda _, line: printed.append(line))
        controller.start_program()
        finished = controller.run(max_time=60, max_statements=200_000)
    trace_text = stream.getvalue()
    return {
        "ended": finished,
        "printed": printed,
        "statements": trace_text.count("\n"),
        "trace": hashlib.sha256(trace_text.encode()).hexdigest(),
    }


def record(checkout: Path, names: "Names", only: Collection[str] = ()) -> Record:
    """Record the behaviour of the rapidgen that is imported, with the inputs of a checkout."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_inputs(folder)
        command(["new", "cell.yaml", "--robot", "irb120"], folder)

        def run(lines: dict[str, list[str]], where: Path = folder) -> dict[str, object]:
            with ThreadPoolExecutor(2) as pool:
                results = pool.map(lambda words: command(words, where), lines.values())
                return dict(zip(lines, results, strict=True))

        def renamed(line: str) -> list[str]:
            return names.commands.get(line, line).split()

        def pages() -> dict[str, object]:
            known = re.findall(r"^RG\d+", str(command(["explain", "all"], folder)["out"]), re.M)
            return run({page: ["explain", page] for page in known})

        def language() -> dict[str, object]:
            themes = folder / "language"
            for theme, program, text in programs(checkout / "tests" / "rapid" / "conformance"):
                (themes / theme).mkdir(parents=True, exist_ok=True)
                (themes / theme / f"{program}.mod").write_text(text, encoding="utf-8")
            lines = {p.name: ["check", p.name, "--format", "json"] for p in themes.iterdir()}
            return run(dict(sorted(lines.items())), themes)

        groups: dict[str, Callable[[], dict[str, object]]] = {
            "builds": lambda: builds(checkout, folder),
            "schedules": lambda: run(
                {str(seed): renamed(f"test irb120 --replay {seed}") for seed in SEEDS}
            ),
            "explain": pages,
            "commands": lambda: run({c: renamed(c) for c in COMMANDS.split("\n") if c}),
            "language": language,
            "traces": lambda: traces(checkout),
            "wire": lambda: wire(checkout),
        }
        unknown = set(only) - set(groups)
        if unknown:
            raise SystemExit(f"no group {', '.join(sorted(unknown))}: {', '.join(groups)}")
        return {group: work() for group, work in groups.items() if not only or group in only}


@dataclass(frozen=True)
class Names:
    """Renamed identifiers and command lines, old to new."""

    identifiers: dict[str, str] = field(default_factory=dict)
    commands: dict[str, str] = field(default_factory=dict)

    @classmethod
    def read(cls, path: Path | None) -> "Names":
        """Read a table of names; see the module's docstring."""
        rows = [] if path is None else path.read_text(encoding="utf-8").splitlines()
        cells = [row.split("\t") for row in rows if row and not row.startswith("#")]
        return cls(
            {row[0]: row[1] for row in cells if len(row) == 2},
            {row[1]: row[2] for row in cells if len(row) == 3 and row[0] == "command"},
        )

    def apply(self, text: str) -> str:
        """Return the text with new identifiers, whatever their case."""
        lowered = {old.lower(): new for old, new in self.identifiers.items()}
        return re.sub(r"\w+", lambda word: lowered.get(word[0].lower(), word[0]), text)


def compare(before: Path, after: Path, names: Names, *, without_texts: bool = False) -> int:
    """Print the differences of two records and return their number."""
    old, new = (json.loads(path.read_text(encoding="utf-8")) for path in (before, after))
    differing = 0
    for group in [group for group in old if group in new]:
        was = {names.apply(name): (name, value) for name, value in old[group].items()}
        if group == "commands":
            was = {name: (name, value) for name, value in old[group].items()}
        now = {name: comparable(name, value, without_texts) for name, value in new[group].items()}
        moved = []
        for name, (old_name, value) in was.items():
            expected = comparable(old_name, value, without_texts, names)
            if expected != now.get(name):
                moved.append((name, expected, now.get(name)))
        moved += [(name, None, value) for name, value in now.items() if name not in was]
        print(f"{group}: {len(old[group])} recorded, {len(moved)} moved")
        for name, expected, actual in moved:
            print(f"  {name}")
            for line in difference(expected, actual):
                print(f"    {line}")
        differing += len(moved)
    return differing


def difference(expected: object, actual: object) -> list[str]:
    """Return the first differing lines of two values."""
    old, new = (
        value.split("\n") if isinstance(value, str) else json.dumps(value, indent=0).split("\n")
        for value in (expected, actual)
    )
    return [line[:200] for line in unified_diff(old, new, lineterm="", n=0)][2:14]


def comparable(name: str, value: object, without_texts: bool, names: Names | None = None) -> object:
    """Return what counts of a recorded value."""
    if isinstance(value, str) and names is not None:
        value = names.apply(value)
    if not without_texts:
        return value
    if isinstance(value, str):
        return code_of(value) if Path(name).suffix.lower() in CODE else ""
    if isinstance(value, dict) and {"exit", "out", "err"} <= value.keys():
        return [value["exit"], findings_of(value["out"]), findings_of(value["err"])]
    return value


def code_of(text: str) -> str:
    """Return RAPID or cfg code without comments, texts, build ids and layout."""
    lines = []
    for line in text.splitlines():
        without = re.sub(r'"[^"]*"', '""', line)
        without = re.sub(r"!.*|^\s*#.*", "", without)
        if without.strip():
            lines.append(re.sub(r"\s+", " ", without).strip())
    return "\n".join(lines)


def findings_of(output: str) -> list[object]:
    """Return codes, severities and places of the diagnostics in an output, else its numbers."""
    try:
        data = json.loads(output)
    except json.JSONDecodeError:
        coded = re.findall(r"RG\d{3}", output)
        return [*coded, *re.findall(r"[\w./-]+:\d+:\d+", output)]
    if not isinstance(data, list):
        return [sorted(data) if isinstance(data, dict) else data]
    keys = ("code", "severity", "path", "file", "line", "column", "end_line", "end_column")
    return [{k: d[k] for k in keys if k in d} if isinstance(d, dict) else d for d in data]


def main() -> int:
    """Record, or compare two records."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    verbs = parser.add_subparsers(required=True, dest="verb")
    recording = verbs.add_parser("record")
    recording.add_argument("checkout", type=Path)
    recording.add_argument("file", type=Path)
    recording.add_argument("--only", default="", metavar="GROUP,...")
    comparing = verbs.add_parser("compare")
    comparing.add_argument("before", type=Path)
    comparing.add_argument("after", type=Path)
    comparing.add_argument("--without-texts", action="store_true")
    for verb in (recording, comparing):
        verb.add_argument("--names", type=Path)
    arguments = parser.parse_args()
    names = Names.read(arguments.names)
    if arguments.verb == "record":
        only = [group for group in arguments.only.split(",") if group]
        text = json.dumps(record(arguments.checkout.resolve(), names, only), indent=1)
        arguments.file.write_text(text, encoding="utf-8")
        return 0
    texts = {"without_texts": arguments.without_texts}
    return 1 if compare(arguments.before, arguments.after, names, **texts) else 0


if __name__ == "__main__":
    sys.exit(main())
