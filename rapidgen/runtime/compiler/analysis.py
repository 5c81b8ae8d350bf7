"""One walk over a routine before it is compiled: what is passed by reference, what is whole."""

from collections.abc import Callable, Sequence

from rapidgen.rapid.binding.arguments import match
from rapidgen.rapid.builtins.signatures import marked
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk
from rapidgen.runtime.compiler.symbols import Routine


class RoutineFacts:
    """What a routine's text says about its own variables."""

    def __init__(
        self, routine: n.RoutineDeclaration, find: Callable[[str], Routine | None]
    ) -> None:
        self.by_reference: set[str] = set()
        """Locals that are arguments of reference parameters, lower case."""
        self.stores: dict[str, list[n.Expression | None]] = {}
        """What is assigned to whole locals; None = something unknown."""
        self.loops: list[n.For] = []
        self.goto: set[str] = set()
        for at in walk(routine):
            self._look(at, find)

    def _look(self, at: n.Node, find: Callable[[str], Routine | None]) -> None:
        match at:
            case n.Assignment(target=n.Name(name=name)):
                self.stores.setdefault(name.lower(), []).append(at.value)
            case n.ProcedureCall() | n.FunctionCall():
                self._call(at, find(at.name))
            case n.LateCall():
                for argument in at.arguments:
                    self._by_reference(argument.value)
            case n.Connect(target=n.Name(name=name)):
                self.by_reference.add(name.lower())
            case n.For():
                self.loops.append(at)
            case n.Goto():
                self.goto.add(at.name.lower())

    def _call(self, at: n.ProcedureCall | n.FunctionCall, routine: Routine | None) -> None:
        key = at.name.lower()
        unboxed = key in marked("inplace") or key in marked("steps")
        if routine is None or (routine.node is None and unboxed):
            self._step(at, key)
            return
        if not routine.refers:
            return
        parameters = routine.parameters

        def by_reference(_argument: n.Argument, among: Sequence[int]) -> int:
            """Any of the alternatives may be meant."""
            return next((i for i in among if parameters[i].mode), among[0])

        for pair in match(parameters, at.arguments, by_reference).pairs:
            if pair.parameter >= 0 and parameters[pair.parameter].mode:
                self._by_reference(pair.argument.value)

    def _step(self, at: n.ProcedureCall | n.FunctionCall, key: str) -> None:
        """Incr and its kin are assignments."""
        if key not in marked("steps") or not at.arguments:
            return
        target = at.arguments[0].value
        if isinstance(target, n.Name):
            value = at.arguments[1].value if key == "add" and len(at.arguments) > 1 else None
            complete = n.NumberLiteral(at.first, at.first, 1, "1")
            self.stores.setdefault(target.name.lower(), []).append(
                value if key == "add" else complete
            )

    def _by_reference(self, node: n.Expression | None) -> None:
        if isinstance(node, n.Name):
            self.by_reference.add(node.name.lower())


class IntegerLocals:
    """Which locals and loop variables hold whole numbers only, and which none below zero.

    Both are the largest sets that agree with every store; `initial` are the candidates with
    their initial values, `constant(name)` gives the value of a num constant, or None.
    """

    def __init__(
        self, initial: dict[str, int], facts: RoutineFacts, constant: Callable[[str], object]
    ) -> None:
        self._constant = constant
        loops: dict[str, list[n.For]] = {}
        for loop in facts.loops:
            loops.setdefault(loop.variable.lower(), []).append(loop)
        names = {name for name in initial if name not in facts.by_reference} | set(loops)
        stores = {name: facts.stores.get(name, []) for name in names}
        self.whole = names
        self._shrink(
            self.whole,
            lambda name: (
                all(map(self._is_whole, stores[name]))
                and all(self._is_whole_loop(loop) for loop in loops.get(name, ()))
            ),
        )
        self.natural = {name for name in self.whole if initial.get(name, 0) >= 0}
        self._shrink(
            self.natural,
            lambda name: (
                all(map(self._is_natural, stores[name]))
                and all(self._is_natural_loop(loop) for loop in loops.get(name, ()))
            ),
        )

    @staticmethod
    def _shrink(names: set[str], holds: Callable[[str], bool]) -> None:
        changed = True
        while changed:
            wrong = [name for name in sorted(names) if not holds(name)]
            names.difference_update(wrong)
            changed = bool(wrong)

    def _is_whole_loop(self, loop: n.For) -> bool:
        return self._is_whole(loop.start) and (loop.step is None or self._is_whole(loop.step))

    def _is_natural_loop(self, loop: n.For) -> bool:
        return loop.step is None and self._is_natural(loop.start) and self._is_natural(loop.end)

    def _is_whole(self, node: n.Expression | None) -> bool:
        match node:
            case n.NumberLiteral():
                return isinstance(node.value, int)
            case n.Name():
                return node.name.lower() in self.whole or isinstance(
                    self._constant(node.name.lower()), int
                )
            case n.Parenthesis():
                return self._is_whole(node.inner)
            case n.Unary():
                return node.operator != "NOT" and self._is_whole(node.operand)
            case n.Binary(operator="DIV" | "MOD"):
                return True
            case n.Binary(operator="+" | "-" | "*"):
                return self._is_whole(node.left) and self._is_whole(node.right)
            case n.FunctionCall():
                return node.name.lower() in marked("whole")
        return False

    def _is_natural(self, node: n.Expression | None) -> bool:
        match node:
            case n.NumberLiteral():
                return isinstance(node.value, int)
            case n.Name():
                value = self._constant(node.name.lower())
                return node.name.lower() in self.natural or (isinstance(value, int) and value >= 0)
            case n.Parenthesis():
                return self._is_natural(node.inner)
            case n.Binary(operator="+" | "*" | "DIV" | "MOD"):
                return self._is_natural(node.left) and self._is_natural(node.right)
            case n.FunctionCall():
                return node.name.lower() in marked("whole")
        return False
