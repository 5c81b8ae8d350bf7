"""The Makefile's lists are the tree's: campaigns, trials, scripts."""

import re
import subprocess

import pytest

from tests.docs.tree import ROOT

MAKEFILE = (ROOT / "Makefile").read_text(encoding="utf-8")


def campaigns():
    """Lines of `make campaigns`: target, time and what it is."""
    done = subprocess.run(
        ["make", "--silent", "campaigns"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    return done.stdout.splitlines()


def test_every_campaign_has_a_time_and_is_a_target():
    targets = []
    for line in campaigns():
        target, time, what = re.fullmatch(r"([a-z0-9-]+) +(\d+ (?:min|h)) +(\S.+)", line).groups()
        assert re.search(rf"^{target}:.*## {time}: {re.escape(what)}$", MAKEFILE, re.MULTILINE)
        targets.append(target)
    assert {"bench", "motion-campaign", "driver-day", "runtime-mutants"} <= set(targets)


@pytest.mark.parametrize("path", sorted((ROOT / "benchmarks").glob("*.py")), ids=lambda p: p.stem)
def test_every_benchmark_is_run_by_a_target(path):
    benches = re.search(r"^BENCHES := (.+)$", MAKEFILE, re.MULTILINE)[1].split()
    assert path.stem in benches or f"benchmarks/{path.name}" in MAKEFILE


MAIN = '__name__ == "__main__"'
TOOLS = [p for p in sorted((ROOT / "tools").glob("*.py")) if MAIN in p.read_text("utf-8")]


@pytest.mark.parametrize("path", TOOLS, ids=lambda p: p.stem)
def test_every_tool_is_run_by_a_target(path):
    assert re.search(rf"tools[/.]{path.stem}\b", MAKEFILE)


def test_the_trials_of_foreign_programs_are_named():
    named = re.search(r"PROGRAM the trial \((.+?); default", MAKEFILE)[1].split(", ")
    target = {
        path.stem
        for path in (ROOT / "tools" / "interop").glob("*.py")
        if MAIN in path.read_text(encoding="utf-8")
    }
    assert set(named) == target - {"trial"}
