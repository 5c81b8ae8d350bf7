"""One RAPID task: the process that runs its routines, and what compiled code and built-ins ask
of it. Errors are in recovery.py, starting and stopping in running.py."""

from collections.abc import Callable, Iterable
from typing import Any

from rapidgen.machine.scheduler import Scheduler, WaitSet
from rapidgen.runtime import unsupported
from rapidgen.runtime.compiler.linking import LoadedModule
from rapidgen.runtime.compiler.program import Program
from rapidgen.runtime.compiler.runtime import LateArgument
from rapidgen.runtime.compiler.symbols import FormalParameter, Routine
from rapidgen.runtime.errors import RECOVERABLE, EndOfRun, FatalError, RapidError
from rapidgen.runtime.registry import COSTS
from rapidgen.runtime.task.interrupts import Interrupts
from rapidgen.runtime.task.process_errors import ProcessError
from rapidgen.runtime.task.recovery import Recovery

_NS = 1_000_000_000


class Task(Recovery):
    """A task while it runs. `controller` is the whole virtual controller."""

    def __init__(self, scheduler: Scheduler, name: str, controller: Any) -> None:  # noqa: ANN401
        super().__init__(scheduler, name, controller)
        self.interrupts = Interrupts(self)
        self.program: Program
        self.held = False
        """Stopped by Stop, an emergency stop, the operator: goes on when it is released."""
        self.in_trap = False
        self.event = ""
        """Event whose routine is being executed."""
        self.while_stopped = False
        """Executing what a stop or the power-up brought, while the program stands."""
        self.intno = 0
        self.trap_data: Any = None
        self.statements = 0
        self._order: BaseException | None = None
        self._holds = 0
        self.waiting_for: Callable[[], bool] | None = None

    @property
    def stepping(self) -> bool:
        """Whether a step is being executed."""
        return False

    # -- waiting ---------------------------------------------------------------------------------

    def sleep(self, seconds: float) -> None:
        """Let simulated time pass; traps are served meanwhile."""
        self.wait_for(_never, timeout=seconds)

    def wait_for(
        self,
        predicate: Callable[[], bool],
        *,
        on: Iterable[WaitSet] = (),
        timeout: float | None = None,
    ) -> bool:
        """Wait until `predicate()`, looked at now and whenever a member of `on` changes.

        False when `timeout` seconds passed first. Traps are served meanwhile. After a program
        stop the time counts from its beginning again [S4 overview 5-23].
        """
        if predicate():
            return True
        scheduler = self.scheduler
        expired = False

        def expire() -> None:
            nonlocal expired
            expired = True
            self.wake()

        delay = None if timeout is None else round(timeout * _NS)
        timer = None if delay is None else scheduler.after(delay, expire)
        watched = tuple(on)
        for wait_set in watched:
            wait_set.add(self.wake)
        holds = self._holds
        self.waiting_for = predicate
        try:
            while True:
                self.block()
                if holds != self._holds:
                    holds, expired = self._holds, False
                    if timer is not None and delay is not None:
                        timer.cancel()
                        timer = scheduler.after(delay, expire)
                if predicate():
                    return True
                if expired:
                    return False
        finally:
            self.waiting_for = None
            if timer is not None:
                timer.cancel()
            for wait_set in watched:
                wait_set.remove(self.wake)

    # -- attention: stops, orders, traps ---------------------------------------------------------

    def attend(self) -> None:
        """What may come between two statements and inside a wait."""
        if self._order is not None:
            self._obey()
        while self.held:
            self._park()
        if self.interrupts.queue and not self.in_trap and not self.event:
            self._serve_traps()
        if self.interrupts.process_error is not None:
            self.raise_process_error(self.interrupts.process_error)

    def raise_process_error(self, error: ProcessError) -> None:
        """Raise an error of ProcerrRecovery here, or look again at the next statement."""
        if self.in_trap or self.event:
            return
        due = error.due(self)
        if due is None:
            self.kick()
            return
        self.interrupts.process_error = None
        raise due

    def _obey(self) -> None:
        order, self._order = self._order, None
        if order is not None:
            raise order

    def _park(self) -> None:
        self._blocked = True
        self.scheduler.suspend(self)
        if self._order is not None:
            self._obey()

    def order(self, order: BaseException) -> None:
        """Leave what is being executed by raising `order` in it."""
        self._order = order
        self.kick()

    def hold(self) -> None:
        """Stop before the next statement, or in the wait."""
        self.held = True
        self._holds += 1
        self.kick()

    def release(self) -> None:
        """Go on."""
        self.held = False
        self.wake()

    def stop_here(self) -> None:
        """Stop the program from inside it, and return when it is started again."""
        self.held = True
        self._holds += 1
        self.attend()

    def _serve_traps(self) -> None:
        interrupts = self.interrupts
        while interrupts.waiting:
            interrupt, data = interrupts.queue.popleft()
            self.in_trap = True
            self.intno = interrupt.number
            self.trap_data = data
            try:
                self.at_level(self.program.function(interrupt.trap))
            finally:
                self.in_trap = False
                self.trap_data = None

    def at_level(self, routine: Callable[..., Any]) -> None:
        """Execute a routine at trap or user level: only a long jump leaves it [K §7.2]."""
        try:
            routine()
        except RECOVERABLE as error:
            if isinstance(error, RapidError) and error.target is not None:
                raise
            raise self.unhandled(error) from error

    @property
    def stands(self) -> bool:
        """Whether the program is stopped, even if something runs because of that."""
        return self.held or self.while_stopped

    # -- called by compiled code -----------------------------------------------------------------

    def touch(self, value: Any) -> Any:  # noqa: ANN401 - what was read
        """A PERS was read or written: other tasks may come next (schedule `pers`)."""
        if self.scheduler.tosses():
            self.switch()
        return value

    def polls(self, b: int, costs: tuple[int, ...]) -> int:
        """A block was paid and the budget did not last: pay statement by statement."""
        b += sum(costs)
        for cost in costs:
            b -= cost
            if b < 0:
                b = self.poll(b)
        return b

    def recharge(self, b: int, costs: tuple[int, ...]) -> int:
        """Pay again what was given back when a statement of the block failed."""
        for cost in costs:
            b -= cost
            if b < 0:
                b = self.poll(b)
        return b

    def exit(self) -> None:
        """EXIT [K §4.9]."""
        raise EndOfRun

    def connect(self, current: float, trap: Routine) -> int:
        """CONNECT."""
        return self.interrupts.connect(current, trap)

    def missing(self, name: str) -> None:
        """A routine that controllers have and this one has not."""
        raise FatalError(
            40001, f"{name} is not available on the virtual controller", unsupported.reason(name)
        )

    def late(self, name: str, module: LoadedModule | None, arguments: tuple[Any, ...]) -> None:
        """`%name% arguments;` [K §4.5]."""
        routine = self._late_routine(name, module)
        given = [a for a in arguments if a is not None]
        if routine.node is not None:
            positional, named = self._late_arguments(routine, given)
            self.program.function(routine)(*positional, **named)
            return
        binding = routine.builtin
        if binding is None:
            self.missing(routine.name)
            return
        positional, named = self._late_arguments(routine, given)
        values = [*positional]
        for parameter in routine.parameters[len(positional) :]:
            values.append(named.get(f"v_{parameter.name.lower()}"))
        self.charge(COSTS[binding.cost])
        binding.function(self, *values)

    def _late_routine(self, name: str, module: LoadedModule | None) -> Routine:
        program = self.program
        where, colon, proper = name.rpartition(":")
        if not proper or not proper.replace("_", "").isalnum() or proper[0].isdigit():
            raise RapidError("ERR_CALLPROC", name)
        key = proper.lower()
        if colon and where:
            inside = program.modules.get(where.lower())
            found = inside.routines.get(key) if inside is not None else None
        elif colon:
            found = program.routine(program.names.globals.get(key))
        else:
            found = program.find_routine(module, key)
        if found is None:
            known = program.find_data(module, key) is not None
            raise RapidError("ERR_CALLPROC" if known else "ERR_REFUNKPRC", name)
        if not isinstance(found, Routine) or found.kind != "PROC":
            raise RapidError("ERR_CALLPROC", name)
        return found

    def _late_arguments(
        self, routine: Routine, given: list[LateArgument]
    ) -> tuple[list[Any], dict[str, Any]]:
        positional: list[Any] = []
        named: dict[str, Any] = {}
        required = [p for p in routine.parameters if not p.optional]
        at = 0
        for argument in given:
            if argument.name is None:
                if at >= len(required):
                    raise RapidError("ERR_CALLPROC", routine.name)
                parameter = required[at]
                at += 1
            else:
                index = routine.by_name.get(argument.name)
                if index is None:
                    raise RapidError("ERR_CALLPROC", routine.name)
                parameter = routine.parameters[index]
                at += not parameter.optional
            value = self._late_value(parameter, argument, builtin=routine.node is None)
            key = parameter.name.lower()
            if parameter.optional or named or len(positional) != routine.by_name[key]:
                named[f"v_{key}"] = value
            else:
                positional.append(value)
        if at < len(required):
            raise RapidError("ERR_CALLPROC", routine.name)
        return positional, named

    def _late_value(
        self, parameter: FormalParameter, argument: LateArgument, *, builtin: bool
    ) -> Any:  # noqa: ANN401
        if argument.read is None:
            return True
        kind = parameter.type
        if kind is not None and argument.type is not None and kind.name != argument.type.name:
            raise RapidError("ERR_CALLPROC", f"{parameter.name} is {parameter.type_name}")
        if not parameter.mode:
            return argument.read()
        atomic = kind is not None and kind.kind in ("num", "dnum", "bool", "string")
        objects = kind is not None and kind.kind in ("nonvalue", "semivalue")
        if objects or (parameter.mode == "VAR" and not builtin and not atomic):
            if argument.itself is None:
                raise RapidError("ERR_ARGNOTVAR")
            return argument.itself()
        if argument.refer is None:
            raise RapidError("ERR_ARGNOTVAR")
        return argument.refer()


def _never() -> bool:
    return False
