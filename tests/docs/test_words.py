"""Names and texts avoid words with a private meaning in this project (docs, code, tests)."""

import re
from itertools import chain
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
# fmt: off
WORDS = [
    "told", "untold", "mend", "mends", "mended", "mending", "hindrance", "hindrances",
    "cabinet", "cabinets", "nobody", "somebody", "anybody", "everybody", "whoever", "whomever",
    "stranger", "strangers", "doorkeeper", "parcel", "parcels", "unasked", "afflict", "spoilt",
    "amiss", "dearest", "unheard", "lent", "likeness", "encounters", "blame", "blames",
    "wishes", "patience", "oneself", "whence", "thereof",
]
# fmt: on
SUFFIXES = {
    ".py",
    ".md",
    ".txt",
    ".toml",
    ".yml",
    ".yaml",
    ".j2",
    ".mod",
    ".sys",
    ".rapid",
    ".ts",
    ".css",
    ".html",
    ".js",
    ".cfg",
    ".pgf",
}
GENERATED = frozenset({"node_modules", "__pycache__", "assets", "changes"})
# Texts on the wire of the driver keep their names.
EVENTS = "text of an event that the driver writes"
CASE = "name of a case of `rapidgen test`"
EXCEPTIONS = {
    "docs/use/test-driver.md": {"told": CASE},
    "rapidgen/verification/suite/config_options.py": {"strangers": CASE},
    "rapidgen/verification/suite/control.py": {"nobody": CASE},
    "rapidgen/verification/suite/instruction_errors.py": {"nobody": CASE},
    "rapidgen/verification/suite/limits.py": {"told": CASE},
    "rapidgen/verification/suite/long_running.py": {"unheard": CASE},
    "tests/docs/test_words.py": dict.fromkeys(WORDS, "this list"),
    "tests/verification/test_suite.py": {
        "told": CASE,
        "strangers": CASE,
    },
    "tests/verification/test_variants.py": {"strangers": CASE},
}
NOT_YET: tuple[str, ...] = ("rapidgen/motion/",)


def _pattern():
    """Match a whole word, also within snake_case and camelCase."""
    lower = "|".join(WORDS)
    upper = "|".join(word.upper() for word in WORDS)
    title = "|".join(word.capitalize() for word in WORDS)
    return re.compile(
        rf"(?<![A-Za-z])(?:{lower})(?![a-z])|(?<![A-Za-z])(?:{upper})(?![A-Za-z])"
        rf"|(?<![A-Z])(?:{title})(?![a-z])"
    )


PATTERN = _pattern()
# Words that contain no other one: most texts have none of them, which is a fast check.
STEMS = [word for word in WORDS if not any(other in word for other in WORDS if other != word)]


def words_of(text):
    """Return the words of the list in a text, in lower case."""
    lower = text.lower()
    if not any(stem in lower for stem in STEMS):
        return set()
    return {match.lower() for match in PATTERN.findall(text)}


def files():
    """Yield all files with names and texts of this project."""
    for name in ("rapidgen", "templates", "docs", "tools", "benchmarks", "tests", ".ci"):
        folder = ROOT / name
        for path in folder.rglob("*"):
            parts = path.relative_to(folder).parts
            is_text = path.suffix in SUFFIXES or (not path.suffix and name == ".ci")
            if is_text and GENERATED.isdisjoint(parts) and path.is_file():
                yield path


def test_words_with_a_private_meaning_are_not_used():
    found = {}
    single = (ROOT / name for name in ("README.md", "CONTRIBUTING.md", "Makefile"))
    for path in chain(single, files()):
        name = path.relative_to(ROOT).as_posix()
        if name.startswith(NOT_YET):
            continue
        words = words_of(path.read_text(encoding="utf-8", errors="replace"))
        words -= EXCEPTIONS.get(name, {}).keys()
        if words:
            found[name] = sorted(words)
    assert not found


def test_every_exception_to_the_words_is_needed():
    for name, words in EXCEPTIONS.items():
        assert words.keys() <= words_of((ROOT / name).read_text(encoding="utf-8")), name


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("It was told so.", {"told"}),
        ("is_told", {"told"}),
        ("toldSo()", {"told"}),
        ("wasTold", {"told"}),
        ("PATIENCE", {"patience"}),
        ("MAX_PATIENCE = 1", {"patience"}),
        ("class Cabinet:", {"cabinet"}),
        ("recommended, amended, silently, talent", set()),
        ("MENDEL retold", set()),
    ],
)
def test_words_in_identifiers_and_prose_are_found(text, words):
    assert words_of(text) == words
