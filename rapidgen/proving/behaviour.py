"""A case of the suite: what it is called, and what proves it on a bench."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, TypeAlias

from rapidgen.proving.bench import Bench

Proving: TypeAlias = Callable[[Bench], None]
Part: TypeAlias = Literal["control", "stream", "feedback", "events"]
"""What a driver may be built without: by its profile, or without a control port."""


@dataclass(frozen=True, slots=True)
class Behaviour:
    """One behaviour of the driver: a case of the suite.

    `answers` names what upstream gets wrong here, if anything.

    `once`: it takes too long for every setting, and runs under the default ones alone.
    `background`: it needs background tasks that go on when the program is stopped, which those of
    a driver that is being commissioned do not.
    """

    name: str
    title: str
    group: str
    prove: Proving
    answers: str = ""
    once: bool = False
    background: bool = False


class Theme:
    """The cases of one file, in the order of its text: a decorator that says a case's own facts.

    Where the driver lacks what a case `needs`, or all of them, there is nothing to prove.
    """

    def __init__(self, group: str, *, needs: Part | None = None) -> None:
        self._group = group
        self._needs = needs
        self.cases: list[Behaviour] = []

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
            own = prove
            for part in (needs, self._needs):
                own = own if part is None else _where_there_is(part, own)
            self.cases.append(Behaviour(name, title, self._group, own, answers, once, background))
            return prove

        return made


def _where_there_is(part: Part, prove: Proving) -> Proving:
    def proved(bench: Bench) -> None:
        full = bench.config.profile == "full"
        if bench.group.ports.control if part == "control" else full:
            prove(bench)

    return proved
