"""What a move of the code must not move: records all of it, and compares two records.

    OLD/.venv/bin/python tools/unmoved.py record OLD_CHECKOUT before.json
    NEW/.venv/bin/python tools/unmoved.py record OLD_CHECKOUT after.json
    python tools/unmoved.py compare before.json after.json

The checkout names the inputs, so that both records are of the same programs: builds of the
examples, stories of 50 schedules, traces of the conformance programs, every page of `explain`,
exit code and output of some 40 commands, diagnostics of all conformance programs of the language.
"""

import hashlib
import importlib
import io
import json
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SEEDS = range(50)
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
build nobody
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


def files_of(folder: Path) -> None:
    """The inputs of the commands."""
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
    """Exit code and output of `rapidgen WORDS`, without what a run cannot repeat."""
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

    def still(text: str) -> str:
        text = text.replace(str(folder), "FOLDER")
        text = re.sub(r"\d{4}-\d\d-\d\d[T ][\d:.Z+]+", "TIME", text)
        return re.sub(r"\b\d+(\.\d+)? (ms|s)\b", "DURATION", text)

    return {"exit": done.returncode, "out": still(done.stdout), "err": still(done.stderr)}


def builds(checkout: Path, folder: Path) -> dict[str, object]:
    """The hash of every file of every example."""
    result: dict[str, object] = {}
    for example in sorted((checkout / "robots" / "examples").glob("*.yaml")):
        out = folder / "builds" / example.stem
        text = command(["build", str(example), "-o", str(out)], folder)
        result[example.stem] = text["exit"]
        for path in sorted(p for p in out.rglob("*") if p.is_file()):
            name = str(path.relative_to(folder / "builds"))
            result[name] = hashlib.sha256(path.read_bytes()).hexdigest()
    return result


def traces(checkout: Path) -> dict[str, object]:
    """Every statement of every conformance program, as a hash, and what it printed."""
    result: dict[str, object] = {}
    for folder in ("runtime/conformance", "runtime/builtins/conformance"):
        for file, name, text in programs(checkout / "tests" / folder):
            result[f"{folder}/{file}/{name}"] = trace(name, text)
    return result


def programs(folder: Path) -> Iterator[tuple[str, str, str]]:
    """Theme, name and text of each program; the `tests` on the path may be another checkout's."""
    for path in sorted(folder.rglob("*.mod")):
        parts = re.split(r"^!=== (\w+)\n", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
        for name, text in zip(parts[1::2], parts[2::2], strict=True):
            yield path.stem, name, text


def either(*names: str) -> object:
    """The first of these modules that there is: the rooms have moved."""
    for name in names:
        try:
            return importlib.import_module(name)
        except ModuleNotFoundError as error:
            if not str(error.name).startswith("rapidgen"):
                raise
    raise SystemExit(f"no module of {names}")


def trace(program: str, text: str) -> dict[str, object]:
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


def record(checkout: Path) -> dict[str, dict[str, object]]:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        files_of(folder)
        command(["new", "cell.yaml", "--robot", "irb120"], folder)
        pages = re.findall(r"^RG\d+", str(command(["explain", "all"], folder)["out"]), re.M)
        language = folder / "language"
        for theme, name, text in programs(checkout / "tests" / "rapid" / "conformance"):
            (language / theme).mkdir(parents=True, exist_ok=True)
            (language / theme / f"{name}.mod").write_text(text, encoding="utf-8")
        with ThreadPoolExecutor(2) as pool:
            stories = pool.map(
                lambda seed: command(["test", "irb120", "--replay", str(seed)], folder), SEEDS
            )
            explained = pool.map(lambda page: command(["explain", page], folder), pages)
            result = {
                "builds": builds(checkout, folder),
                "stories": dict(zip(map(str, SEEDS), stories, strict=True)),
                "explain": dict(zip(pages, explained, strict=True)),
            }
        result["commands"] = {
            line: command(line.split(), folder) for line in COMMANDS.split("\n") if line
        }
        result["language"] = {
            path.name: command(["check", path.name, "--format", "json"], language)
            for path in sorted(language.iterdir())
        }
        result["traces"] = traces(checkout)
    return result


def compare(before: Path, after: Path) -> int:
    """Say what differs; how many things did."""
    old, new = (json.loads(path.read_text(encoding="utf-8")) for path in (before, after))
    differing = 0
    for group in old:
        moved = [name for name in old[group] if old[group][name] != new.get(group, {}).get(name)]
        print(f"{group}: {len(old[group])} recorded, {len(moved)} moved")
        for name in moved:
            print(f"  {name}")
            print(f"    - {json.dumps(old[group][name])[:600]}")
            print(f"    + {json.dumps(new.get(group, {}).get(name))[:600]}")
        differing += len(moved)
    return differing


def main() -> int:
    match sys.argv[1:]:
        case ["record", checkout, path]:
            text = json.dumps(record(Path(checkout).resolve()), indent=1)
            Path(path).write_text(text, encoding="utf-8")
            return 0
        case ["compare", before, after]:
            return 1 if compare(Path(before), Path(after)) else 0
    print(__doc__)
    return 2


if __name__ == "__main__":
    sys.exit(main())
