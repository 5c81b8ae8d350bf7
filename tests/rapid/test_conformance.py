"""Conformance programs give exactly their declared findings.

See conformance_files.py.
"""

import pytest

from tests.rapid.conformance_files import all_files
from tests.rapid.uncovered import rules, uncovered

FILES = all_files()


@pytest.mark.parametrize("file", FILES, ids=lambda f: "/".join(f.name.split("/")[-2:]))
def test_conformance_file_gives_declared_findings(file):
    displayed = "\n".join(
        f"{d.span.line if d.span else 0}: {d.code} {d.message}" for d in file.findings()
    )
    assert file.found() == file.expected, f"{file.program}\n{displayed}"


def test_conformance_file_has_rule_and_source():
    assert [f.name for f in FILES if not {"rule", "source"} <= f.head.keys()] == []


def test_every_rule_has_files_and_every_file_a_rule():
    assert len(rules()) > 70
    assert uncovered() == ([], [])


def test_every_rule_names_its_source():
    assert [rule for rule, source, _ in rules() if not source.startswith("[")] == []
