"""Conformance files: RAPID with its expectation in comments.

The head says `! rule:` (what is shown), `! source:` (where that is known from) and, where needed,
`! given: system` (judge it as a whole system), `! robotware: 5.0` and `! at 7: RG207` (for lines
that can hold no comment). `! -> RG307` at the end of a line expects that error on that line, and
`! -> RG217?` that warning, `! -> RG321~` that note; what is not expected must not be found.
"""

import re
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from rapidgen.diagnostics import Diagnostic, Severity
from rapidgen.rapid import Dialect, check, parse
from rapidgen.system import ModuleFile, System, TaskSpec

FOLDER = Path(__file__).parent / "conformance"
_HEAD = re.compile(r"^! (rule|source|given|robotware): (.*)$", re.MULTILINE)
_AT = re.compile(r"^! at (\d+): (.*)$", re.MULTILINE)
_ARROW = re.compile(r"! -> ((?:RG\d{3}[?~]? ?)+)$")


@dataclass(frozen=True, eq=False)
class Conformance:
    """One file, split into what it says about itself and its text."""

    path: Path
    text: str
    head: dict[str, str]
    expected: Counter[tuple[int, str]]

    @property
    def section(self) -> str:
        """Folder below the root: the topic."""
        return self.path.relative_to(FOLDER).parts[0]

    def findings(self) -> list[Diagnostic]:
        """What the checker says."""
        major, minor = map(int, self.head.get("robotware", "6.0").split("."))
        name = self.path.name
        if self.head.get("given") != "system":
            return check(
                parse(self.text, path=name, dialect=Dialect((major, minor))),
                dialect=Dialect((major, minor)),
            )
        file = ModuleFile("Demo", name, self.text.encode("latin-1"))
        return check(System("demo", (TaskSpec("T_ROB1", modules=(file,)),)))

    def found(self) -> Counter[tuple[int, str]]:
        """(line, code) of each finding; a warning's has a `?` behind it, a note's a `~`."""
        marks = {Severity.ERROR: "", Severity.WARNING: "?", Severity.INFO: "~"}
        return Counter(
            (d.span.line if d.span else 0, d.code + marks[d.severity]) for d in self.findings()
        )


def read(path: Path) -> Conformance:
    """Read one file."""
    text = path.read_text("utf-8")
    expected: Counter[tuple[int, str]] = Counter()
    for number, line in enumerate(text.split("\n"), 1):
        arrow = _ARROW.search(line)
        if arrow:
            expected.update((number, code) for code in arrow[1].split())
    for number, codes in _AT.findall(text):
        expected.update((int(number), code) for code in codes.split())
    return Conformance(path, text, dict(_HEAD.findall(text)), expected)


def all_files() -> list[Conformance]:
    """All conformance files in order."""
    return [read(path) for path in sorted(FOLDER.rglob("*.mod"))]
