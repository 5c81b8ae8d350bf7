"""pytest plugin: record which tests execute which lines, and test times.

    COVERING=OUTPUT.json COVERED=FOLDER pytest -p tools.covering_tests tests/...

The output is {"tests": [[test, s], ...], "lines": {file: {line: [index of a test, ...]}}}, the
files relative to the working directory. It does not contain lines that tests execute in other
processes, nor lines that are executed only at import.
"""

import json
import os
from collections import Counter
from pathlib import Path

import coverage
import pytest


class Covering:
    """Coverage with each test as its context, over threads and greenlets."""

    def __init__(self, output: Path, folder: Path) -> None:
        self.output = output
        self.seconds: Counter[str] = Counter()
        self.coverage = coverage.Coverage(
            data_file=None,
            config_file=False,
            source=[str(folder)],
            concurrency=["thread", "greenlet"],
            messages=False,
        )
        # pytest's own plugins have imported the package already: this is expected here.
        known = ["module-not-measured", "no-data-collected"]
        self.coverage.set_option("run:disable_warnings", known)
        self.coverage.start()

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item):
        self.coverage.switch_context(item.nodeid)
        try:
            return (yield)
        finally:
            self.coverage.switch_context("")

    def pytest_runtest_logreport(self, report) -> None:
        self.seconds[report.nodeid] += report.duration

    def pytest_sessionfinish(self) -> None:
        self.coverage.stop()
        data = self.coverage.get_data()
        tests = list(self.seconds.items())
        index = {test: i for i, (test, _) in enumerate(tests)}
        lines = {
            os.path.relpath(file): {
                line: sorted(index[test] for test in contexts if test in index)
                for line, contexts in sorted(data.contexts_by_lineno(file).items())
            }
            for file in sorted(data.measured_files())
        }
        result = {"tests": tests, "lines": lines}
        self.output.write_text(json.dumps(result), encoding="utf-8")


def pytest_configure(config) -> None:
    output, folder = Path(os.environ["COVERING"]), Path(os.environ["COVERED"])
    config.pluginmanager.register(Covering(output, folder), "covering")
