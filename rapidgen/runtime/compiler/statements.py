"""Statements: which part writes which; procedure calls, and what leaves a routine."""

from rapidgen.rapid.builtins.signatures import marked
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime import unsupported
from rapidgen.runtime.compiler.assignments import assignment, connect, step
from rapidgen.runtime.compiler.calls import call
from rapidgen.runtime.compiler.code_info import CodeRole
from rapidgen.runtime.compiler.context import CALLS, CompiledExpression, calling, failing
from rapidgen.runtime.compiler.emitter import Emitter
from rapidgen.runtime.compiler.late_binding import late_call
from rapidgen.runtime.compiler.loops import for_loop, if_statement, test_statement, while_loop
from rapidgen.runtime.compiler.symbols import CannotCompile
from rapidgen.runtime.compiler.value_copies import by_value
from rapidgen.runtime.values import NUM


def compile_statement(emitter: Emitter, node: n.Statement) -> None:
    """Compile a statement where it stands."""
    w = emitter.w
    match node:
        case n.Assignment():
            assignment(emitter, node)
        case n.ProcedureCall():
            _procedure(emitter, node)
        case n.If():
            if_statement(emitter, [(b.condition, b.body) for b in node.branches], node.otherwise)
        case n.CompactIf():
            if_statement(emitter, [(node.condition, [node.statement])], None)
        case n.For():
            for_loop(emitter, node)
        case n.While():
            while_loop(emitter, node)
        case n.Test():
            test_statement(emitter, node)
        case n.Return():
            _return(emitter, node)
        case n.Goto():
            emitter.goto(node)
        case n.Raise():
            _raise(emitter, node)
        case n.Retry() | n.TryNext():
            _recover(emitter, node)
        case n.Exit():
            emitter.pay(CompiledExpression("", NUM, effect=CALLS))
            w.emit("R.b = b")
            w.emit("R.exit()")
            w.close()
        case n.Connect():
            connect(emitter, node)
        case n.LateCall():
            late_call(emitter, node)
        case n.PlaceholderStatement():
            emitter.simple(failing("ERR_EXECPHR"))
        case n.Label():
            pass


def _procedure(emitter: Emitter, node: n.ProcedureCall) -> None:
    routine = emitter.unit.routine_named(node.name)
    key = node.name.lower()
    if routine is None or routine.kind != "PROC":
        option = key in unsupported.option_routines()
        missing = calling(f"R.missing({node.name!r})", NUM)
        emitter.simple(missing if option else failing("ERR_REFUNKPRC", node.name))
        return
    if routine.node is None and key in marked("steps"):
        step(emitter, key, node)
        return
    e = call(emitter.unit, routine, node)
    emitter.simple(e)


def _return(emitter: Emitter, node: n.Return) -> None:
    w = emitter.w
    kind = emitter.unit.routine.type
    if emitter.function.handler is CodeRole.UNDO:
        raise CannotCompile("RETURN may not stand in UNDO", node)
    if kind is not None:
        if node.value is None:
            raise CannotCompile("RETURN of a function needs a value", node)
        e = emitter.unit.value_of(node.value, kind)
        apart = emitter.function.outer is not None
        target = "R.ret" if apart else "_r"
        lines = [f"{target} = {by_value(e, kind)}"]
        e.fails = e.fails or e.risky
        if not apart and not (emitter.function.guarded and e.fails):
            emitter.pay(e)
            w.emit("R.b = b")
            w.synced = e.effect == CALLS
            w.emit(f"return {by_value(e, kind)}")
            w.synced = False
            w.close()
            return
        emitter.pay(e)
        emitter.guard(e, lines)
        w.emit("R.b = b")
        w.emit("return 2" if apart else "return _r")
    else:
        if node.value is not None:
            raise CannotCompile("RETURN takes a value only in a function", node)
        emitter.pay(CompiledExpression("", NUM))
        w.emit("R.b = b")
        w.emit("return" if emitter.function.outer is None else "return 2")
    w.close()


def _raise(emitter: Emitter, node: n.Raise) -> None:
    w = emitter.w
    if node.number is None:
        if emitter.function.handler is not CodeRole.HANDLER:
            raise CannotCompile("RAISE without a number stands only in an error handler", node)
        emitter.pay(CompiledExpression("", NUM))
        w.emit("R.b = b")
        w.emit("return 3")
        w.close()
        return
    if emitter.function.handler is CodeRole.HANDLER:
        number = emitter.unit.value_of(node.number, NUM)
        emitter.simple(calling(f"R.instead({number.code})", NUM, number))
        w.emit("return 3")
        w.close()
        return
    if emitter.function.handler.is_handler:
        raise CannotCompile("RAISE with a number may not stand in a handler", node)
    number = emitter.unit.value_of(node.number, NUM)
    emitter.simple(calling(f"R.throw({number.code})", NUM, number))


def _recover(emitter: Emitter, node: n.Retry | n.TryNext) -> None:
    if emitter.function.handler is not CodeRole.HANDLER:
        raise CannotCompile("RETRY and TRYNEXT stand only in an error handler", node)
    emitter.pay(CompiledExpression("", NUM))
    emitter.w.emit("R.b = b")
    emitter.w.emit("return 0" if isinstance(node, n.Retry) else "return 1")
    emitter.w.close()
