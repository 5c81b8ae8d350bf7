"""Statements: control flow, stores, guards of the ERROR clause."""

from collections.abc import Sequence

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.base import CALLS, SHARED, SILENT, E
from rapidgen.runtime.compiler.calls import Place
from rapidgen.runtime.compiler.structure import Structure
from rapidgen.runtime.compiler.symbols import Data
from rapidgen.runtime.values import NUM, STRING, Type


class Statements(Structure):
    """Compiles statements into the writer."""

    def _if(
        self,
        branches: Sequence[tuple[n.Expression, Sequence[n.Statement]]],
        otherwise: Sequence[n.Statement] | None,
    ) -> None:
        """IF: see loops.py, also for the next three."""
        raise NotImplementedError

    def _for(self, node: n.For) -> None:
        raise NotImplementedError

    def _while(self, node: n.While) -> None:
        raise NotImplementedError

    def _test(self, node: n.Test) -> None:
        raise NotImplementedError

    # -- one statement ---------------------------------------------------------------------------

    def statement(self, node: n.Statement) -> None:
        """Compile one statement."""
        w = self.w
        w.token = node.first
        if self.options.tracing and not isinstance(node, n.Label):
            w.close()
            w.emit(f"R.b = b; TRACE(R, {self.program.trace_point(self.routine, node)}); b = R.b")
        if self.too_deep(node):
            self.set_apart(node)
            return
        self.one(node)

    def one(self, node: n.Statement) -> None:
        """Compile a statement where it stands."""
        w = self.w
        match node:
            case n.Assignment():
                self._assignment(node)
            case n.ProcedureCall():
                self._procedure(node)
            case n.If():
                self._if([(b.condition, b.body) for b in node.branches], node.otherwise)
            case n.CompactIf():
                self._if([(node.condition, [node.statement])], None)
            case n.For():
                self._for(node)
            case n.While():
                self._while(node)
            case n.Test():
                self._test(node)
            case n.Return():
                self._return(node)
            case n.Goto():
                self.goto_label(node)
            case n.Raise():
                self._raise(node)
            case n.Retry() | n.TryNext():
                self._recover(node)
            case n.Exit():
                self.pay(E("", NUM, effect=CALLS))
                w.emit("R.b = b")
                w.emit("R.exit()")
                w.close()
            case n.Connect():
                self._connect(node)
            case n.LateCall():
                self._late(node)
            case n.PlaceholderStatement():
                self.simple(E("FAIL('ERR_EXECPHR')", NUM, fails=True, effect=SHARED), [])
            case n.Label():
                pass

    def pay(self, e: E, *, extra: int = 0) -> None:
        """Charge a statement whose expressions cost what `e` says."""
        options = self.options
        self.w.cost(options.statement + e.ops * options.operator + e.cost + extra)

    def simple(self, e: E, lines: list[str], *, skip: str = "") -> None:
        """Pay, guard and emit the Python of a simple statement.

        `lines` default to the expression itself. `skip` is what TRYNEXT does instead.
        """
        self.pay(e)
        self.guard(e, lines or [e.code], skip=skip)
        if e.effect != SILENT:
            self.w.close()

    def guard(self, e: E, lines: list[str], *, skip: str = "") -> None:
        """Emit lines; inside a routine with ERROR, in a try that calls its handler."""
        w = self.w
        calls = e.effect == CALLS
        if calls:
            w.emit("R.b = b")
        if not (self.guarded and e.fails):
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
        w.emit(f"if _k == 2: return {'2' if len(self.apart) > 1 else 'R.ret'}")
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
            w.emit("b = R.recharge(b, @REST@)")
        w.depth -= 1
        if calls:
            w.emit("else: b = R.b")

    def _indented(self, lines: list[str], synced: bool) -> None:
        w = self.w
        w.depth += 1
        w.synced = synced
        for line in lines:
            w.emit(line)
        w.synced = False
        w.depth -= 1

    # -- stores ----------------------------------------------------------------------------------

    def target(self, node: n.Expression) -> Place:
        """A datum that may be assigned."""
        if isinstance(node, n.Placeholder):
            self.fault("a placeholder is no datum", node)
        place = self.place(node)
        if place is None:
            if isinstance(node, n.Name) and self.data(node.name) is None:
                self.fault(f"{node.name} is not declared", node)
            self.fault("only variables, persistents and parameters can be assigned", node)
        if place.data.kind == "CONST" or place.data.readonly:
            self.fault(f"{place.data.name} cannot be changed", node)
        return place

    def _assignment(self, node: n.Assignment) -> None:
        if isinstance(node.target, n.Placeholder):
            self.simple(E("FAIL('ERR_EXECPHR')", NUM, fails=True, effect=SHARED), [])
            return
        place = self.target(node.target)
        if not place.e.type.is_value:
            self.fault(f"{place.e.type.name} cannot be assigned", node)
        value = self.value_of(node.value, place.e.type, place.e.dims)
        self.store(place, value)

    def store(self, place: Place, value: E) -> None:
        """Assign a compiled value to a place and wake who watches it."""
        kind, data = place.e.type, place.data
        total = E("", kind).take(place.e, value)
        if place.holder or data.storage not in ("local", "global"):
            total.effect = max(total.effect, SHARED if data.storage != "box" else SILENT)
        if not place.holder and not place.e.dims and not place.cell:
            # Writing is no access in the cost model; reading the target was not either.
            total.fails = value.fails or place.data.optional
        total.fails = total.fails or value.risky or bool(place.e.dims)
        lines = self._store_lines(place, value)
        if place.cell and self.options.switching:
            total.effect = CALLS
            lines.append(f"R.touch({place.cell})")
        self.pay(total)
        self.guard(total, lines)
        self._wake(place)
        if total.effect != SILENT:
            self.w.close()

    def _wake(self, place: Place) -> None:
        if not place.cell:
            return
        w = self.w
        if place.data.storage == "cell":
            w.emit(f"if {place.cell}.w:")
        else:
            w.emit(f"_c = {place.cell}")
            w.emit("if _c is not None and _c.w:")
        cell = place.cell if place.data.storage == "cell" else "_c"
        w.depth += 1
        w.emit("R.b = b")
        w.emit(f"{cell}.notify()")
        w.emit("b = R.b")
        w.depth -= 1

    def _store_lines(self, place: Place, value: E) -> list[str]:
        data, kind = place.data, place.e.type
        if data.storage == "global":
            self.globals_written.add(data.code)
        if place.e.dims:
            return self._array_lines(place, value)
        if kind.kind == "record":
            if data.storage == "local" and not place.holder:
                self.stored.add(data.code)
                return [f"{data.code} = {self.by_value(value, kind)}"]
            return [f"{place.e.code}.assign({value.code})"]
        if not place.holder:
            if data.storage in ("local", "global"):
                self.stored.add(data.code)
                return self.store_lines(data.code, value, kind, keep=True)
            return self._through("_x", f"{self._kept(data)}.v", value, kind)
        if place.member:
            return self._through("_x", f"{place.holder}.{place.key}", value, kind)
        lines = []
        key = place.key
        if not (key.isidentifier() or key.isdigit()):
            lines.append(f"_i = {key}")
            key = "_i"
        if not self._inside(place):
            lines.append(f"{place.holder}[{key}]")  # outside: KeyError
        return lines + self._through("_x", f"{place.holder}[{key}]", value, kind)

    def _kept(self, data: Data) -> str:
        return f"PRESENT({data.code})" if data.optional else data.code

    def _through(self, temporary: str, target: str, value: E, kind: Type) -> list[str]:
        """Store by way of a temporary when the value has to be tested."""
        lines = self.store_lines(temporary, value, kind)
        if len(lines) == 1:
            return [target + lines[0].removeprefix(temporary)]
        return [*lines, f"{target} = {temporary}"]

    def _inside(self, place: Place) -> bool:
        """Whether the last index is known to lie in the array."""
        limits = place.index_range
        dims = place.data.dims
        return limits is not None and bool(dims) and limits[0] >= 1 and limits[1] <= dims[-1]

    def _array_lines(self, place: Place, value: E) -> list[str]:
        data = place.data
        known = 0 not in place.e.dims and place.e.dims == value.dims
        if data.storage == "local" and known:
            self.stored.add(data.code)
            return [f"{data.code} = {self.by_value(value, place.e.type)}"]
        return [f"ASSIGN({place.e.code}, {value.code})"]

    # -- calls -----------------------------------------------------------------------------------

    def _procedure(self, node: n.ProcedureCall) -> None:
        routine = self.known_routine(node.name)
        key = node.name.lower()
        if routine is None or routine.kind != "PROC":
            self.program.said_missing(node.name)
            unknown = f"FAIL('ERR_REFUNKPRC', {node.name!r})"
            self.simple(E(unknown, NUM, fails=True, effect=SHARED), [])
            return
        if routine.node is None and key in ("incr", "decr", "add", "clear"):
            self._step(key, node)
            return
        e = self.call(routine, node)
        self.simple(e, [])

    def _step(self, key: str, node: n.ProcedureCall) -> None:
        """Incr, Decr, Add and Clear are assignments."""
        arguments = [a.value for a in node.arguments if a.value is not None]
        if not arguments:
            self.fault(f"{node.name} takes an argument", node)
        place = self.target(arguments[0])
        kind = place.e.type
        if kind.kind not in ("num", "dnum") or place.e.dims:
            self.fault(f"{node.name} takes num or dnum, not {kind.name}", node)
        if key == "clear":
            value = E("0", kind, whole=True, exact=True, range=(0, 0))
        else:
            by = (
                self.value_of(arguments[1], kind)
                if key == "add" and len(arguments) > 1
                else E("1", kind, whole=True, exact=True, range=(1, 1), literal=True)
            )
            sign = "-" if key == "decr" else "+"
            current = place.e
            value = E(
                f"({current.code} {sign} {by.code})",
                kind,
                whole=current.whole and by.whole,
                risky=not (by.literal or (current.whole and by.whole)),
            ).take(current, by)
        value.cost += self.options.call
        self.store(place, value)

    def _late(self, node: n.LateCall) -> None:
        """`%name% arguments;` [K §4.5]: arguments are thunks, by value and by reference."""
        name = self.value_of(node.procedure, STRING)
        parts, codes = [name], []
        for argument in node.arguments:
            code, part = self._late_argument(argument)
            codes.append(code)
            parts += part
        module = self.program.module_code(self.module)
        inside = "".join(c + ", " for c in codes)
        e = E(
            f"R.late({name.code}, {module}, ({inside}))",
            NUM,
            cost=self.options.call,
        ).take(*parts)
        e.effect, e.fails = CALLS, True
        self.simple(e, [])

    def _late_argument(self, argument: n.Argument) -> tuple[str, list[E]]:
        name = repr(argument.name.lower() if argument.name else None)
        if argument.kind == "switch":
            return f"LATE({name}, None, None)", []
        node = argument.value
        assert node is not None
        if argument.kind == "conditional" and isinstance(node, n.Name):
            data = self.locals.get(node.name.lower())
            if data is None or not data.optional:
                self.fault("a conditional argument names an optional parameter", argument)
            value = f"{data.code}.v" if data.storage in ("box", "ref") else data.code
            code = f"LATE({name}, lambda: {value}, lambda: {data.code})"
            return f"(None if {data.code} is None else {code})", []
        place = self.place(node)
        if place is None:
            e = self.expression(node)
            t = self.program.type_code(e.type)
            return f"LATE({name}, lambda: {self.by_value(e, e.type)}, None, {t})", [e]
        t = self.program.type_code(place.e.type)
        read = self.read_place(place)
        ref = self.late_reference(place)
        return f"LATE({name}, lambda: {read}, {ref}, {t}, lambda: {place.e.code})", [place.e]

    def read_place(self, place: Place) -> str:
        """By-value code of a place."""
        return self.by_value(place.e, place.e.type)

    def late_reference(self, place: Place) -> str:
        """A lambda that makes a Ref to a place, or None for what cannot be one."""
        data, e = place.data, place.e
        if data.kind == "CONST" or data.readonly or e.type.kind in ("nonvalue", "semivalue"):
            return "None"
        if not place.holder and data.storage in ("box", "cell", "ref"):
            return f"lambda: {data.code}"
        if not place.holder and data.storage == "global":
            return f"lambda: {self.program.global_ref(data)}"
        t, cell = self.program.type_code(e.type), place.cell or "None"
        if place.holder and place.atomic:
            maker = "MEMBER" if place.member else "ITEM"
            key = repr(place.key) if place.member else place.key
            return f"lambda: {maker}({place.holder}, {key}, {t}, {data.name!r}, {cell})"
        return f"lambda: PART({e.code}, {t}, {data.name!r}, {cell}, {e.dims!r})"

    def _connect(self, node: n.Connect) -> None:
        target = self.target(node.target)
        trap = self.program.find_routine(self.module, node.trap.lower())
        if trap is None or trap.kind != "TRAP":
            self.simple(
                E(f"FAIL('ERR_REFUNKTRP', {node.trap!r})", NUM, fails=True, effect=SHARED), []
            )
            return
        if target.e.type.kind != "num" or target.e.dims:
            self.fault("CONNECT takes an intnum", node)
        e = E(f"R.connect({target.e.code}, {self.program.trap_code(trap)})", NUM, exact=True)
        e.take(target.e)
        e.effect, e.fails = CALLS, True
        lines = self._through("_x", target.e.code, e, NUM)
        if target.data.storage == "global":
            self.globals_written.add(target.data.code)
        if target.data.storage == "local" and not target.holder:
            self.stored.add(target.data.code)
        self.simple(e, lines)

    # -- leaving ---------------------------------------------------------------------------------

    def _return(self, node: n.Return) -> None:
        w = self.w
        kind = self.routine.type
        if self.handler == "UNDO":
            self.fault("RETURN may not stand in UNDO", node)
        if kind is not None:
            if node.value is None:
                self.fault("RETURN of a function needs a value", node)
            e = self.value_of(node.value, kind)
            apart = bool(self.handler) or len(self.apart) > 1
            target = "R.ret" if apart else "_r"
            lines = [f"{target} = {self.by_value(e, kind)}"]
            e.fails = e.fails or e.risky
            if not apart and not (self.guarded and e.fails):
                self.pay(e)
                w.emit("R.b = b")
                w.synced = e.effect == CALLS
                w.emit(f"return {self.by_value(e, kind)}")
                w.synced = False
                w.close()
                return
            self.pay(e)
            self.guard(e, lines)
            w.emit("R.b = b")
            w.emit("return 2" if apart else "return _r")
        else:
            if node.value is not None:
                self.fault("RETURN takes a value only in a function", node)
            self.pay(E("", NUM))
            w.emit("R.b = b")
            w.emit("return 2" if self.handler or len(self.apart) > 1 else "return")
        w.close()

    def _raise(self, node: n.Raise) -> None:
        w = self.w
        if node.number is None:
            if self.handler != "ERROR":
                self.fault("RAISE without a number stands only in an error handler", node)
            self.pay(E("", NUM))
            w.emit("R.b = b")
            w.emit("return 3")
            w.close()
            return
        if self.handler == "ERROR":
            number = self.value_of(node.number, NUM)
            e = E(f"R.instead({number.code})", NUM).take(number)
            e.effect, e.fails = CALLS, True
            self.simple(e, [])
            w.emit("return 3")
            w.close()
            return
        if self.handler:
            self.fault("RAISE with a number may not stand in a handler", node)
        number = self.value_of(node.number, NUM)
        e = E(f"R.throw({number.code})", NUM).take(number)
        e.effect, e.fails = CALLS, True
        self.simple(e, [])

    def _recover(self, node: n.Retry | n.TryNext) -> None:
        if self.handler != "ERROR":
            self.fault("RETRY and TRYNEXT stand only in an error handler", node)
        self.pay(E("", NUM))
        self.w.emit("R.b = b")
        self.w.emit("return 0" if isinstance(node, n.Retry) else "return 1")
        self.w.close()
