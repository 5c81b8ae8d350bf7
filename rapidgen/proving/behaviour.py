"""A case of the suite: what it is called, and what proves it on a bench."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, TypeAlias

from rapidgen.proving.bench import Bench

Proving: TypeAlias = Callable[[Bench], None]


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

    With `port="control"`, for all or for one, there is nothing to prove where the configuration has
    no such port.
    """

    def __init__(self, group: str, *, port: Literal["", "control"] = "") -> None:
        self._group = group
        self._port = port
        self.cases: list[Behaviour] = []

    def __call__(
        self,
        name: str,
        title: str,
        answers: str = "",
        *,
        once: bool = False,
        background: bool = False,
        port: Literal["", "control"] = "",
    ) -> Callable[[Proving], Proving]:
        """Make a function the case of that name; it stays what it is."""

        def made(prove: Proving) -> Proving:
            own = self._where_there_is_a_port(prove) if port or self._port else prove
            self.cases.append(Behaviour(name, title, self._group, own, answers, once, background))
            return prove

        return made

    @staticmethod
    def _where_there_is_a_port(prove: Proving) -> Proving:
        def proved(bench: Bench) -> None:
            if bench.group.ports.control:
                prove(bench)

        return proved
