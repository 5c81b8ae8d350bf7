"""Hostile YAML: growing, executing or endless input in all kinds of files."""

import pytest

from rapidgen.config import load_config
from rapidgen.config.cell import load_cell
from rapidgen.controller.faults import read_plan
from rapidgen.diagnostics import DiagnosticError
from rapidgen.machine.operator import read_answers

pytestmark = pytest.mark.timeout(60)
"""An input without end fails; docs/develop/performance.md has the time that they take."""
READERS = {"robot": load_config, "cell": load_cell, "plan": read_plan, "answers": read_answers}
SIZE = 210_000
"""Characters of those that are long; the largest that are read have 1,000,000."""
DOUBLED = "".join(f"k{n}: &k{n} [*k{n - 1}, *k{n - 1}]\n" for n in range(1, 60))
FILES = {
    "aliases that double": "k0: &k0 [x, x]\n" + DOUBLED,
    "mappings that double": "k0: &k0 {a: 1}\n"
    + DOUBLED.replace("[", "{a: ").replace(", ", ", b: ").replace("]", "}"),
    "merged aliases": "a: &a {b: 1}\n" + "".join(f"c{n}: {{<<: *a}}\n" for n in range(30_000)),
    "an answer of aliases that double": "- answer:\n  "
    + DOUBLED.replace("\n", "\n  ").replace("*k0", "x"),
    "alias of itself": "a: &a [*a]\n",
    "alias of nothing": "a: *b\n",
    "deep list": "[" * SIZE,
    "deep mapping": "{a: " * (SIZE // 4),
    "deep block": "".join(f"{' ' * n}a:\n" for n in range(1400)),
    "long list": "[" + "a," * (SIZE // 2) + "]",
    "long block": "- a\n" * (SIZE // 4),
    "long mapping": "".join(f"a{n}: 1\n" for n in range(SIZE // 10)),
    "long text": "a: " + "b" * SIZE,
    "long quoted text": 'a: "' + "b" * SIZE + '"',
    "long key": "a" * SIZE + ": 1",
    "escapes": 'a: "' + "\\x41" * (SIZE // 4) + '"',
    "open quote": "a: '" + "b" * SIZE,
    "open lines": "a: '" + "b\n" * (SIZE // 2),
    "folded lines": "a: >\n" + "  b\n\n" * (SIZE // 5),
    "comments": "#\n" * (SIZE // 2),
    "blanks": " " * SIZE + "a",
    "question marks": "? " * (SIZE // 2),
    "dashes": "- " * (SIZE // 2),
    "anchors": "&a " * (SIZE // 3),
    "commas": "{" + "," * SIZE + "}",
    "Python object": "a: !!python/object/apply:os.system ['touch canary']\n",
    "Python name": "!!python/name:os.system\n",
    "own tag": "a: !run x\n",
    "tag of a prefix": "%TAG ! tag:yaml.org,2002:python/object/apply:\n---\na: !os.system [x]\n",
    "binary": "a: !!binary " + "A" * 1000 + "\n",
    "set": "a: !!set {b, c}\n",
    "many documents": "--- a\n" * (SIZE // 6),
    "another version": "%YAML 1.1\n---\non: no\n",
    "many directives": "%A b\n" * (SIZE // 5),
    "large number": "a: " + "9" * SIZE,
    "large exponent": "model: 1e" + "9" * 900 + "\n",
    "sexagesimal number": "a: 1" + ":1" * (SIZE // 2),
    "key that is a list": "? [a, b]\n: c\n",
    "NUL": "a: \0\n",
    "control characters": "a: \x1b[2J\n",
    "lone surrogate": 'a: "\\ud800"\n',
    "no character": 'a: "\\UFFFFFFFF"\n',
    "UTF-16": "a: b\n".encode("utf-16"),
    "no UTF-8": b"a: \xff\xfe\xfa\n",
    "more than the limit": b"#" * 1_000_001,
}


CASES = [
    (kind, name)
    for name, content in FILES.items()
    for kind in READERS
    if kind == "robot" or len(content) < 10_000
]
"""All are read by the same function: the long ones once."""


@pytest.mark.parametrize(("kind", "name"), CASES)
def test_hostile_yaml_is_rejected(tmp_path, monkeypatch, kind, name):
    monkeypatch.chdir(tmp_path)
    path, content = tmp_path / "a.yaml", FILES[name]
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(DiagnosticError) as refused:
        READERS[kind](path)
    assert [one.name for one in tmp_path.iterdir()] == ["a.yaml"]
    for result in refused.value.diagnostics:
        assert result.code.startswith("RG")
        assert len(result.message) < 1000
