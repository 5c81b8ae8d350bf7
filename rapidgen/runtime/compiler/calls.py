"""Calls: matching arguments to parameters, and passing them by value or by reference [K §5.1]."""

from dataclasses import dataclass

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.analysis import walk
from rapidgen.runtime.compiler.base import CALLS, E
from rapidgen.runtime.compiler.expressions import Expressions, same_type
from rapidgen.runtime.compiler.inline import INLINE
from rapidgen.runtime.compiler.symbols import Data, Parameter, Routine
from rapidgen.runtime.registry import COSTS
from rapidgen.runtime.values import NUM, attribute


@dataclass(slots=True)
class Place:
    """A data reference: a whole datum, an element or a component."""

    data: Data
    e: E
    """Reads it, without the test of an optional parameter's presence."""
    holder: str
    """Container of the last element or component; empty for a whole datum."""
    key: str
    """Index code or attribute behind the container."""
    member: bool
    cell: str
    """Code of its cell (may be None at run time), or empty."""
    index_range: tuple[int, int] | None = None
    """Of the last index."""

    @property
    def atomic(self) -> bool:
        """A single num, dnum, bool or string."""
        return not self.e.dims and self.e.type.kind in ("num", "dnum", "bool", "string")


class Calls(Expressions):
    """Compiles calls and references."""

    # -- references ------------------------------------------------------------------------------

    def place(self, node: n.Expression) -> Place | None:
        """The data reference that `node` is; None for any other expression."""
        match node:
            case n.Parenthesis():
                return None
            case n.Name():
                data = self.data(node.name)
                if data is None or data.storage == "inline":
                    return None
                return Place(data, self.read(data), "", "", False, self._cell(data))
            case n.Index():
                base = self.place(node.base)
                if base is None or len(base.e.dims) != len(node.indices):
                    return None
                indices = [self.index_code(i) for i in node.indices]
                holder = base.e.code + "".join(f"[{i.code}]" for i in indices[:-1])
                key = indices[-1].code
                e = E(f"{holder}[{key}]", base.e.type, ops=len(indices), fails=True, exact=True)
                e.take(base.e, *indices)
                limits = indices[-1].range if indices[-1].whole else None
                return Place(base.data, e, holder, key, False, base.cell, limits)
            case n.Member():
                base = self.place(node.base)
                kind = base.e.type.component(node.component.lower()) if base else None
                if base is None or kind is None or base.e.dims:
                    return None
                key = attribute(node.component)
                e = E(f"{base.e.code}.{key}", kind, ops=1, exact=True).take(base.e)
                return Place(base.data, e, base.e.code, key, True, base.cell)
        return None

    def _cell(self, data: Data) -> str:
        if data.storage == "cell":
            return data.code
        if data.storage == "ref" and data.mode in ("PERS", "INOUT"):
            return f"{data.code}.cell"
        return ""

    def reference(self, node: n.Expression, parameter: Parameter, *, builtin: bool) -> E:
        """Pass `node` to a VAR, PERS, INOUT or REF parameter."""
        place = self.place(node)
        mode = parameter.mode
        if place is None:
            if mode in ("REF", ""):
                return self._boxed(node, parameter)
            if isinstance(node, n.Name):
                self.fault(f"{node.name} is not declared ({parameter.type_name})", node)
            self.fault(f"parameter {parameter.name} takes a datum, not an expression", node)
        data, kind = place.data, place.e.type
        if parameter.type is not None:
            if not same_type(kind, parameter.type):
                self.fault(
                    f"parameter {parameter.name} is {parameter.type_name}, not {kind.name}", node
                )
            if len(place.e.dims) != parameter.dims:
                self.fault(f"parameter {parameter.name} has {parameter.dims} dimensions", node)
        self._check_mode(data, mode, node)
        code = self._reference_code(place, parameter, builtin=builtin)
        result = E(code, kind, place.e.dims, effect=place.e.effect, fails=place.e.fails)
        result.ops = place.e.ops
        return result

    def _check_mode(self, data: Data, mode: n.Mode, node: n.Expression) -> None:
        """The table of K §5.1; what only run time knows is left to ASVAR and ASPERS."""
        if mode in ("REF", ""):
            return
        if data.kind == "CONST" or data.readonly:
            self.fault(f"{data.name} cannot be changed", node)
        if mode == "VAR" and (data.kind == "PERS" or data.mode == "PERS"):
            self.fault(f"{data.name} is a persistent: a VAR parameter takes a variable", node)
        is_persistent = data.kind == "PERS" or data.mode in ("PERS", "INOUT")
        if mode == "PERS" and not is_persistent:
            self.fault(f"{data.name} is no persistent", node)

    def _reference_code(self, place: Place, parameter: Parameter, *, builtin: bool) -> str:
        data, e, kind = place.data, place.e, place.e.type
        if kind.kind in ("nonvalue", "semivalue") and not e.dims:
            return e.code
        as_object = not builtin and parameter.mode == "VAR" and not place.atomic
        if as_object:
            return e.code
        t, cell = self.program.type_code(kind), place.cell or "None"
        if place.holder:
            if not place.atomic:
                return f"PART({e.code}, {t}, {data.name!r}, {cell})"
            maker = "MEMBER" if place.member else "ITEM"
            key = repr(place.key) if place.member else place.key
            return f"{maker}({place.holder}, {key}, {t}, {data.name!r}, {cell})"
        if data.storage in ("box", "cell"):
            return data.code
        if data.storage == "ref":
            code = f"PRESENT({data.code})" if data.optional else data.code
            if data.mode == "INOUT" and parameter.mode == "VAR":
                return f"ASVAR({code})"
            if data.mode == "INOUT" and parameter.mode == "PERS":
                return f"ASPERS({code})"
            return code
        if data.storage == "global" and not data.readonly:
            return self.program.global_ref(data)
        return f"BOX({e.code}, {t}, {e.dims!r}, {data.name!r})"

    def _boxed(self, node: n.Expression, parameter: Parameter) -> E:
        """A value for a REF or anytype parameter that is no datum."""
        e = self.expression(node, parameter.type)
        t = self.program.type_code(e.type)
        name = node.name if isinstance(node, n.Name) else ""
        code = f"BOX({self.by_value(e, e.type)}, {t}, {e.dims!r}, {name!r})"
        return E(code, e.type, e.dims).take(e)

    # -- arguments -------------------------------------------------------------------------------

    def match(
        self, routine: Routine, arguments: list[n.Argument], node: n.Node
    ) -> list[n.Argument | None]:
        """Arguments in the order of the parameters; None where a parameter gets none."""
        parameters = routine.parameters
        found: list[n.Argument | None] = [None] * len(parameters)
        required = [i for i, p in enumerate(parameters) if not p.optional]
        at = 0
        for argument in arguments:
            if argument.name is not None:
                index = routine.by_name.get(argument.name.lower())
                if index is None:
                    self.fault(f"{routine.name} has no parameter {argument.name}", node)
                if not parameters[index].optional and index in required:
                    at = required.index(index) + 1
            else:
                if at >= len(required):
                    self.fault(f"too many arguments for {routine.name}", node)
                index = self._alternative(routine, required, at, argument)
                group = parameters[index].group
                at += 1
                while group >= 0 and at < len(required) and parameters[required[at]].group == group:
                    at += 1
            if found[index] is not None and argument.kind != "conditional":
                self.fault(f"{parameters[index].name} is given twice", node)
            found[index] = argument
        for i in required:
            group = parameters[i].group
            given = found[i] is not None or (
                group >= 0
                and any(
                    f is not None and p.group == group
                    for f, p in zip(found, parameters, strict=True)
                )
            )
            if not given:
                self.fault(f"{routine.name} needs {parameters[i].name}", node)
        return found

    def _alternative(
        self, routine: Routine, required: list[int], at: int, argument: n.Argument
    ) -> int:
        """Which of several required alternatives a positional argument means: by its type."""
        first = required[at]
        group = routine.parameters[first].group
        if group < 0 or argument.value is None:
            return first
        for index in required[at:]:
            parameter = routine.parameters[index]
            if parameter.group != group:
                break
            place = self.place(argument.value)
            kind = place.e.type if place else self.expression(argument.value).type
            if parameter.type is None or same_type(kind, parameter.type):
                return index
        return first

    def argument(self, parameter: Parameter, argument: n.Argument, *, builtin: bool) -> E:
        """Compile one argument."""
        if argument.kind == "conditional":
            return self._conditional(parameter, argument, builtin=builtin)
        if parameter.switch:
            return E("True", NUM)
        node = argument.value
        if node is None:
            self.fault(f"{parameter.name} needs a value", argument)
        if parameter.mode or parameter.type is None:
            return self.reference(node, parameter, builtin=builtin)
        e = self.value_of(node, parameter.type, (0,) * parameter.dims, parameter.name)
        code = e.code if builtin and not e.type.is_value else self.by_value(e, parameter.type)
        if builtin and (e.dims or e.type.kind == "record"):
            code = e.code
        return E(code, e.type, e.dims).take(e)

    def _conditional(self, parameter: Parameter, argument: n.Argument, *, builtin: bool) -> E:
        """`\\Opt?par`: passes the caller's optional parameter on, or its absence."""
        node = argument.value
        data = self.locals.get(node.name.lower()) if isinstance(node, n.Name) else None
        if data is None or not data.optional:
            self.fault("a conditional argument names an optional parameter", argument)
        if parameter.switch or data.storage == "ref" or parameter.mode:
            if builtin and parameter.mode and data.storage not in ("ref", "box"):
                t = self.program.type_code(data.type)
                code = f"(None if {data.code} is None else BOX({data.code}, {t}, {data.dims!r}))"
                return E(code, data.type, data.dims)
            if data.storage == "ref" and not parameter.mode:
                return E(f"(None if {data.code} is None else {data.code}.v)", data.type)
            return E(data.code, data.type, data.dims)
        if data.storage == "box":
            return E(f"{data.code}.v", data.type, data.dims)
        copied = bool(data.dims) or data.type.kind == "record"
        return E(f"COPY({data.code})" if copied else data.code, data.type, data.dims)

    # -- calls -----------------------------------------------------------------------------------

    def call(self, routine: Routine, node: n.FunctionCall | n.ProcedureCall) -> E:
        """Compile a call of a known routine; a procedure has type num for want of a better."""
        inline = INLINE.get(routine.name.lower()) if routine.node is None else None
        if inline is not None:
            done = inline(self, node)
            if done is not None:
                return done
        return self.call_without_inline(routine, node)

    def plain_call(self, node: n.FunctionCall | n.ProcedureCall) -> E:
        """The ordinary call of a built-in that is usually code of its own."""
        routine = self.known_routine(node.name)
        assert routine is not None
        return self.call_without_inline(routine, node)

    def call_without_inline(self, routine: Routine, node: n.FunctionCall | n.ProcedureCall) -> E:
        """Compile a call as a Python call."""
        if routine.missing:
            self.program.said_missing(routine.name)
            return E(
                f"R.missing({routine.name!r})",
                routine.type or NUM,
                effect=CALLS,
                fails=True,
                exact=True,
            )
        found = self.match(routine, node.arguments, node)
        if routine.builtin is not None:
            return self._builtin_call(routine, found)
        codes, parts = [], []
        absent = False
        groups: dict[int, list[str]] = {}
        for parameter, argument in zip(routine.parameters, found, strict=True):
            if argument is None:
                absent = True
                continue
            e = self.argument(parameter, argument, builtin=False)
            parts.append(e)
            code = e.code
            if parameter.group >= 0:
                others = groups.setdefault(parameter.group, [])
                if others:  # conditional arguments, of which one may be present [K §3.10]
                    code = f"ONLY_ONE({code}, {', '.join(others)})"
                others.append(e.code)
            prefix = f"v_{parameter.name.lower()}=" if parameter.optional or absent else ""
            codes.append(f"{prefix}{code}")
        result = E(
            f"{routine.code}({', '.join(codes)})",
            routine.type or NUM,
            cost=self.options.call,
            exact=True,
            fresh=True,
        ).take(*parts)
        result.effect, result.fails = CALLS, True
        return result

    def _condition_code(self, node: n.Expression | None, e: E) -> str:
        """WaitUntil looks at its condition again: it gets a function, and what it reads."""
        watched = []
        for part in walk(node) if node is not None else ():
            data = self.data(part.name) if isinstance(part, n.Name) else None
            if data is None:
                continue
            if data.storage == "cell":
                watched.append(data.code)
            elif data.type.kind == "semivalue":
                watched.append(f"{data.code}.signal.changed")
        sets = "".join(f"{code}, " for code in dict.fromkeys(watched))
        cost = e.ops * self.options.operator + e.cost
        return f"CONDITION(lambda: {e.code}, ({sets}), {cost})"

    def _builtin_call(self, routine: Routine, found: list[n.Argument | None]) -> E:
        binding = routine.builtin
        assert binding is not None
        codes, parts = ["R"], []
        for parameter, argument in zip(routine.parameters, found, strict=True):
            if argument is None:
                codes.append("None")
                continue
            e = self.argument(parameter, argument, builtin=True)
            parts.append(e)
            if routine.name == "WaitUntil" and parameter.name == "Cond":
                codes.append(self._condition_code(argument.value, e))
            else:
                codes.append(e.code)
        cost = COSTS[binding.cost]
        if binding.cost != "call":
            cost = int(cost * self.options.builtin_scale)
        kind = routine.type or NUM
        result = E(
            f"{routine.code}({', '.join(codes)})",
            kind,
            cost=cost if binding.cost != "call" else self.options.call,
            fresh=True,
            fails=True,
        ).take(*parts)
        result.fails = True
        if not binding.pure:
            result.effect = CALLS
        return result
