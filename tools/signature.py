"""Acceptance: the suite on every example, and on configuration variants.

    python tools/signature.py [--part N/M] [--of LABEL ...] [--jobs N] [--strength N]
                                   [--output FILE] [--plan]

Every example of robots/examples, and for the IRB 120 the configurations in which any two of
profile, commissioning, main and control port meet; each under the settings in which any two
assumptions about controllers meet. The configurations that differ most from the IRB 120 come first.
The output ends with one table. Reports go to FILE (JSON lines) as they arrive, results of each case
into a folder next to it: a result of the same tree is not computed again, so that a run may be
interrupted anywhere and continue later, or be done in parts (`--part 1/3`, or some by name) of
which the last one prints the whole table. `--plan` only names them, and loads each configuration.
"""

import argparse
import hashlib
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.config import load_config
from rapidgen.verification.covering_array import covering
from rapidgen.verification.report import as_json
from rapidgen.verification.suite_runner import run_suite

ROOT = Path(__file__).resolve().parents[1]
BASE = ROOT / "robots" / "examples" / "irb120-rw6.yaml"
CHOICES = {
    # The basic profile has no control port.
    "profile and control port": (
        "profile=full ports.control=11001",
        "profile=full ports.control=0",
        "profile=basic ports.control=0",
    ),
    "commissioning": ("commissioning=false", "commissioning=true"),
    "main": ("main=driver", "main=own"),
}


def runs():
    """Return label, configuration and overrides of each run."""
    examples = sorted(
        BASE.parent.glob("*.yaml"), key=lambda p: (p.name.startswith("irb120"), p.name)
    )
    result = [(path.stem, path, ()) for path in examples]
    for row in covering(CHOICES)[1:]:
        overrides = tuple(text for texts in row.values() for text in texts.split())
        result.append((" ".join(overrides), BASE, overrides))
    return result


def tree():
    """Return a hash of everything that reports depend on, besides the configuration."""
    paths = [p for top in ("rapidgen", "templates", "robots") for p in (ROOT / top).rglob("*.*")]
    digest = hashlib.sha256()
    for path in sorted(p for p in paths if p.is_file() and p.suffix != ".pyc"):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def done(of):
    """Return reports of this tree, by label."""
    if not GIVEN.output.exists():
        return {}
    lines = GIVEN.output.read_text(encoding="utf-8").splitlines()
    return {row["label"]: row for row in map(json.loads, lines) if row["tree"] == of}


def proven(label, path, overrides, of):
    config = load_config(str(path), overrides=overrides)
    saved = GIVEN.output.with_suffix("") / of / f"{label.replace(' ', '_')}-{GIVEN.strength}.jsonl"
    saved.parent.mkdir(parents=True, exist_ok=True)
    proof = run_suite(
        config,
        seeds=100,
        jobs=GIVEN.jobs,
        strength=GIVEN.strength,
        results=saved,
        resume=True,
    )
    if proof.broken_off:
        return None
    report = as_json(proof)
    outcomes = report.pop("outcomes")
    outcomes = [outcome for outcome in outcomes if not outcome["untried"]]
    report |= {"label": label, "tree": of, "cases": len(outcomes)}
    report["broken"] = [outcome for outcome in outcomes if not outcome["passed"]]
    return report


def show(reports):
    print(f"{'':58} {'build':12} {'cases':>11} {'schedules':>9} {'lines':>6} {'s':>5}")
    for row in reports:
        held = f"{row['cases'] - len(row['broken'])} of {row['cases']}"
        schedules = f"{row['schedules'] - len(row['findings'])} of {row['schedules']}"
        lines = row["lines"]["reached"] / max(1, row["lines"]["of"])
        print(
            f"{row['label']:58} {row['build_id']:12} {held:>11} {schedules:>9} {lines:6.1%} "
            f"{row['elapsed']:5.0f}"
        )
    for row in reports:
        for outcome in row["broken"]:
            print(f"{row['label']}: {outcome['case']} [{outcome['setting']}]", end="")
            print(f" {' and '.join(outcome['blamed'])}: {outcome['detail'][:120]}")
        for finding in row["findings"]:
            print(f"{row['label']}: --replay {finding['seed']}: {finding['detail'][:120]}")
    cases, broken = sum(row["cases"] for row in reports), sum(len(r["broken"]) for r in reports)
    print(f"{cases - broken} of {cases} held on {len(reports)} configurations")


def main():
    of, every = tree(), runs()
    number, parts = (int(n) for n in GIVEN.part.split("/"))
    reports = done(of)
    left = [run for run in every[number - 1 :: parts] if run[0] not in reports]
    if GIVEN.of:
        left = [run for run in left if run[0] in GIVEN.of]
    print(f"{len(every)} configurations, {len(left)} of part {GIVEN.part} to be run", flush=True)
    if GIVEN.plan:
        for label, path, overrides in every:
            load_config(str(path), overrides=overrides)
            print(label)
        return False
    GIVEN.output.parent.mkdir(parents=True, exist_ok=True)
    for label, path, overrides in left:
        report = proven(label, path, overrides, of)
        if report is None:
            print(f"{label}: broken off")
            return True
        reports[label] = report
        with GIVEN.output.open("a", encoding="utf-8") as file:
            file.write(json.dumps(reports[label]) + "\n")
        print(f"{label}: {reports[label]['elapsed']:.0f} s", flush=True)
    result = [reports[label] for label, _, _ in every if label in reports]
    show(result)
    return any(not row["passed"] for row in result)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--part", default="1/1")
    parser.add_argument("--of", nargs="*", choices=[label for label, _, _ in runs()])
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--strength", type=int, default=2, choices=range(4))
    parser.add_argument("--output", type=Path, default=ROOT / "build" / "signature.jsonl")
    parser.add_argument("--plan", action="store_true")
    GIVEN = parser.parse_args()
    sys.exit(main())
