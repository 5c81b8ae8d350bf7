"""One walk over a routine before it is compiled: what is passed by reference, what is whole."""

from collections.abc import Callable, Iterator

from rapidgen.rapid import nodes as n
from rapidgen.virtual.compiler.symbols import Routine

WHOLE_FUNCTIONS = frozenset({"strlen", "dim"})


def children(node: n.Node) -> Iterator[n.Node]:
    """Direct parts of a node."""
    for name in _slots(type(node)):
        value = getattr(node, name)
        if isinstance(value, n.Node):
            yield value
        elif value.__class__ is list:
            for item in value:
                if isinstance(item, n.Node):
                    yield item


_SLOTS: dict[type, tuple[str, ...]] = {}


def _slots(kind: type) -> tuple[str, ...]:
    found = _SLOTS.get(kind)
    if found is None:
        names: list[str] = []
        for base in kind.__mro__:
            names += [s for s in getattr(base, "__slots__", ()) if s not in ("first", "last")]
        found = _SLOTS[kind] = tuple(names)
    return found


def walk(node: n.Node) -> Iterator[n.Node]:
    """A node and everything below it."""
    stack = [node]
    while stack:
        at = stack.pop()
        yield at
        stack.extend(children(at))


class Facts:
    """What a routine's text says about its own variables."""

    def __init__(
        self,
        routine: n.RoutineDeclaration,
        find: Callable[[str], Routine | None],
        never_boxes: frozenset[str],
    ) -> None:
        self.by_reference: set[str] = set()
        """Locals that are arguments of reference parameters, lower case."""
        self.stores: dict[str, list[n.Expression | None]] = {}
        """What is assigned to whole locals; None = something unknown."""
        self.loops: list[n.For] = []
        self.goto: set[str] = set()
        self.assigned_in_handlers: set[str] = set()
        for at in walk(routine):
            self._look(at, find, never_boxes)

    def _look(
        self, at: n.Node, find: Callable[[str], Routine | None], never_boxes: frozenset[str]
    ) -> None:
        match at:
            case n.Assignment(target=n.Name(name=name)):
                self.stores.setdefault(name.lower(), []).append(at.value)
            case n.ProcedureCall() | n.FunctionCall():
                self._call(at, find(at.name), never_boxes)
            case n.LateCall():
                for argument in at.arguments:
                    self._by_reference(argument.value)
            case n.Connect(target=n.Name(name=name)):
                self.by_reference.add(name.lower())
            case n.For():
                self.loops.append(at)
            case n.Goto():
                self.goto.add(at.name.lower())

    def _call(
        self,
        at: n.ProcedureCall | n.FunctionCall,
        routine: Routine | None,
        never_boxes: frozenset[str],
    ) -> None:
        key = at.name.lower()
        if routine is None or (routine.node is None and key in never_boxes):
            self._step(at, key)
            return
        required = [p for p in routine.parameters if not p.optional]
        at_required = 0
        for argument in at.arguments:
            index = routine.by_name.get(argument.name.lower()) if argument.name else None
            if index is not None:
                parameter = routine.parameters[index]
            elif argument.name is None and at_required < len(required):
                parameter = required[at_required]
                at_required += 1
                while (
                    parameter.group >= 0
                    and at_required < len(required)
                    and required[at_required].group == parameter.group
                ):
                    # Alternatives of one position: any of them may be meant.
                    if required[at_required].mode:
                        parameter = required[at_required]
                    at_required += 1
            else:
                continue
            if parameter.mode:
                self._by_reference(argument.value)

    def _step(self, at: n.ProcedureCall | n.FunctionCall, key: str) -> None:
        """Incr and its kin are assignments."""
        if key not in ("incr", "decr", "add", "clear") or not at.arguments:
            return
        target = at.arguments[0].value
        if isinstance(target, n.Name):
            value = at.arguments[1].value if key == "add" and len(at.arguments) > 1 else None
            whole = n.NumberLiteral(at.first, at.first, 1, "1")
            self.stores.setdefault(target.name.lower(), []).append(value if key == "add" else whole)

    def _by_reference(self, node: n.Expression | None) -> None:
        if isinstance(node, n.Name):
            self.by_reference.add(node.name.lower())


def whole_locals(
    candidates: set[str],
    facts: Facts,
    constant: Callable[[str], object],
) -> set[str]:
    """Those of `candidates` (and loop variables) that only ever hold whole numbers.

    `constant(name)` gives the value of a num constant, or None.
    """
    loop_names = {loop.variable.lower() for loop in facts.loops}
    whole = {c for c in candidates if c not in facts.by_reference} | loop_names

    def is_whole(node: n.Expression | None) -> bool:
        match node:
            case n.NumberLiteral():
                return isinstance(node.value, int)
            case n.Name():
                key = node.name.lower()
                return key in whole or isinstance(constant(key), int)
            case n.Parenthesis():
                return is_whole(node.inner)
            case n.Unary():
                return is_whole(node.operand)
            case n.Binary():
                if node.operator in ("DIV", "MOD"):
                    return True
                return node.operator in ("+", "-", "*") and (
                    is_whole(node.left) and is_whole(node.right)
                )
            case n.FunctionCall():
                return node.name.lower() in WHOLE_FUNCTIONS
        return False

    changed = True
    while changed:
        changed = False
        for name in sorted(whole):
            values = facts.stores.get(name, [])
            loops = [loop for loop in facts.loops if loop.variable.lower() == name]
            parts: list[n.Expression | None] = list(values)
            for loop in loops:
                parts.append(loop.start)
                if loop.step is not None:
                    parts.append(loop.step)
            if not all(is_whole(p) for p in parts):
                whole.discard(name)
                changed = True
    return whole
