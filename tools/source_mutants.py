"""Find small defects of the source code that its package's tests miss.

    python tools/source_mutants.py [--seed N] [--count N] [--package NAME ...] [--jobs N]
                                   [--output FILE] [--again] [--list]

Draws places by a seed, the same number from each package, and changes one at a time: a comparison,
a number, a condition negated, a statement deleted, a value returned, arguments swapped, an argument
dropped, ... The change is made in a copy of the tree, in which the tests of the package then run
(`rapidgen/ros` has `tests/ros`): first those that execute the line, the fastest first, until one
fails; then the rest. A mutant that passes every test has survived. A hang counts as detected, and
is listed separately. If the failing test also fails without the change, the result is unsure.

Results are lines of JSON in FILE, and a place with a result is not tried again: an interrupted
campaign continues. `--again` repeats the survivors. Mutants without an observable change are listed
in tools/equivalent_mutants.txt, a line each: the mutant's number, and the reason.
"""

import argparse
import ast
import hashlib
import importlib.util
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = ("client", "servers/rws", "ros", "deploy", "machine")
EQUIVALENT = ROOT / "tools" / "equivalent_mutants.txt"
IGNORED = shutil.ignore_patterns(
    ".git", ".venv", "build", "dist", "node_modules", "__pycache__", ".*_cache"
)
MIN_TIME_LIMIT = 60.0
"""Minimum time limit of tests in s; beyond it ten times the usual time."""
LIMIT = 900.0
"""s for the tests that do not execute the line."""

_COMPARED = {
    ast.Lt: ("<", "<="),
    ast.LtE: ("<=", "<"),
    ast.Gt: (">", ">="),
    ast.GtE: (">=", ">"),
    ast.Eq: ("==", "!="),
    ast.NotEq: ("!=", "=="),
    ast.Is: ("is", "is not"),
    ast.IsNot: (r"is\s+not", "is"),
    ast.In: ("in", "not in"),
    ast.NotIn: (r"not\s+in", "in"),
}
_CALCULATED = {
    ast.Add: ("+", "-"),
    ast.Sub: ("-", "+"),
    ast.Mult: ("*", "/"),
    ast.Div: ("/", "*"),
    ast.FloorDiv: ("//", "*"),
    ast.Mod: ("%", "*"),
    ast.BitAnd: ("&", "|"),
    ast.BitOr: ("|", "&"),
}
_OTHER_CALLS = {"min": "max", "max": "min", "any": "all", "all": "any"}


@dataclass(frozen=True)
class Mutant:
    """One change: bytes `start` to `end` of a file become `after`."""

    number: str
    """Hash of the changed text, not of its place: lines above may change."""
    package: str
    file: str
    line: int
    function: str
    kind: str
    start: int
    end: int
    before: str
    after: str


class Places(ast.NodeVisitor):
    """All places of one module that can be changed."""

    def __init__(self, package: str, path: Path) -> None:
        self.package = package
        self.file = path.relative_to(ROOT).as_posix()
        self.data = path.read_bytes()
        self.found: list[Mutant] = []
        self.inside: list[str] = []
        self.lines = [0]
        for line in self.data.splitlines(keepends=True):
            self.lines.append(self.lines[-1] + len(line))
        self.same: Counter[str] = Counter()
        self.visit(ast.parse(self.data))

    # -- skipped
    # ------------------------------------------------------------------------------------

    def visit_Assert(self, node: ast.Assert) -> None:
        """Skip it: it is for the type checker."""

    def visit_JoinedStr(self, node: ast.JoinedStr) -> None:
        """Skip it: texts for users; their spans are not exact on every Python."""

    def visit_AnnAssign(self, node: ast.AnnAssign) -> None:
        if node.value is not None:
            self.visit(node.value)

    def visit_arguments(self, node: ast.arguments) -> None:
        for default in (*node.defaults, *node.kw_defaults):
            if default is not None:
                self.visit(default)

    def visit_FunctionDef(self, node: ast.FunctionDef | ast.AsyncFunctionDef) -> None:
        self.inside.append(node.name)
        self.visit(node.args)
        self._body(node.body)
        self.inside.pop()

    visit_AsyncFunctionDef = visit_FunctionDef

    def visit_ClassDef(self, node: ast.ClassDef) -> None:
        self.inside.append(node.name)
        self._body(node.body)
        self.inside.pop()

    def visit_Module(self, node: ast.Module) -> None:
        self._body(node.body)

    def _body(self, body: list[ast.stmt]) -> None:
        for statement in body:
            if not _is_text(statement):
                self.visit(statement)

    # -- changed
    # ------------------------------------------------------------------------------------

    def visit_Compare(self, node: ast.Compare) -> None:
        left = node.left
        for operator, right in zip(node.ops, node.comparators, strict=True):
            spelled, other = _COMPARED[type(operator)]
            pattern = re.escape(spelled) if spelled[0] in "<>=!" else rf"\b{spelled}\b"
            self._operator("comparison", left, right, pattern, other)
            left = right
        self.generic_visit(node)

    def visit_BoolOp(self, node: ast.BoolOp) -> None:
        spelled, other = ("and", "or") if isinstance(node.op, ast.And) else ("or", "and")
        for left, right in zip(node.values, node.values[1:], strict=False):
            self._operator("and/or", left, right, rf"\b{spelled}\b", other)
        for i in range(len(node.values)):
            left = [v for j, v in enumerate(node.values) if j != i]
            joined = f" {spelled} ".join(f"({self._text(v)})" for v in left)
            self._replace("condition dropped", node, f"({joined})")
        self.generic_visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> None:
        if type(node.op) in _CALCULATED and not (_is_words(node.left) or _is_words(node.right)):
            spelled, other = _CALCULATED[type(node.op)]
            self._operator("arithmetic", node.left, node.right, re.escape(spelled), other)
        self.generic_visit(node)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> None:
        if isinstance(node.op, ast.Not):
            self._replace("not removed", node, f"({self._text(node.operand)})")
        elif isinstance(node.op, ast.USub):
            self._replace("sign", node, f"({self._text(node.operand)})")
            if isinstance(node.operand, ast.Constant):
                return
        self.generic_visit(node)

    def visit_Constant(self, node: ast.Constant) -> None:
        value = node.value
        if isinstance(value, bool):
            self._replace("boolean", node, str(not value))
        elif isinstance(value, int):
            self._replace("number", node, str(value + 1))
            self._replace("number", node, f"({value - 1})")
        elif isinstance(value, float):
            self._replace("number", node, repr(value * 1.5 + 0.25))

    def visit_If(self, node: ast.If) -> None:
        if "TYPE_CHECKING" in self._text(node.test) or "version_info" in self._text(node.test):
            return
        self._replace("condition negated", node.test, f"not ({self._text(node.test)})")
        self.generic_visit(node)

    def visit_IfExp(self, node: ast.IfExp) -> None:
        self._replace("condition negated", node.test, f"(not ({self._text(node.test)}))")
        self.generic_visit(node)

    def visit_comprehension(self, node: ast.comprehension) -> None:
        for condition in node.ifs:
            self._replace("filter dropped", condition, "True")
        self.generic_visit(node)

    def visit_Return(self, node: ast.Return) -> None:
        value = node.value
        if value is not None:
            if not (isinstance(value, ast.Constant) and value.value is None):
                self._replace("returned value", value, "None")
            if isinstance(value, ast.Compare | ast.BoolOp | ast.UnaryOp | ast.Call | ast.Name):
                self._replace("returned value", value, f"(not ({self._text(value)}))")
        elif self.inside:
            self._replace("statement deleted", node, "pass")
        self.generic_visit(node)

    def visit_Expr(self, node: ast.Expr) -> None:
        if isinstance(node.value, ast.Call):
            self._replace("call dropped", node, "pass")
        self.generic_visit(node)

    def visit_Assign(self, node: ast.Assign) -> None:
        if any(isinstance(target, ast.Attribute | ast.Subscript) for target in node.targets):
            self._replace("statement deleted", node, "pass")
        self.generic_visit(node)

    def visit_AugAssign(self, node: ast.AugAssign) -> None:
        self._replace("statement deleted", node, "pass")
        self.generic_visit(node)

    def visit_Raise(self, node: ast.Raise) -> None:
        self._replace("statement deleted", node, "pass")
        self.generic_visit(node)

    def visit_Continue(self, node: ast.Continue) -> None:
        self._replace("statement deleted", node, "pass")

    def visit_Break(self, node: ast.Break) -> None:
        self._replace("statement deleted", node, "pass")

    def visit_Delete(self, node: ast.Delete) -> None:
        self._replace("statement deleted", node, "pass")

    def visit_Call(self, node: ast.Call) -> None:
        for one, other in zip(node.args, node.args[1:], strict=False):
            texts = self._text(one), self._text(other)
            if texts[0] != texts[1] and not any(
                isinstance(a, ast.Starred | ast.GeneratorExp) for a in (one, other)
            ):
                between = self._slice(self._end(one), self._start(other))
                self._change(
                    "arguments swapped",
                    node.lineno,
                    self._start(one),
                    self._end(other),
                    texts[1] + between + texts[0],
                )
        if isinstance(node.func, ast.Name) and node.func.id in _OTHER_CALLS:
            self._replace("other call", node.func, _OTHER_CALLS[node.func.id])
        for i, keyword in enumerate(node.keywords):
            before = [*node.args, *(k.value for k in node.keywords[:i])]
            if before and keyword.arg is not None:
                start = max(self._end(value) for value in before)
                self._change(
                    "argument dropped", keyword.value.lineno, start, self._end(keyword.value), ""
                )
        self.generic_visit(node)

    # -- spans ------------------------------------------------------------------------------------

    def _start(self, node: ast.expr | ast.stmt) -> int:
        return self.lines[node.lineno - 1] + node.col_offset

    def _end(self, node: ast.expr | ast.stmt) -> int:
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        return self.lines[node.end_lineno - 1] + node.end_col_offset

    def _slice(self, start: int, end: int) -> str:
        return self.data[start:end].decode()

    def _text(self, node: ast.expr | ast.stmt) -> str:
        return self._slice(self._start(node), self._end(node))

    def _replace(self, kind: str, node: ast.expr | ast.stmt, after: str) -> None:
        self._change(kind, node.lineno, self._start(node), self._end(node), after)

    def _operator(
        self, kind: str, left: ast.expr, right: ast.expr, spelled: str, other: str
    ) -> None:
        start = self._end(left)
        match = re.search(spelled, self._slice(start, self._start(right)))
        assert match is not None
        line = self.data.count(b"\n", 0, start + match.start()) + 1
        self._change(kind, line, start + match.start(), start + match.end(), other)

    def _change(self, kind: str, line: int, start: int, end: int, after: str) -> None:
        before, function = self._slice(start, end), ".".join(self.inside)
        complete = self.data[self.lines[line - 1] : self.lines[line]].decode().strip()
        what = "\0".join((self.file, function, kind, complete, before, after))
        self.same[what] += 1
        number = hashlib.sha256(f"{what}\0{self.same[what]}".encode()).hexdigest()[:10]
        changed = self.data[:start] + after.encode() + self.data[end:]
        try:
            compile(changed, self.file, "exec", dont_inherit=True)
        except SyntaxError:
            return
        self.found.append(
            Mutant(number, self.package, self.file, line, function, kind, start, end, before, after)
        )


def _is_text(statement: ast.stmt) -> bool:
    """True for a docstring, or a text below an attribute."""
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)


def _is_words(node: ast.expr) -> bool:
    """True if an operand is a text: + joins texts, and % formats one."""
    return isinstance(node, ast.JoinedStr) or (
        isinstance(node, ast.Constant) and isinstance(node.value, str | bytes)
    )


def mutants_of(package: str) -> list[Mutant]:
    """Return all mutants of a package, by file and place."""
    folder = ROOT / "rapidgen" / package
    return [m for path in sorted(folder.rglob("*.py")) for m in Places(package, path).found]


def draw(packages: list[str], seed: int, count: int) -> Iterator[Mutant]:
    """Yield `count` mutants: packages in turn, a random kind, then one of it."""
    chance = random.Random(seed)
    left: dict[str, dict[str, list[Mutant]]] = {}
    for package in packages:
        left[package] = defaultdict(list)
        for mutant in mutants_of(package):
            left[package][mutant.kind].append(mutant)
    for i in range(count):
        kinds = left[packages[i % len(packages)]]
        of_kind = kinds[chance.choice(sorted(kinds))]
        yield of_kind.pop(chance.randrange(len(of_kind)))


class Tests:
    """The tests of a package: executed lines and times."""

    def __init__(self, package: str, cache: Path) -> None:
        self.folder = f"tests/{package}"
        name = package.replace("/", "-")
        digest = hashlib.sha256()
        for folder in (f"rapidgen/{package}", self.folder):
            for path in sorted((ROOT / folder).rglob("*.py")):
                digest.update(path.read_bytes())
        file = cache / f"{name}-{digest.hexdigest()[:16]}.json"
        if not file.is_file():
            self._measure(package, file)
        result = json.loads(file.read_text(encoding="utf-8"))
        self.seconds: dict[str, float] = dict(result["tests"])
        self.names = [name for name, _ in result["tests"]]
        self.lines: dict[str, dict[str, list[int]]] = result["lines"]

    def _measure(self, package: str, file: Path) -> None:
        print(f"which tests of {package} execute what ...", flush=True)
        file.parent.mkdir(parents=True, exist_ok=True)
        made = file.with_suffix(".new")
        environment = {"COVERING": str(made), "COVERED": f"rapidgen/{package}"}
        status = subprocess.run(
            _pytest("-p", "tools.covering_tests", self.folder),
            cwd=ROOT,
            env={**os.environ, **environment, "PYTHONPATH": str(ROOT)},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        if status.returncode:
            raise SystemExit(f"tests fail without any mutant:\n{status.stdout[-3000:]}")
        made.replace(file)

    def of(self, mutant: Mutant) -> list[str]:
        """Return the tests that execute the line, the fastest first.

        Those named like the module come before.
        """
        lines = self.lines.get(mutant.file, {})
        indices = lines.get(str(mutant.line)) or sorted({i for of in lines.values() for i in of})
        stem = Path(mutant.file).stem

        def order(name: str) -> tuple[bool, float]:
            return stem not in Path(name.partition("::")[0]).stem, self.seconds[name]

        return sorted((self.names[i] for i in indices), key=order)


def _pytest(*arguments: str) -> list[str]:
    options = ("-x", "-q", "--no-header", "--tb=no", "-p", "no:cacheprovider", "--timeout=120")
    return [sys.executable, "-m", "pytest", *options, *arguments]


class Copy:
    """A copy of the tree for one mutant at a time."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder / "tree"
        self.listed = folder / "tests.txt"
        shutil.copytree(ROOT, self.folder, ignore=IGNORED, symlinks=True)

    def judge(self, mutant: Mutant, tests: Tests) -> dict[str, Any]:
        """Try a mutant: outcome, detecting test, seconds."""
        path = self.folder / mutant.file
        data, began = path.read_bytes(), time.monotonic()
        complete = data[: mutant.start] + mutant.after.encode() + data[mutant.end :]
        _write(path, complete)
        try:
            first = tests.of(mutant)
            outcome, by = "survived", ""
            if first:
                usual = sum(tests.seconds[name] for name in first)
                outcome, by = self._run(first, MIN_TIME_LIMIT + 10 * usual)
            if outcome == "survived":
                excluded = [f"--deselect={name}" for name in first]
                outcome, by = self._run([*excluded, tests.folder], LIMIT)
        finally:
            _write(path, data)
        if outcome == "detected" and self._run([by], LIMIT)[0] != "survived":
            outcome = "unsure"
        return {"outcome": outcome, "by": by, "seconds": round(time.monotonic() - began, 1)}

    def _run(self, arguments: list[str], limit: float) -> tuple[str, str]:
        self.listed.write_text("\n".join(arguments), encoding="utf-8")
        # Several programs look for rapidgen next to the working directory: both are the copy.
        with subprocess.Popen(
            _pytest(f"@{self.listed}"),
            cwd=self.folder,
            env={**os.environ, "PYTHONPATH": str(self.folder)},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        ) as run:
            try:
                message, _ = run.communicate(timeout=limit)
            except subprocess.TimeoutExpired:
                os.killpg(run.pid, signal.SIGKILL)
                run.communicate()
                return "time-out", ""
        failed = re.search(r"^(?:FAILED|ERROR) (.+?)(?: - .*)?$", message, re.MULTILINE)
        if run.returncode in (0, 5):  # 5: no test is left to run
            return "survived", ""
        return "detected", failed[1] if failed else message[-200:]


def _write(path: Path, data: bytes) -> None:
    """Write a module.

    Its compiled file may look as new as it is, and must go.
    """
    path.write_bytes(data)
    Path(importlib.util.cache_from_source(str(path))).unlink(missing_ok=True)


def equivalent() -> dict[str, str]:
    """Return numbers of equivalent mutants, with the reason."""
    if not EQUIVALENT.is_file():
        return {}
    lines = EQUIVALENT.read_text(encoding="utf-8").splitlines()
    entries = (line.partition(" ") for line in lines if line and not line.startswith("#"))
    return {number: reason.strip() for number, _, reason in entries}


def recorded(output: Path) -> dict[str, dict[str, Any]]:
    """Return existing results, the newest of each mutant."""
    if not output.is_file():
        return {}
    lines = output.read_text(encoding="utf-8").splitlines()
    return {entry["number"]: entry for entry in map(json.loads, lines)}


def tried(
    chosen: list[Mutant], tests: dict[str, Tests], jobs: int, output: Path, seed: int
) -> Iterator[dict[str, Any]]:
    """Try mutants in parallel; yield results as they arrive.

    Each is written immediately.
    """
    waiting: SimpleQueue[Mutant] = SimpleQueue()
    done: SimpleQueue[dict[str, Any]] = SimpleQueue()
    for mutant in chosen:
        waiting.put(mutant)

    def work(folder: Path) -> None:
        copy = Copy(folder)
        while True:
            try:
                mutant = waiting.get_nowait()
            except Empty:
                return
            done.put({**asdict(mutant), "seed": seed, **copy.judge(mutant, tests[mutant.package])})

    with tempfile.TemporaryDirectory(prefix="rapidgen-mutants-") as scratch:
        for i in range(min(jobs, len(chosen))):
            folder = Path(scratch, str(i))
            folder.mkdir()
            threading.Thread(target=work, args=(folder,), daemon=True).start()
        with output.open("a", encoding="utf-8") as file:
            for _ in chosen:
                entry = done.get()
                file.write(json.dumps(entry) + "\n")
                file.flush()
                yield entry


def shown(entry: dict[str, Any]) -> str:
    """Return one line on a mutant."""
    before, after = (" ".join(entry[key].split())[:60] for key in ("before", "after"))
    where = f"{entry['file']}:{entry['line']} {entry['function']}"
    return f"{entry['number']} {where}: {entry['kind']}: {before} -> {after or '(nothing)'}"


def main() -> int:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--count", type=int, default=40, help="places to draw, of all packages")
    options.add_argument("--package", nargs="+", choices=PACKAGES, default=list(PACKAGES))
    options.add_argument("--jobs", type=int, default=2)
    options.add_argument("--output", type=Path, default=ROOT / "build" / "source-mutants.jsonl")
    options.add_argument("--again", action="store_true", help="what survived in the output")
    options.add_argument("--list", action="store_true", help="only say what is drawn")
    arguments = options.parse_args()
    arguments.output.parent.mkdir(parents=True, exist_ok=True)
    known, before = equivalent(), recorded(arguments.output)
    if arguments.again:
        every = {m.number: m for package in arguments.package for m in mutants_of(package)}
        open_ = {n for n, e in before.items() if e["outcome"] in ("survived", "unsure")} - {*known}
        chosen = drawn = [mutant for number, mutant in every.items() if number in open_]
    else:
        drawn = list(draw(arguments.package, arguments.seed, arguments.count))
        chosen = [mutant for mutant in drawn if mutant.number not in before]
    if arguments.list:
        for mutant in drawn:
            print(shown(asdict(mutant)))
        return 0
    cache = arguments.output.parent / "source-mutants"
    tests = {package: Tests(package, cache) for package in {m.package for m in chosen}}
    results = {number: before[number] for number in (m.number for m in drawn) if number in before}
    for entry in tried(chosen, tests, arguments.jobs, arguments.output, arguments.seed):
        results[entry["number"]] = entry
        print(f"{entry['outcome']:9} {entry['seconds']:6.1f} s  {shown(entry)}", flush=True)
    survived = [e for n, e in results.items() if e["outcome"] == "survived" and n not in known]
    counted = Counter(e["outcome"] for e in results.values())
    same = sum(number in known for number in results)
    print(
        f"{len(results)} mutants: {counted['detected']} detected, {counted['time-out']} not ended "
        f"in time, {len(survived)} survived, {same} equivalent, {counted['unsure']} unsure"
    )
    for entry in survived:
        print("survived ", shown(entry))
    return 1 if survived else 0


if __name__ == "__main__":
    sys.exit(main())
