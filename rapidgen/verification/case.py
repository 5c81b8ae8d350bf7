"""A case of the suite: what it is called, and what proves it on a bench."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, TypeAlias

from rapidgen.verification.model import NotApplicable
from rapidgen.verification.testbench import Bench

Proving: TypeAlias = Callable[[Bench], None]
Part: TypeAlias = Literal["control", "stream", "feedback", "events"]
"""What a driver may be built without: by its profile, or without a control port."""


@dataclass(frozen=True, slots=True)
class SuiteCase:
    """One behaviour of the driver: a case of the suite.

    `answers` names what upstream gets wrong here, if anything.

    `once`: it takes too long for every setting, and runs under the default ones alone.
    """

    name: str
    title: str
    group: str
    prove: Proving
    answers: str = ""
    once: bool = False


class SuiteGroup:
    """The cases of one file, in the order of its text: a decorator that says a case's own facts.

    Where the driver lacks what a case `needs`, or all of them, there is nothing to prove; nor is
    there, while it is being commissioned, of tasks in the `background` that outlive the program.
    """

    def __init__(self, group: str, *, needs: Part | None = None) -> None:
        self._group = group
        self._needs = needs
        self.cases: list[SuiteCase] = []

    def __call__(
        self,
        name: str,
        title: str,
        answers: str = "",
        *,
        once: bool = False,
        background: bool = False,
        needs: Part | None = None,
    ) -> Callable[[Proving], Proving]:
        """Make a function the case of that name; it stays what it is."""

        def made(prove: Proving) -> Proving:
            own = _in_the_background(prove) if background else prove
            for part in (needs, self._needs):
                own = own if part is None else _where_there_is(part, own)
            self.cases.append(SuiteCase(name, title, self._group, own, answers, once))
            return prove

        return made


def _where_there_is(part: Part, prove: Proving) -> Proving:
    def proved(bench: Bench) -> None:
        if part == "control":
            if not bench.group.ports.control:
                raise NotApplicable("there is no control port")
        elif bench.config.profile != "full":
            raise NotApplicable(f"the profile is {bench.config.profile}")
        prove(bench)

    return proved


def _in_the_background(prove: Proving) -> Proving:
    def proved(bench: Bench) -> None:
        if bench.config.commissioning:
            raise NotApplicable("while commissioning, background tasks stop with the program")
        prove(bench)

    return proved
