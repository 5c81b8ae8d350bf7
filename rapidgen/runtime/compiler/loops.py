"""IF, TEST, FOR and WHILE."""

from collections.abc import Sequence

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.base import CALLS, SILENT, E
from rapidgen.runtime.compiler.statements import Statements
from rapidgen.runtime.compiler.structure import LOOP
from rapidgen.runtime.compiler.symbols import Data
from rapidgen.runtime.values import BOOL, NUM


class Loops(Statements):
    """Compiles compound statements. Their conditions are the statement for RETRY and TRYNEXT:
    an error in a condition makes TRYNEXT skip the whole of it [K §7.2]."""

    resumed: set[int]
    """Tokens of FORs that go on behind the value that their variable has."""

    # -- branches --------------------------------------------------------------------------------

    def _if(
        self,
        branches: Sequence[tuple[n.Expression, Sequence[n.Statement]]],
        otherwise: Sequence[n.Statement] | None,
    ) -> None:
        conditions = [self.condition(c) for c, _ in branches]
        self._select([c.code for c in conditions], conditions, [b for _, b in branches], otherwise)

    def _test(self, node: n.Test) -> None:
        subject = self.expression(node.subject)
        name = self.temporary()
        codes, parts = [], []
        for case in node.cases:
            values = [
                self.value_of(v, subject.type, subject.dims, "CASE value") for v in case.values
            ]
            codes.append(" or ".join(f"{name} == {v.code}" for v in values))
            part = E("", BOOL, ops=len(values)).take(*values)
            parts.append(part)
        if not node.cases:
            self.simple(subject, [f"{name} = {subject.code}"])
            for statement in node.default or ():
                self.statement(statement)
            return
        codes[0] = codes[0].replace(name, f"({name} := {subject.code})", 1)
        parts[0].take(subject)
        self._select(codes, parts, [c.body for c in node.cases], node.default)

    def _select(
        self,
        codes: list[str],
        conditions: list[E],
        bodies: list[Sequence[n.Statement]],
        otherwise: Sequence[n.Statement] | None,
    ) -> None:
        """Run the first body whose condition holds.

        The statement pays for its first condition; each branch for those looked at after it.
        """
        w = self.w
        everything = E("", BOOL).take(*conditions)
        first = conditions[0]
        self.pay(E("", BOOL, ops=first.ops, cost=first.cost))
        later = [c.ops * self.options.operator + c.cost for c in conditions]
        chosen = ""
        if everything.effect == CALLS or (self.guarded and everything.fails):
            chosen = self.temporary()
            chain = " else ".join(f"{i} if {c}" for i, c in enumerate(codes, start=1))
            self.guard(everything, [f"{chosen} = {chain} else 0"], skip=f"{chosen} = -1")
        w.close()
        for i, (code, body) in enumerate(zip(codes, bodies, strict=True), start=1):
            word = "if" if i == 1 else "elif"
            w.emit(f"{word} {f'{chosen} == {i}' if chosen else code}:")
            self._branch(body, sum(later[1:i]))
        rest = sum(later[1:])
        if otherwise is not None or rest:
            w.emit(f"elif {chosen} == 0:" if chosen else "else:")
            self._branch(otherwise or (), rest)

    def _branch(self, body: Sequence[n.Statement], looked: int) -> None:
        w = self.w
        if looked and self.options.accounting != "none":
            w.depth += 1
            w.cost(looked)
            if self.options.accounting == "statement":
                w.close()
            w.depth -= 1
        self.block_of(body)

    # -- loops -----------------------------------------------------------------------------------

    def _while(self, node: n.While) -> None:
        w = self.w
        condition = self.condition(node.condition)
        token = node.first
        if condition.effect == SILENT and not condition.fails:
            self._silent_while(node, condition)
            return
        simple = condition.effect != CALLS and not (self.guarded and condition.fails)
        self.pay(condition)
        if simple:
            w.close()
            w.emit(f"while {condition.code}:")
            w.depth += 1
        else:
            name = self.temporary()
            w.close()
            w.emit("while True:")
            w.depth += 1
            # Paid before the loop and at the end of each pass.
            self.guard(condition, [f"{name} = {condition.code}"], skip=f"{name} = False")
            w.emit(f"if not {name}: break")
        self._body(node.body, lambda: self._next_pass(condition, token))

    def _silent_while(self, node: n.While, condition: E) -> None:
        """A condition that nothing outside can see is paid after it was looked at: together
        with what begins the pass, or with what follows the loop."""
        w = self.w
        w.close()
        w.emit(f"while {condition.code}:")
        w.depth += 1
        self.pay(condition)
        self._body(node.body, None)
        w.token = node.first
        self.pay(condition)

    def _next_pass(self, condition: E, token: int) -> None:
        self.w.token = token
        self.pay(condition)

    def _for(self, node: n.For) -> None:
        w = self.w
        start = self.value_of(node.start, NUM, (), "start")
        end = self.value_of(node.end, NUM, (), "end")
        step = self.value_of(node.step, NUM, (), "step") if node.step is not None else None
        parts = [start, end] + ([step] if step else [])
        total = E("", NUM).take(*parts)
        name = loop_variable(node)
        limits = _limits(start, end, step)
        rising = start.range and end.range and start.range[1] <= end.range[0]
        if rising and start.whole and end.whole and step is None:
            code = f"range({start.code}, {end.code} + 1)"
        else:
            codes = [self.rounded(p, NUM) for p in parts] + ([] if step else ["None"])
            code = f"STEPS({', '.join(codes)})"
        if total.effect == CALLS or (self.guarded and total.fails):
            values = self.temporary()
            self.pay(total)
            self.guard(total, [f"{values} = {code}"], skip=f"{values} = ()")
            code = values
        else:
            self.pay(total)
        w.close()
        if node.first in self.resumed:
            self.resumed.remove(node.first)
            code = f"AFTER({code}, {name})"
        w.emit(f"for {name} in {code}:")
        w.depth += 1
        whole = start.whole and (step is None or step.whole)
        hidden = self.bind_loop(node, name, whole=whole, limits=limits)
        w.token = node.first
        w.cost(self.options.statement)
        if self.options.accounting == "statement":
            w.close()
        self._body(node.body, None)
        self.unbind_loop(node, hidden)

    def bind_loop(
        self, node: n.For, code: str, *, whole: bool, limits: tuple[int, int] | None
    ) -> Data | None:
        """Let the variable of a FOR stand for a Python local; what it hides."""
        key = node.variable.lower()
        hidden = self.locals.get(key)
        self.locals[key] = Data(
            node.variable, "LOOP", NUM, (), "local", code, whole=whole, range=limits, readonly=True
        )
        return hidden

    def unbind_loop(self, node: n.For, hidden: Data | None) -> None:
        """Undo `bind_loop`."""
        if hidden is None:
            del self.locals[node.variable.lower()]
        else:
            self.locals[node.variable.lower()] = hidden

    def _body(self, body: Sequence[n.Statement], finish: object) -> None:
        """The statements of a loop (already indented), and the jumps that leave it."""
        w = self.w
        outer, self.jumps_out = self.jumps_out, 0
        self.nesting.append((LOOP, set()))
        mark = len(w.lines)
        self.statements(body)
        if callable(finish):
            finish()
        w.close()
        if not any(line.text or line.charge for line in w.lines[mark:]):
            w.emit("pass")
        self.nesting.pop()
        w.depth -= 1
        self.after_loop(outer)


def loop_variable(node: n.For) -> str:
    """The Python local of a FOR, the same wherever its routine is compiled."""
    return f"l{node.first}_{node.variable.lower()}"


def _limits(start: E, end: E, step: E | None) -> tuple[int, int] | None:
    """Range of a loop variable."""
    if start.range is None or end.range is None or not (start.whole and end.whole):
        return None
    if step is not None and not step.whole:
        return None
    return min(start.range[0], end.range[0]), max(start.range[1], end.range[1])
