"""Conformance programs: RAPID with its expectation in comments.

They are in theme files, each below a line `!=== NAME` (tests/rapid_programs.py). Line numbers count
from the line below that.

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
from tests.rapid_programs import Program, read_all

FOLDER = Path(__file__).parent / "conformance"
_HEAD = re.compile(r"^! (rule|source|given|robotware): (.*)$", re.MULTILINE)
_AT = re.compile(r"^! at (\d+): (.*)$", re.MULTILINE)
_ARROW = re.compile(r"! -> ((?:RG\d{3}[?~]? ?)+)$")


@dataclass(frozen=True, eq=False)
class Conformance:
    """A program and its declared findings."""

    program: Program
    head: dict[str, str]
    expected: Counter[tuple[int, str]]

    @property
    def text(self) -> str:
        """The program with its comments."""
        return self.program.text

    @property
    def name(self) -> str:
        """Theme file below the root, and program."""
        return self.program.below(FOLDER)

    @property
    def section(self) -> str:
        """First part of the name: the topic."""
        return self.name.split("/")[0]

    def findings(self) -> list[Diagnostic]:
        """Findings of the checker."""
        major, minor = map(int, self.head.get("robotware", "6.0").split("."))
        name = f"{self.program.name}.mod"
        if self.head.get("given") != "system":
            return check(
                parse(self.text, path=name, dialect=Dialect((major, minor))),
                dialect=Dialect((major, minor)),
            )
        file = ModuleFile("Demo", name, self.text.encode("latin-1"))
        return check(System("demo", (TaskSpec("T_ROB1", modules=(file,)),)))

    def found(self) -> Counter[tuple[int, str]]:
        """Return (line, code) of each finding.

        The code of a warning ends in `?`, that of a note in `~`.
        """
        marks = {Severity.ERROR: "", Severity.WARNING: "?", Severity.INFO: "~"}
        return Counter(
            (d.span.line if d.span else 0, d.code + marks[d.severity]) for d in self.findings()
        )


def read(program: Program) -> Conformance:
    """Read what a program says about itself."""
    text = program.text
    expected: Counter[tuple[int, str]] = Counter()
    for number, line in enumerate(text.split("\n"), 1):
        arrow = _ARROW.search(line)
        if arrow:
            expected.update((number, code) for code in arrow[1].split())
    for number, codes in _AT.findall(text):
        expected.update((int(number), code) for code in codes.split())
    return Conformance(program, dict(_HEAD.findall(text)), expected)


def all_files() -> list[Conformance]:
    """All conformance programs in order."""
    return [read(program) for program in read_all(FOLDER)]
