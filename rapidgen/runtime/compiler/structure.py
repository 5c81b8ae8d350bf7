"""Statement lists: labels and jumps, and what is nested deeper than Python takes."""

from collections.abc import Sequence

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.analysis import walk
from rapidgen.runtime.compiler.base import E
from rapidgen.runtime.compiler.calls import Calls
from rapidgen.runtime.compiler.compiled import Role
from rapidgen.runtime.compiler.writer import Line, Writer
from rapidgen.runtime.values import NUM

LOOP, STATE = "loop", "state"
LARGEST_NEST = 10
"""Python loops inside each other in one function, which CPython limits to 20 blocks."""
LARGEST_DEPTH = 50
"""Levels of indentation in one function, which CPython limits to 100."""


class Structure(Calls):
    """Compiles statement lists."""

    w: Writer
    guarded: bool
    """The routine has an ERROR clause, and this is not one of its handlers."""
    handler: str
    """`ERROR`, `UNDO`, or empty in the body."""
    nesting: list[tuple[str, set[str]]]
    """Python loops around: ("loop", no labels) or ("state", labels that may be jumped to)."""
    stored: set[str]
    """Python locals that are assigned, for `nonlocal`."""
    goto: set[str]
    """Labels that a GOTO of this routine names."""
    label_states: dict[str, tuple[str, int]]
    roles: dict[str, Role]
    jumps_out: int
    """How many Python loops a GOTO inside the loop just compiled leaves."""
    uses_jump: bool
    apart: list[list[Line]]
    """Functions for statements that are nested too deeply, of each Python function around."""
    depth_at: int
    """Indentation of the Python function's own statements."""

    def statement(self, node: n.Statement) -> None:
        """Compile one statement."""
        raise NotImplementedError

    def one(self, node: n.Statement) -> None:
        """Compile a statement where it stands."""
        raise NotImplementedError

    def pay(self, e: E, *, extra: int = 0) -> None:
        """Charge a statement whose expressions cost what `e` says."""
        raise NotImplementedError

    # -- lists -----------------------------------------------------------------------------------

    def statements(self, body: Sequence[n.Statement]) -> None:
        """Compile a statement list, as a state machine when GOTO enters its labels."""
        labels = [s.name.lower() for s in body if isinstance(s, n.Label)]
        if any(label in self.goto for label in labels):
            self._state_machine(body)
            return
        for statement in body:
            self.statement(statement)

    def block_of(self, body: Sequence[n.Statement]) -> None:
        """Compile an indented statement list that is paid on its own."""
        w = self.w
        w.depth += 1
        mark = len(w.lines)
        self.statements(body)
        w.close()
        if not any(line.text or line.charge for line in w.lines[mark:]):
            w.emit("pass")
        w.depth -= 1

    def _state_machine(self, body: Sequence[n.Statement]) -> None:
        w = self.w
        labels = {s.name.lower() for s in body if isinstance(s, n.Label)}
        state = self.temporary()
        numbers: dict[str, int] = {}
        for statement in body:
            if isinstance(statement, n.Label):
                numbers[statement.name.lower()] = len(numbers) + 1
        for label, number in numbers.items():
            self.label_states[label] = (state, number)
        w.close()
        w.emit(f"{state} = 0")
        outer, self.jumps_out = self.jumps_out, 0
        w.emit("while True:")
        w.depth += 1
        self.nesting.append((STATE, labels))
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
        self.nesting.pop()
        w.depth -= 1
        self.after_loop(outer)

    def after_loop(self, outer: int) -> None:
        """Behind a Python loop: `_j` was set by a GOTO inside that has further to go."""
        w = self.w
        leaving, self.jumps_out = self.jumps_out, max(outer, self.jumps_out - 1)
        if not leaving:
            return
        w.emit("if _j:")
        w.depth += 1
        if leaving == 1:  # here is the state machine that has the label
            w.emit("_j = False")
            w.emit("continue")
        else:
            w.emit("break")
        w.depth -= 1
        self.uses_jump = True

    def goto_label(self, node: n.Goto) -> None:
        """Leave Python loops one by one up to the state machine that has the label."""
        w = self.w
        label = node.name.lower()
        found = self.label_states.get(label)
        inside = next(
            (i for i in range(len(self.nesting) - 1, -1, -1) if label in self.nesting[i][1]), None
        )
        if found is None or inside is None:
            self.fault(f"there is no label {node.name} that can be reached from here", node)
        self.pay(E("", NUM))
        w.close()
        state, number = found
        w.emit(f"{state} = {number}")
        if inside == len(self.nesting) - 1:
            w.emit("continue")
        else:
            w.emit("_j = True")
            w.emit("break")
            self.jumps_out = max(self.jumps_out, len(self.nesting) - 1 - inside)

    # -- nesting beyond what Python takes --------------------------------------------------------

    def too_deep(self, node: n.Statement) -> bool:
        """Whether a statement has to become a function of its own."""
        deep = len(self.nesting) >= LARGEST_NEST or self.w.depth - self.depth_at >= LARGEST_DEPTH
        return deep and isinstance(node, n.For | n.While | n.If | n.Test) and not _leaves(node)

    def set_apart(self, node: n.Statement) -> None:
        """Compile a statement as a function of its own inside the one around.

        It returns 2 when RETURN was executed, in a handler also 0, 1 and 3 for the other ways out.
        """
        w = self.w
        w.close()
        mark = len(w.lines)
        kept = self.nesting, self.label_states, self.stored, self.uses_jump, self.jumps_out
        self.nesting, self.label_states, self.stored, self.uses_jump = [], {}, set(), False
        depth, w.depth = w.depth, len(self.apart) + 1
        base, self.depth_at = self.depth_at, w.depth
        self.apart.append([])
        leave, w.leave = w.leave, "return 2" if w.leave else ""
        self.one(node)
        w.close()
        w.leave = leave
        body = w.lines[mark:]
        del w.lines[mark:]
        inner = self.apart.pop()
        name = f"_a{self.temporary()}"
        w.depth -= 1
        w.token = node.first
        w.emit(f"def {name}():")
        self.roles[name] = Role.PART
        w.depth += 1
        own = {d.code for d in self.locals.values()}
        if names := sorted(self.stored & own):
            w.emit(f"nonlocal {', '.join(names)}")
        if names := sorted(self.globals_written & self.stored):
            w.emit(f"global {', '.join(names)}")
        w.emit("b = R.b")
        if self.uses_jump:
            w.emit("_j = False")
        w.lines += [*inner, *body]
        w.emit("R.b = b")
        w.emit("return 4")
        self.apart[-1] += w.lines[mark:]
        del w.lines[mark:]
        w.depth, self.depth_at = depth, base
        stored = self.stored
        self.nesting, self.label_states, self.stored, self.uses_jump, self.jumps_out = kept
        self.stored |= stored
        w.emit("R.b = b")
        w.emit(f"_k = {name}()")
        w.emit("b = R.b")
        if self.handler or len(self.apart) > 1:
            w.emit("if _k != 4: return _k")
        else:
            w.emit("if _k == 2: return R.ret")


def _leaves(node: n.Statement) -> bool:
    """Whether a GOTO leaves a statement."""
    parts = list(walk(node))
    own = {part.name.lower() for part in parts if isinstance(part, n.Label)}
    return any(isinstance(part, n.Goto) and part.name.lower() not in own for part in parts)
