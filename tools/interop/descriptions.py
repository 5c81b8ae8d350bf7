"""Trial: run `rapidgen new` on every URDF and xacro file of folders.

    make interop PROGRAM=descriptions FOREIGN="FOLDER FOLDER ..." [QUICK=1]

The trial simulates a user with at most three answers: a coupling (0), one speed and one range for
all axes without them, and arguments of xacro and of its macros. The resulting driver is booted on
the virtual controller and every joint of every group is moved there. The table gives the reasons of
rejected files and the required answers.
"""

import os
import re
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from rapidgen.config import load_config
from rapidgen.config.draft import DescriptionChoices
from rapidgen.config.model import RobotConfig
from rapidgen.config.scaffold import from_urdf, write_new
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity
from rapidgen.generate import build, make_system
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.testbench import Bench

MOST_ANSWERS = 3
NO_ROBOT = {"RG059": "delta, positioner alone, another maker", "RG031": "macros or parts only"}
BROKEN = {
    "RG032": "a package is not there",
    "RG033": "left over after expansion",
    "RG051": "no tree",
    "RG053": "not what URDF allows",
    "RG056": "arguments or blocks missing",
    "RG060": "no XML",
    "RG061": "xacro cannot expand it",
}
_LACKS = re.compile(
    r"argument '(?P<argument>\w+)' has no value|^macro '\w+' needs a value for '(?P<macro>\w+)'"
)


@dataclass(frozen=True)
class Outcome:
    """The result of a description."""

    name: str
    end: str
    answers: int = 0
    note: str = ""


def descriptions(folders: list[Path]) -> Iterator[Path]:
    """Yield files that may be robots, each text once."""
    seen = set()
    for folder in folders:
        for path in sorted((*folder.rglob("*.urdf"), *folder.rglob("*.xacro"))):
            data = path.read_bytes() if path.is_file() else b""
            if data and data not in seen:
                seen.add(data)
                yield path


def tried(path: Path, folders: list[Path], quick: bool) -> Outcome:
    """Run `new` with its answers, boot and move."""
    answers, answered = DescriptionChoices(), []
    macro, arguments, macro_arguments = None, {}, {}
    with tempfile.TemporaryDirectory() as scratch:
        cell = Path(scratch) / "cell.yaml"
        while True:
            try:
                text = from_urdf(
                    path,
                    folder=cell.parent,
                    package_paths=folders,
                    macro=macro,
                    arguments=arguments,
                    macro_arguments=macro_arguments,
                    answers=answers,
                )
                write_new(cell, text, package_paths=folders, force=True)
                break
            except DiagnosticError as fault:
                wrong = [d for d in fault.diagnostics if d.severity is Severity.ERROR]
                if len(answered) == MOST_ANSWERS:
                    return _refused(path, wrong, len(answered))
                lacking = _LACKS.search(wrong[0].message)
                more = _answer(wrong, answers)
                if lacking:
                    given = macro_arguments if lacking["macro"] else arguments
                    given[lacking["macro"] or lacking["argument"]] = ""
                    answered.append("argument")
                elif more is not None:
                    answers, what = more
                    answered.append(what)
                else:
                    return _refused(path, wrong, len(answered))
        config = load_config(cell, package_paths=folders)
        if quick:
            return Outcome(path.name, "built", len(answered), ", ".join(answered))
        end, note = _moved(config)
        return Outcome(path.name, end, len(answered), note or ", ".join(answered))


def _answer(
    wrong: list[Diagnostic], answers: DescriptionChoices
) -> tuple[DescriptionChoices, str] | None:
    """Return the answers with one more, and its subject."""
    lines = [d.message for d in wrong if d.code == "RG022"]
    if len(lines) < len(wrong):
        return None
    if any("coupling" in line for line in lines) and answers.coupling is None:
        return replace(answers, coupling=0.0), "coupling"
    if any(line.endswith("speed' is open") for line in lines) and answers.speed is None:
        return replace(answers, speed=90.0), "speed"
    if any(line.endswith("lower' is open") for line in lines) and not answers.ranges:
        return replace(answers, ranges={"": (-90.0, 90.0)}), "range"
    return None


def _refused(path: Path, wrong: list[Diagnostic], answers: int) -> Outcome:
    code = wrong[0].code
    kinds = {**NO_ROBOT, **BROKEN}
    if code == "RG022":
        left = Counter(re.sub(r".*\.(\w+)' is open", r"\1", d.message) for d in wrong)
        return Outcome(path.name, "open lines", answers, str(dict(left)))
    return Outcome(path.name, kinds.get(code, code), answers, wrong[0].message)


def _moved(config: RobotConfig) -> tuple[str, str]:
    try:
        bench = Bench(config, make_system(config, build(config)))
    except (DiagnosticError, CheckFailed) as fault:
        return "not booted", str(fault)[:200]
    try:
        for number in range(len(config.groups)):
            own = bench.of_group(number)
            own.assert_moves_through(own.motion(), own.wave(3, duration=1.0))
        bench.assert_healthy()
    except CheckFailed as fault:
        return "not moved", str(fault)[:200]
    finally:
        bench.close()
    return "moved", ""


def main(arguments: list[str]) -> int:
    """Print the table."""
    folders = [Path(argument) for argument in arguments]
    quick = bool(os.environ.get("QUICK"))
    outcomes = []
    for path in descriptions(folders):
        outcome = tried(path, folders, quick)
        outcomes.append(outcome)
        print(
            f"{outcome.end:<40} {outcome.answers} {path.name:<50} {outcome.note[:120]}", flush=True
        )
    ends = Counter(outcome.end for outcome in outcomes)
    for end, count in ends.most_common():
        print(f"{count:5}  {end}")
    rightly = {*NO_ROBOT.values(), *BROKEN.values()}
    arms = [o for o in outcomes if o.end not in rightly]
    good = [o for o in arms if o.end in ("moved", "built")]
    requested = Counter(word for o in good for word in o.note.split(", ") if o.answers)
    print(f"answered: {dict(requested)}")
    print(f"{len(good)} of {len(arms)} with an arm: {100 * len(good) / max(1, len(arms)):.0f} %")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
