"""How property tests draw, when garbage is collected, and what the tests of each folder cost.

Property tests draw the same examples in every run; RAPIDGEN_PROPERTIES=campaign draws anew.
"""

import gc
import os
import re
import resource
import signal
import sys
import time
from collections import Counter
from fnmatch import translate
from importlib.machinery import PathFinder
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

# Nothing here judges time (a busy machine is no defect), and no failure of an earlier run is tried
# first: a run depends on the tree alone.
_SETTINGS = settings(
    deadline=None,
    database=None,
    suppress_health_check=[
        HealthCheck.too_slow,
        HealthCheck.data_too_large,
        HealthCheck.filter_too_much,
        HealthCheck.large_base_example,
        HealthCheck.function_scoped_fixture,
    ],
)
settings.register_profile("gate", _SETTINGS, derandomize=True)
settings.register_profile("campaign", _SETTINGS, derandomize=False, max_examples=1000)
settings.load_profile(os.environ.get("RAPIDGEN_PROPERTIES", "gate"))

# A shell that starts this in the background makes it deaf to Ctrl-C, and whatever it starts, too.
signal.signal(signal.SIGINT, signal.default_int_handler)


class Unchanged:
    """Import the modules of rapidgen as they are.

    pytest rewrites the asserts of all of them, as rapidgen has a plugin of it: seconds in each
    worker, and compiled files that no other process can use.
    """

    @staticmethod
    def find_spec(name, path=None, target=None):
        return PathFinder.find_spec(name, path, target) if name.startswith("rapidgen.") else None


sys.meta_path.insert(0, Unchanged)

LONG_TESTS = Path(__file__).with_name("long_tests.txt")

COLLECTING = "(start, imports, collection)"
HERE = Path(__file__).parent
UNMATCHED = pytest.StashKey[list[str]]()


def long_tests() -> list[str]:
    """Return the lines of long_tests.txt: patterns, of which the last that fits a test counts."""
    lines = [line.strip() for line in LONG_TESTS.read_text("utf-8").splitlines()]
    return [line for line in lines if line and not line.startswith("#")]


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark the tests of long_tests.txt, which `make test` deselects."""
    lines = long_tests()[::-1]
    # Brackets stand for themselves.
    texts = [translate(re.sub(r"[\[\]]", "?", line.removeprefix("!"))) for line in lines]
    patterns = re.compile("|".join(f"({text})" for text in texts))
    files, matched = set(), set()
    for item in items:
        name = item.nodeid.removeprefix("tests/")
        files.add(name.partition("::")[0])
        if match := patterns.match(name):
            line = lines[match.lastindex - 1]
            matched.add(line)
            if not line.startswith("!"):
                item.add_marker("long")
    config.stash[UNMATCHED] = [
        line
        for line in lines
        if line not in matched
        and (file := line.removeprefix("!").partition("::")[0]).endswith(".py")
        and (file in files or not (HERE / file).exists())
        and not any("::" in argument for argument in config.args)
    ]


@pytest.fixture
def unmatched(pytestconfig: pytest.Config) -> list[str]:
    """Lines of long_tests.txt about collected files that fit no test."""
    return pytestconfig.stash[UNMATCHED]


def cpu_seconds() -> float:
    """s of CPU of this process and of those that it has started and seen end."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


class Garbage:
    """The oldest generation is looked through between tests.

    Beside all tests that were collected that takes up to 3 s of a busy machine, in which client
    and controller of a test stand still together, while both have 2 s and 5 s to answer. Within a
    test it is left to those that make a lot of garbage.
    """

    OFTEN, SELDOM = 30, 100
    """Collections of the generation before, about 7,000 objects each: between tests, in one."""

    def __init__(self) -> None:
        young, middle, _ = gc.get_threshold()
        gc.set_threshold(young, middle, self.SELDOM)

    @pytest.hookimpl(trylast=True)
    def pytest_collection_finish(self) -> None:
        # What is there stays to the end: no need to look through it again and again.
        gc.freeze()

    @pytest.hookimpl(wrapper=True, trylast=True)
    def pytest_runtest_protocol(self):
        done = yield
        if gc.get_count()[2] >= self.OFTEN:
            gc.collect()
        return done


class Cost:
    """CPU time by folder below tests/, and by `--durations N` of the N tests that take most.

    A worker of xdist reports its own at its end.
    """

    def __init__(self) -> None:
        self.seconds: Counter[str] = Counter()
        self.tests: Counter[str] = Counter()
        self.each: Counter[str] = Counter()

    @pytest.hookimpl(trylast=True)
    def pytest_collection_finish(self) -> None:
        self.seconds[COLLECTING] += cpu_seconds()

    @pytest.hookimpl(wrapper=True, tryfirst=True)
    def pytest_runtest_protocol(self, item):
        began = cpu_seconds()
        try:
            return (yield)
        finally:
            folder, spent = folder_of(item.path), cpu_seconds() - began
            self.seconds[folder] += spent
            self.tests[folder] += 1
            self.each[item.nodeid] += spent

    def pytest_sessionfinish(self, session) -> None:
        if hasattr(session.config, "workeroutput"):
            session.config.workeroutput["cost"] = [
                dict(text) for text in (self.seconds, self.tests, self.each)
            ]

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node) -> None:
        for mine, text in zip(
            (self.seconds, self.tests, self.each),
            getattr(node, "workeroutput", {}).get("cost", ()),
            strict=False,  # a worker that was killed has reported nothing
        ):
            mine.update(text)

    def pytest_terminal_summary(self, terminalreporter) -> None:
        terminalreporter.section("CPU time by folder")
        for folder, seconds in self.seconds.most_common():
            number = f"{self.tests[folder]:5} tests" if self.tests[folder] else ""
            terminalreporter.write_line(f"{seconds:7.1f} s  {folder:<30}{number}")
        terminalreporter.write_line(f"{self.seconds.total():7.1f} s  together")
        for name, seconds in self.each.most_common(terminalreporter.config.option.durations or 0):
            terminalreporter.write_line(f"{seconds:7.1f} s  {name}")


def folder_of(path: Path) -> str:
    """Return the folder of tests/ that a test file belongs to."""
    inside = path.relative_to(HERE).parts if path.is_relative_to(HERE) else path.parts[-1:]
    return inside[0] if len(inside) > 1 else "tests"


def pytest_configure(config) -> None:
    config.pluginmanager.register(Garbage(), "garbage")
    config.pluginmanager.register(Cost(), "cost")
