"""Python text under construction: lines, costs and error guards.

Costs are paid before the statements of a block run. A block is a sequence of statements that touch
only the routine's data, with at most one other statement at its end. If the budget is too small for
the block, `polls` charges it statement by statement, so that block and statement accounting give
exactly the same times. An error in the middle of a block refunds the statements after it (`refunds`
by line).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk
from rapidgen.runtime.compiler.emit.access import (
    CALLS,
    SILENT,
    CompiledExpression,
    Unit,
    calling,
    failing,
    undeclared,
    unknown_type,
)
from rapidgen.runtime.compiler.symbols import CannotCompile, CodeRole, LabelUnreachable
from rapidgen.runtime.values import NUM

# -- Lines and costs -------------------------------------------------------------------------------
#
# Lines, their RAPID tokens and their costs.


INDENT = " "
_BUDGET_LINES = frozenset({"b = R.b", "R.b = b", "else: b = R.b", "b += @REFUND@"})
"""Lines without effect if there is no accounting."""
_FILLED = frozenset({"b += @REFUND@", "b -= @OWN@", "b = R.charge_again(b, @REST@)"})
"""Lines with a cost that is known when the block is."""


@dataclass(slots=True, eq=False)
class Block:
    """Costs of the statements that are paid together."""

    costs: list[int] = field(default_factory=list)


@dataclass(slots=True, eq=False)
class CodeLine:
    """One line of Python."""

    depth: int
    text: str
    token: int
    """First token of the RAPID statement."""
    block: Block | None = None
    paid: int = 0
    """Costs of the block up to and with this statement's."""
    charge: bool = False
    """This is where the block is paid."""
    synced: bool = False
    """The budget is already written back; the raising function knows the remaining budget."""
    leave: str = ""
    """For a charge: the RETURN of an ERROR (list) that a long jump may enter here."""


@dataclass(frozen=True, slots=True)
class Mark:
    """A position of a writer."""

    lines: int
    depth: int
    leave: str
    block: Block | None
    costs: int


class Writer:
    """A collector of lines."""

    def __init__(self, accounting: str) -> None:
        self.lines: list[CodeLine] = []
        self.depth = 0
        self.token = 0
        self.synced = False
        self.leave = ""
        """RETURN of the routine's ERROR (list); empty: it has none, or this is a handler."""
        self._accounting = accounting
        self._block: Block | None = None

    def emit(self, text: str) -> None:
        """Add one line at the current depth."""
        if self._accounting == "none" and text in _BUDGET_LINES:
            return
        block = self._block
        paid = len(block.costs) if block is not None else 0
        self.lines.append(CodeLine(self.depth, text, self.token, block, paid, False, self.synced))

    def mark(self) -> "Mark":
        """Return the current position, for `back_to`."""
        costs = len(self._block.costs) if self._block is not None else 0
        return Mark(len(self.lines), self.depth, self.leave, self._block, costs)

    def back_to(self, marker: "Mark") -> None:
        """Discard all lines after a position."""
        del self.lines[marker.lines :]
        self.depth, self.leave, self.synced, self._block = (
            marker.depth,
            marker.leave,
            False,
            marker.block,
        )
        if marker.block is not None:
            del marker.block.costs[marker.costs :]

    def cut(self, marker: int) -> list[CodeLine]:
        """Remove and return the lines from a position on."""
        lines = self.lines[marker:]
        del self.lines[marker:]
        return lines

    def cost(self, amount: int) -> None:
        """Charge the next lines to a statement of this cost."""
        if self._accounting == "none":
            return
        if self._block is None or self._accounting == "statement":
            self._block = Block()
            line = CodeLine(self.depth, "", self.token, self._block, charge=True, leave=self.leave)
            self.lines.append(line)
        self._block.costs.append(amount)

    def close(self) -> None:
        """End the block; the next lines are paid separately."""
        self._block = None

    def render(self) -> tuple[str, list[int], dict[int, int], set[int]]:
        """Return Python text, tokens, refunds and synchronised lines.

        Tokens and refunds are by line, from 1.
        """
        text: list[str] = []
        tokens = [0]
        refunds: dict[int, int] = {}
        synced: set[int] = set()

        def add(depth: int, code: str, token: int) -> None:
            text.append(INDENT * depth + code)
            tokens.append(token)

        for line in self.lines:
            block = line.block
            if line.charge and block is not None:
                costs = block.costs
                total = sum(costs)
                poll = f"R.polls(b, {tuple(costs)})" if len(costs) > 1 else "R.poll(b)"
                add(line.depth, f"b -= {total}", line.token)
                if not line.leave:
                    add(line.depth, f"if b < 0: b = {poll}", line.token)
                    continue
                # A trap runs here, and its long jump may end in this routine [K §7.2].
                add(line.depth, "if b < 0:", line.token)
                add(line.depth + 1, f"try: b = {poll}", line.token)
                add(line.depth + 1, "except ERRS as _e:", line.token)
                add(line.depth + 2, "_k = R.handle(_h, _e, None, 0, _l)", line.token)
                add(line.depth + 2, "b = R.b", line.token)
                add(line.depth + 2, f"if _k == 2: {line.leave}", line.token)
                continue
            code = line.text
            remaining = tuple(block.costs[line.paid :]) if block is not None else ()
            refund = sum(remaining)
            if code in _FILLED:
                code = code.replace("@REFUND@", str(refund))
                code = code.replace("@REST@", repr(remaining) if remaining else "()")
                own = block.costs[line.paid - 1] if block is not None and line.paid else 0
                code = code.replace("@OWN@", str(own))
            if code in ("", "b += 0", "b = R.charge_again(b, ())"):
                continue
            add(line.depth, code, line.token)
            if refund:
                refunds[len(tokens) - 1] = refund
            if line.synced:
                synced.add(len(tokens) - 1)
        return "\n".join(text) + "\n", tokens, refunds, synced


# -- Statement lists -------------------------------------------------------------------------------
#
# Statement lists as Python: what they cost, ERROR guards, labels and jumps, functions inside.


LARGEST_NEST = 10
"""Python loops inside each other in one function, which CPython limits to 20 blocks."""
LARGEST_DEPTH = 50
"""Levels of indentation in one function, which CPython limits to 100."""


@dataclass(slots=True, eq=False)
class PythonFunction:
    """A Python function in progress: of a routine, a handler or a part."""

    depth: int
    """Indentation of its statements."""
    handler: CodeRole
    """HANDLER or UNDO inside a handler, ROUTINE in the body."""
    guarded: bool
    """The routine has an ERROR clause, and this is not one of its handlers."""
    outer: "PythonFunction | None" = None
    nesting: list[set[str]] = field(default_factory=list)
    """Python loops around, with the labels that may be jumped to."""
    stored: set[str] = field(default_factory=set)
    """Python locals that are assigned, for `nonlocal`."""
    label_states: dict[str, tuple[str, int]] = field(default_factory=dict)
    jumps_out: int = 0
    """How many Python loops a GOTO inside the loop just compiled leaves."""
    uses_jump: bool = False
    apart: list[CodeLine] = field(default_factory=list)
    """Functions for its statements that are nested too deeply."""

    def state(self) -> tuple[int, dict[str, tuple[str, int]], int, bool, int]:
        """Return the state that a statement changes, for `go_back`."""
        labels = dict(self.label_states)
        return len(self.nesting), labels, self.jumps_out, self.uses_jump, len(self.apart)

    def go_back(self, state: tuple[int, dict[str, tuple[str, int]], int, bool, int]) -> None:
        """Restore the state before a statement that cannot be compiled."""
        nesting, self.label_states, self.jumps_out, self.uses_jump, apart = state
        del self.nesting[nesting:]
        del self.apart[apart:]


CompileStatement: TypeAlias = "Callable[[Emitter, n.Statement], None]"


class Emitter:
    """An emitter for the statements of one routine."""

    def __init__(self, unit: Unit, compile: CompileStatement, goto: set[str]) -> None:
        """Take `statements.compile_statement` and the labels of GOTOs."""
        self.unit = unit
        self.options = unit.options
        self.w = Writer(unit.options.accounting)
        self.function = PythonFunction(1, CodeRole.ROUTINE, unit.node.error is not None)
        self.roles: dict[str, CodeRole] = {}
        self.resumed: set[int] = set()
        """Tokens of FORs that continue after the current value of their variable."""
        self._compile = compile
        self._goto = goto

    # -- one statement ---------------------------------------------------------------------------

    def statement(self, node: n.Statement) -> None:
        """Compile one statement."""
        w = self.w
        w.token = node.first
        if self.options.tracing and not isinstance(node, n.Label):
            point = self.unit.linker.trace_point(self.unit.routine, node)
            w.close()
            w.emit(f"if TRACED[{point}]: R.b = b; R.trace({point}); b = R.b")
        written, names, state = w.mark(), self.unit.names, self.function.state()
        function = self.function
        try:
            if self._too_deep(node):
                self._set_apart(node)
            else:
                self._compile(self, node)
        except LabelUnreachable:
            raise
        except CannotCompile as fault:
            w.back_to(written)
            self.unit.names, self.function = names, function
            function.go_back(state)
            w.token = node.first
            self._refuse(node, fault)

    def _refuse(self, node: n.Statement, fault: CannotCompile) -> None:
        """Emit the fault of an invalid statement, raised when executed."""
        name = undeclared(self.unit, node)
        if name:
            self.simple(failing("ERR_REFUNKDAT", name))
            return
        about = unknown_type(self.unit, node)
        reason = f"nothing declares {about}" if about else str(fault)
        span = self.unit.keep(self.unit.module.span(fault.node))
        self.simple(calling(f"R.refuse({reason!r}, {span})", NUM))

    def pay(self, e: CompiledExpression) -> None:
        """Charge a statement for the expressions `e`."""
        options = self.options
        self.w.cost(options.statement + e.ops * options.operator + e.cost)

    def simple(self, e: CompiledExpression, *lines: str) -> None:
        """Pay for, guard and emit a simple statement, by default `e`."""
        self.pay(e)
        self.guard(e, lines or [e.code])
        if e.effect != SILENT:
            self.w.close()

    def guard(self, e: CompiledExpression, lines: Sequence[str], *, skip: str = "") -> None:
        """Emit lines, in a routine with ERROR within a try.

        The except branch calls the handler. `skip` is the effect of TRYNEXT.
        """
        w = self.w
        calls = e.effect == CALLS
        if calls:
            w.emit("R.b = b")
        if not (self.function.guarded and e.fails):
            w.synced = calls
            for line in lines:
                w.emit(line)
            w.synced = False
            if calls:
                w.emit("b = R.b")
            return
        w.emit("try:")
        self._indented(lines, calls)
        w.emit("except ERRS as _e:")
        w.depth += 1
        if not calls:
            w.emit("b += @REFUND@")  # what the block's later statements were paid
        w.emit("_f, _n = _e, 0")
        w.emit("while True:")
        w.depth += 1
        budget = "None" if calls or self.options.accounting == "none" else "b"
        w.emit(f"_k = R.handle(_h, _f, {budget}, _n, _l)")
        w.emit("b = R.b")
        w.emit(f"if _k == 1: {skip + '; ' if skip else ''}break")
        w.emit(f"if _k == 2: return {'R.ret' if self.function.outer is None else '2'}")
        w.emit("_n += 1")
        if self.options.accounting != "none":
            w.emit("b -= @OWN@")
            w.emit("if b < 0: b = R.poll(b)")
        if calls:
            w.emit("R.b = b")
        w.emit("try:")
        self._indented(lines, calls)
        w.emit("except ERRS as _e2:")
        w.depth += 1
        w.emit("_f = _e2")
        w.emit("continue")
        w.depth -= 1
        if calls:
            w.emit("b = R.b")
        w.emit("break")
        w.depth -= 1
        w.emit("_f = None")
        if self.options.accounting == "block":
            w.emit("b = R.charge_again(b, @REST@)")
        w.depth -= 1
        if calls:
            w.emit("else: b = R.b")

    def _indented(self, lines: Sequence[str], synced: bool) -> None:
        w = self.w
        w.depth += 1
        w.synced = synced
        for line in lines:
            w.emit(line)
        w.synced = False
        w.depth -= 1

    # -- lists -----------------------------------------------------------------------------------

    def statements(self, body: Sequence[n.Statement]) -> None:
        """Compile a statement list, with GOTO labels as a state machine."""
        labels = [s.name.lower() for s in body if isinstance(s, n.Label)]
        if any(label in self._goto for label in labels):
            self._state_machine(body, labels)
            return
        for statement in body:
            self.statement(statement)

    def block_of(self, body: Sequence[n.Statement]) -> None:
        """Compile an indented statement list that is paid separately."""
        self.w.depth += 1
        self._filled(lambda: self.statements(body))
        self.w.depth -= 1

    def loop_body(
        self, body: Sequence[n.Statement], finish: CompiledExpression | None = None, token: int = 0
    ) -> None:
        """Emit the statements of a loop (already indented), and its exits.

        The statement at `token` pays `finish` at the end of each pass.
        """
        function = self.function
        outer, function.jumps_out = function.jumps_out, 0
        function.nesting.append(set())

        def one_pass() -> None:
            self.statements(body)
            if finish is not None:
                self.w.token = token
                self.pay(finish)

        self._filled(one_pass)
        function.nesting.pop()
        self.w.depth -= 1
        self._after_loop(outer)

    def _filled(self, write: Callable[[], None]) -> None:
        """Emit a block that may be empty."""
        w = self.w
        marker = len(w.lines)
        write()
        w.close()
        if not any(line.text or line.charge for line in w.lines[marker:]):
            w.emit("pass")

    # -- labels and jumps ------------------------------------------------------------------------

    def _state_machine(self, body: Sequence[n.Statement], labels: list[str]) -> None:
        w, function = self.w, self.function
        state = self.unit.temporary()
        numbers = {label: i for i, label in enumerate(labels, start=1)}
        for label, number in numbers.items():
            function.label_states[label] = (state, number)
        w.close()
        w.emit(f"{state} = 0")
        outer, function.jumps_out = function.jumps_out, 0
        w.emit("while True:")
        w.depth += 1
        function.nesting.append(set(labels))
        w.emit(f"if {state} <= 0:")
        w.depth += 1
        w.emit("pass")
        for statement in body:
            if isinstance(statement, n.Label):
                w.close()
                w.depth -= 1
                w.emit(f"if {state} <= {numbers[statement.name.lower()]}:")
                w.depth += 1
                w.emit("pass")
            else:
                self.statement(statement)
        w.close()
        w.depth -= 1
        w.emit("break")
        function.nesting.pop()
        w.depth -= 1
        self._after_loop(outer)

    def _after_loop(self, outer: int) -> None:
        """Emit the continuation after a Python loop: `_j` is set by a GOTO in it."""
        w, function = self.w, self.function
        leaving, function.jumps_out = function.jumps_out, max(outer, function.jumps_out - 1)
        if not leaving:
            return
        w.emit("if _j:")
        w.depth += 1
        if leaving == 1:  # this level has the state machine with the label
            w.emit("_j = False")
            w.emit("continue")
        else:
            w.emit("break")
        w.depth -= 1
        function.uses_jump = True

    def goto(self, node: n.Goto) -> None:
        """Leave Python loops one by one up to the label's state machine."""
        w, function = self.w, self.function
        label = node.name.lower()
        match = function.label_states.get(label)
        loops = len(function.nesting)
        inside = next((i for i in reversed(range(loops)) if label in function.nesting[i]), None)
        if match is None or inside is None:
            raise LabelUnreachable(
                f"there is no label {node.name} that can be reached from here", node
            )
        self.pay(CompiledExpression("", NUM))
        w.close()
        state, number = match
        w.emit(f"{state} = {number}")
        if inside == loops - 1:
            w.emit("continue")
        else:
            w.emit("_j = True")
            w.emit("break")
            function.jumps_out = max(function.jumps_out, loops - 1 - inside)

    # -- functions inside ------------------------------------------------------------------------

    def handler(self, name: str, body: Sequence[n.Statement], role: CodeRole) -> list[CodeLine]:
        """Emit a handler as a nested function that shares the variables."""
        w, node = self.w, self.unit.node
        w.token = body[0].first if body else node.name_token
        inner = PythonFunction(self.function.depth + 1, role, False, self.function)
        lines = self._written(inner, lambda: self.statements(body))
        return self._defined(name, role, inner, lines, node.last)

    def _too_deep(self, node: n.Statement) -> bool:
        """Return True if a statement exceeds Python's nesting limits."""
        function = self.function
        nested, depth = len(function.nesting), self.w.depth - function.depth
        deep = nested >= LARGEST_NEST or depth >= LARGEST_DEPTH
        return deep and isinstance(node, n.For | n.While | n.If | n.Test) and not _leaves(node)

    def _set_apart(self, node: n.Statement) -> None:
        """Compile a statement as a nested function.

        It returns 2 for RETURN; in a handler also 0, 1 and 3 for the other exits.
        """
        w, outer = self.w, self.function
        w.close()
        depth, w.depth = w.depth, outer.depth
        leave, w.leave = w.leave, "return 2" if w.leave else ""
        inner = PythonFunction(outer.depth + 1, outer.handler, outer.guarded, outer)
        lines = self._written(inner, lambda: self._compile(self, node))
        w.leave = leave
        name = f"_a{self.unit.temporary()}"
        w.token = node.first
        outer.apart += self._defined(name, CodeRole.PART, inner, lines, node.first)
        w.depth = depth
        w.emit("R.b = b")
        w.emit(f"_k = {name}()")
        w.emit("b = R.b")
        w.emit("if _k == 2: return R.ret" if outer.outer is None else "if _k != 4: return _k")

    def _written(self, inner: PythonFunction, write: Callable[[], None]) -> list[CodeLine]:
        """Return the lines that `write` emits into a nested function."""
        w, outer = self.w, self.function
        marker = len(w.lines)
        self.function = inner
        w.depth += 1
        write()
        w.close()
        w.depth -= 1
        self.function = outer
        return w.cut(marker)

    def _defined(
        self, name: str, role: CodeRole, inner: PythonFunction, body: list[CodeLine], last: int
    ) -> list[CodeLine]:
        """Emit a function that returns 4 at its end (token `last`)."""
        w = self.w
        marker = len(w.lines)
        self.roles[name] = role
        w.emit(f"def {name}():")
        w.depth += 1
        if names := sorted(inner.stored & {d.code for d in self.unit.locals.values()}):
            w.emit(f"nonlocal {', '.join(names)}")
        if names := sorted(inner.stored & self.unit.globals_written):
            w.emit(f"global {', '.join(names)}")
        w.emit("b = R.b")
        if inner.uses_jump:
            w.emit("_j = False")
        w.lines += [*inner.apart, *body]
        w.token = last
        w.emit("R.b = b")
        w.emit("return 4")
        w.depth -= 1
        self.function.stored |= inner.stored
        return w.cut(marker)


def _leaves(node: n.Statement) -> bool:
    """Return True if a GOTO leaves a statement."""
    parts = list(walk(node))
    own = {part.name.lower() for part in parts if isinstance(part, n.Label)}
    return any(isinstance(part, n.Goto) and part.name.lower() not in own for part in parts)
