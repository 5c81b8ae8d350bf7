"""Count the seeded faults that a strict check finds.

Draws faults that a controller's program check rejects, each in one conformance program without
errors: misspelt names, values of another type, missing arguments, swapped arguments of different
types and missing ENDs. Lists those that `check --strict` does not report as an error.

    python -m tools.seeded_faults --count 100 --seed 1
"""

import argparse
import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from rapidgen.diagnostics import Severity
from rapidgen.rapid import check, parse
from rapidgen.rapid.binding import ModuleScope, RoutineSymbol, Scope, TaskScope, match
from rapidgen.rapid.binding.expressions import declared_type, type_of
from rapidgen.rapid.binding.names import NUMBER, called, equal
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.lexer import KEYWORDS
from rapidgen.rapid.syntax.walk import walk
from tests.rapid.conformance_files import all_files

_ENDS = frozenset(
    "ENDIF ENDWHILE ENDFOR ENDTEST ENDPROC ENDFUNC ENDTRAP ENDRECORD".split()  # noqa: SIM905
)
_LETTERS = "abcdefghijklmnopqrstuvwxyz"
_TRIES = 10_000


@dataclass(frozen=True, slots=True)
class Fault:
    """A change of a program, from character `start` to `end`."""

    kind: str
    program: str
    text: str
    start: int
    end: int
    replacement: str

    @property
    def changed(self) -> str:
        """The text of the program with the fault."""
        return self.text[: self.start] + self.replacement + self.text[self.end :]

    @property
    def line(self) -> int:
        """Line of the fault."""
        return self.text.count("\n", 0, self.start) + 1


class Draw:
    """Possible faults of one program."""

    def __init__(self, name: str, text: str, chance: random.Random) -> None:
        self.name, self.text, self.chance = name, text, chance
        self.module: ModuleScope = TaskScope().add(parse(text, path=name))
        self.source = self.module.tree.source

    def fault(self, kind: str, first: int, last: int, replacement: str) -> Fault:
        """Create a fault that replaces some tokens."""
        starts, tokens = self.source.starts, self.source.tokens
        end = starts[last] + len(tokens[last])
        return Fault(kind, self.name, self.text, starts[first], end, replacement)

    def nodes(self) -> Iterator[tuple[n.Node, Scope]]:
        """Iterate over the nodes of all routines, with their scopes."""
        for routine in self.module.tree.routines:
            scope = self.module.routine(routine)
            for node in walk(routine):
                yield node, scope

    def calls(self) -> Iterator[tuple[n.ProcedureCall | n.FunctionCall, Scope, list[n.Parameter]]]:
        """Iterate over calls of known routines, with the parameter of each argument."""
        for node, scope in self.nodes():
            if not isinstance(node, n.ProcedureCall | n.FunctionCall):
                continue
            symbol = called(scope.find(node.name))
            if not isinstance(symbol, RoutineSymbol) or not symbol.parameters:
                continue
            pairs = match(symbol.parameters, node.arguments, lambda _, ways: ways[0]).pairs
            if all(p.parameter >= 0 and not p.misfits for p in pairs):
                yield node, scope, [symbol.parameters[p.parameter] for p in pairs]

    def names(self) -> Iterator[Fault]:
        """Misspelt names of data, routines and types."""
        for node, _ in self.nodes():
            if isinstance(node, n.Name | n.ProcedureCall | n.FunctionCall):
                token = node.first
            elif isinstance(node, n.DataDeclaration):
                token = node.name_token - 1
            else:
                continue
            name = self.source.tokens[token]
            slip = _slip(name, self.chance)
            if slip and self._is_free(slip):
                yield self.fault("misspelt name", token, token, slip)

    def _is_free(self, name: str) -> bool:
        """Return True if nothing in the program or in RAPID has a name."""
        key = name.lower()
        known = {token.lower() for token in self.source.tokens}
        options = (signatures.option_names(of) for of in ("procedures", "functions", "types"))
        return (
            key not in known
            and name.upper() not in KEYWORDS
            and self.module.find(name) is None
            and not any(key in names for names in options)
        )

    def types(self) -> Iterator[Fault]:
        """Literals of another type, where the place has one."""
        for node, scope in self.nodes():
            if isinstance(node, n.Assignment) and declared_type(node.target, scope):
                yield from self._other(node.value)
        for node, _, parameters in self.calls():
            for argument, parameter in zip(node.arguments, parameters, strict=True):
                if parameter.type.lower() != "anytype" and argument.value is not None:
                    yield from self._other(argument.value)

    def _other(self, value: n.Expression) -> Iterator[Fault]:
        if isinstance(value, n.NumberLiteral | n.BoolLiteral):
            yield self.fault("wrong type", value.first, value.last, '"text"')
        elif isinstance(value, n.StringLiteral):
            yield self.fault("wrong type", value.first, value.last, "5")

    def missing(self) -> Iterator[Fault]:
        """Calls without one of their required arguments."""
        for node, _, _ in self.calls():
            required = [k for k, a in enumerate(node.arguments) if a.kind == "required"]
            for k in required:
                if k + 1 == len(node.arguments) or node.arguments[k + 1].kind == "required":
                    argument = node.arguments[k]
                    first, last = argument.first, argument.last
                    if self.source.tokens[last + 1] == ",":
                        last += 1
                    elif self.source.tokens[first - 1] == ",":
                        first -= 1
                    yield self.fault("missing argument", first, last, " ")

    def swapped(self) -> Iterator[Fault]:
        """Neighbouring required arguments of different types, swapped."""
        for node, scope, parameters in self.calls():
            for k, (one, two) in enumerate(zip(node.arguments, node.arguments[1:], strict=False)):
                types = parameters[k].type.lower(), parameters[k + 1].type.lower()
                if (one.kind, two.kind) != ("required", "required") or "anytype" in types:
                    continue
                if one.value is None or two.value is None:
                    continue
                kinds = type_of(one.value, scope), type_of(two.value, scope)
                if None in kinds or (NUMBER in kinds and "num" in kinds):
                    continue
                if not equal(kinds[0] or "", kinds[1] or ""):
                    starts, tokens = self.source.starts, self.source.tokens
                    texts = [
                        self.text[starts[a.first] : starts[a.last] + len(tokens[a.last])]
                        for a in (one, two)
                    ]
                    yield self.fault(
                        "swapped arguments", one.first, two.last, f"{texts[1]}, {texts[0]}"
                    )

    def ends(self) -> Iterator[Fault]:
        """Missing ENDs of blocks and routines."""
        for k, token in enumerate(self.source.tokens):
            if token.upper() in _ENDS:
                yield self.fault("missing END", k, k, "")


_KINDS: tuple[Callable[[Draw], Iterator[Fault]], ...] = (
    Draw.names,
    Draw.types,
    Draw.missing,
    Draw.swapped,
    Draw.ends,
)


def _slip(name: str, chance: random.Random) -> str:
    """Return a name with one slip: a letter too few, too many, swapped or wrong."""
    if len(name) < 3 or not name.isidentifier():
        return ""
    k = chance.randrange(1, len(name) - 1)
    return chance.choice(
        (
            name[:k] + name[k + 1 :],
            name[:k] + name[k] + name[k:],
            name[: k - 1] + name[k] + name[k - 1] + name[k + 1 :],
            name[:k] + chance.choice(_LETTERS) + name[k + 1 :],
        )
    )


def is_found(text: str) -> bool:
    """Return True if a strict check reports an error."""
    return any(d.severity is Severity.ERROR for d in check(text, strict=True))


def draw(count: int, seed: int) -> list[Fault]:
    """Draw faults: as many of each kind, each kind in any program that has it."""
    chance = random.Random(seed)
    texts = [(file.name, file.text) for file in all_files()]
    clean: dict[str, bool] = {}
    result: list[Fault] = []
    for _ in range(_TRIES):
        if len(result) == count:
            break
        name, text = chance.choice(texts)
        if name not in clean:
            clean[name] = not is_found(text)
        if not clean[name]:
            continue
        faults = list(_KINDS[len(result) % len(_KINDS)](Draw(name, text, chance)))
        if faults:
            result.append(chance.choice(faults))
    return result


def main() -> None:
    """Draw faults and print those that are not found."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--count", type=int, default=100)
    arguments.add_argument("--seed", type=int, default=1)
    given = arguments.parse_args()
    faults = draw(given.count, given.seed)
    left = [fault for fault in faults if not is_found(fault.changed)]
    for fault in left:
        line = fault.changed.splitlines()[fault.line - 1].strip()
        print(f"not found: {fault.kind}: {fault.program}:{fault.line}: {line}")
    print(f"{len(faults) - len(left)} of {len(faults)} faults found")


if __name__ == "__main__":
    main()
