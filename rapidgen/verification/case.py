"""A case of the suite: its name and the function that checks it."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, TypeAlias

from rapidgen.verification.model import NotApplicable
from rapidgen.verification.testbench import Bench

Proving: TypeAlias = Callable[[Bench], None]
Part: TypeAlias = Literal["control", "stream", "feedback", "events", "egm"]
"""Parts that a driver may lack, by its profile or without a control port."""


@dataclass(frozen=True, slots=True)
class SuiteCase:
    """One behaviour of the driver: a case of the suite.

    `answers` names the fault of the upstream driver, if any.

    `once`: the case is slow and runs under the default setting alone.
    """

    name: str
    title: str
    group: str
    prove: Proving
    answers: str = ""
    once: bool = False


class SuiteGroup:
    """The cases of one file in text order; a decorator adds them.

    A case does not apply if the driver lacks the part that it `needs`. During commissioning, cases
    about `background` tasks that outlive the program do not apply either.
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
        """Register a function as the case of that name and return it unchanged."""

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
        elif part == "egm":
            if bench.group.egm is None:
                raise NotApplicable("the configuration has no `egm:`")
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
