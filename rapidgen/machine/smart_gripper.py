"""SmartGripper of a YuMi: fingers, vacuum and blow-off valves.

Commands, states, registers and signals (`hand_CmdGripper_L`, ...) are those of its driver,
HandDriver.sys [code kth-ros-pkg/yumi], and of EIO.cfg of a cell [backup RW 6.15]. It works without
these signals; with them, a RAPID driver can control it. Fingers move at the set speed. They are
empty unless `part` or `ring` is set.
"""

from collections.abc import Callable
from enum import IntEnum
from functools import partial
from typing import Final

from rapidgen.machine.io import IOSystem, Signal
from rapidgen.machine.scheduler import MS, S, Scheduler, Timer, WaitSet


class Command(IntEnum):
    """Commands of hand_CmdGripper."""

    JOG_OPEN = 1
    JOG_CLOSE = 2
    TO_MAX = 3
    TO_MIN = 4
    GRIP_INWARD = 5
    GRIP_OUTWARD = 6
    FORCE_INWARD = 7
    FORCE_OUTWARD = 8
    ERROR = 9
    READY = 10
    CALIBRATE = 11
    AGILE_INWARD = 15
    AGILE_OUTWARD = 16


class HandState(IntEnum):
    """States of hand_SysState."""

    READY = 0
    ERROR = 1
    TO_MAX = 2
    TO_MIN = 3
    GRIP_INWARD = 4
    GRIP_OUTWARD = 5
    COMPLETED = 6
    FORCE_INWARD = 7
    FORCE_OUTWARD = 8
    KEEP_OBJECT = 9
    CALIBRATION = 10
    JOG_OPEN = 11
    JOG_CLOSE = 12
    AGILE_INWARD = 16
    AGILE_OUTWARD = 17


PHYSICAL_LIMIT: Final = 25.0
"""mm"""
_MOVING: Final = {
    Command.JOG_OPEN: (HandState.JOG_OPEN, None),
    Command.JOG_CLOSE: (HandState.JOG_CLOSE, None),
    Command.TO_MAX: (HandState.TO_MAX, HandState.COMPLETED),
    Command.TO_MIN: (HandState.TO_MIN, HandState.COMPLETED),
    Command.GRIP_INWARD: (HandState.GRIP_INWARD, HandState.COMPLETED),
    Command.GRIP_OUTWARD: (HandState.GRIP_OUTWARD, HandState.COMPLETED),
    Command.FORCE_INWARD: (HandState.FORCE_INWARD, HandState.KEEP_OBJECT),
    Command.FORCE_OUTWARD: (HandState.FORCE_OUTWARD, HandState.KEEP_OBJECT),
    Command.AGILE_INWARD: (HandState.AGILE_INWARD, HandState.KEEP_OBJECT),
    Command.AGILE_OUTWARD: (HandState.AGILE_OUTWARD, HandState.KEEP_OBJECT),
}
"""States of a command while the fingers move, and at standstill."""
_EXACT: Final = (Command.TO_MAX, Command.TO_MIN)
"""Moves that have to come where they are sent."""
_REPORT: Final = 20 * MS
"""How often the place is reported while the fingers move; ours."""
AMBIENT, SUCKED = 101.0, 20.0
"""kPa at a cup that is free, and at one with a part; ours."""
_REGISTERS: Final = {
    "hand_MaxPosition": "max_position",
    "hand_MinPosition": "min_position",
    "hand_MaxSpeed": "max_speed",
    "hand_HoldForce": "hold_force",
}


class SmartGripper:
    """A hand, `L` or `R`. Lengths are mm, speeds mm/s, forces N."""

    def __init__(
        self, scheduler: Scheduler, io: IOSystem, side: str, *, calibrated: bool = False
    ) -> None:
        self._scheduler = scheduler
        self._io = io
        self.side = side
        self.max_position, self.min_position = 20.0, 2.0
        self.max_speed, self.hold_force = 20.0, 15.0
        self.state = HandState.READY
        self.calibrated = calibrated
        self.part: float | None = None
        """Width of a part between the fingers, which limits their inward travel."""
        self.ring: float | None = None
        """Width inside of what they are in: outward they come no further."""
        self.cups = [False, False]
        """True if a part closes the suction cup."""
        self.vacuum, self.blow = [False, False], [False, False]
        self.changed = WaitSet()
        """Notified of each change of the hand."""
        self._from = self._to = self._zero = 0.0
        self._began = 0
        self._speed = 0.0
        self._timers: list[Timer] = []
        self._listen()
        self._report()

    # -- state -----------------------------------------------------------------------------------

    @property
    def position(self) -> float:
        """Opening of the fingers, from the place of calibration."""
        return self._place() - self._zero

    @property
    def speed(self) -> float:
        """Speed without a sign."""
        return 0.0 if self._place() == self._to else self._speed

    @property
    def force(self) -> float:
        """Grip force."""
        return self.hold_force if self.state is HandState.KEEP_OBJECT else 0.0

    def pressure(self, cup: int) -> float:
        """Return the pressure at a cup (0 or 1), kPa."""
        return SUCKED if self.vacuum[cup] and self.cups[cup] else AMBIENT

    def _place(self) -> float:
        way = self._speed * (self._scheduler.now - self._began) / S
        if way >= abs(self._to - self._from):
            return self._to
        return self._from + (way if self._to > self._from else -way)

    # -- what it does ----------------------------------------------------------------------------

    def order(self, code: int) -> None:
        """Send a command by its signal, where there is one."""
        signal = self._signal("hand_CmdGripper")
        if signal is None or signal.value == code:
            self.command(code)
        else:
            self._io.set(signal, code)  # which it listens to

    def command(self, code: int) -> None:
        """Execute a `Command`; ignore others."""
        if code not in list(Command):
            return
        order = Command(code)
        self._stand()
        if order in _MOVING:
            self.state = _MOVING[order][0]
            self._move(order)
        elif order is Command.CALIBRATE:
            self._zero, self.calibrated = self._to, True
            self.state = HandState.COMPLETED
        else:
            self.state = HandState.READY if order is Command.READY else HandState.ERROR
        self._report()

    def _stand(self) -> None:
        for timer in self._timers:
            timer.cancel()
        self._from = self._to = self._place()

    def _move(self, order: Command) -> None:
        inward = order in (
            *(Command.JOG_CLOSE, Command.TO_MIN, Command.GRIP_INWARD),
            *(Command.FORCE_INWARD, Command.AGILE_INWARD),
        )
        expected = 0.0 if inward else PHYSICAL_LIMIT
        if order in _EXACT:
            register = self.min_position if inward else self.max_position
            expected = min(max(register + self._zero, 0.0), PHYSICAL_LIMIT)
        self._to = expected
        if inward and self.part is not None:
            self._to = min(max(expected, self.part), self._from)
        elif not inward and self.ring is not None:
            self._to = max(min(expected, self.ring), self._from)
        self._began, self._speed = self._scheduler.now, self.max_speed
        lasts = round(abs(self._to - self._from) / self._speed * S)
        missed = order in _EXACT and abs(self._to - expected) > 1e-9
        self._timers = [self._scheduler.after(lasts, lambda: self._arrive(order, missed))]
        if lasts > _REPORT:
            self._timers.append(self._scheduler.after(_REPORT, self._go_on))

    def _go_on(self) -> None:
        self._timers[1:] = [self._scheduler.after(_REPORT, self._go_on)]
        self._report()

    def _arrive(self, order: Command, missed: bool) -> None:
        self._from = self._to
        self._stand()
        after = _MOVING[order][1]
        if missed:
            self.state = HandState.ERROR
        elif after is not None:
            self.state = after
        self._report()

    def switch(self, valve: str, cup: int, on: bool) -> None:
        """Open or close the valve of `vacuum` or `blow` of a cup, 0 or 1."""
        signal = self._signal(f"hand_Cmd{'Vacuum' if valve == 'vacuum' else 'Blowoff'}{cup + 1}")
        if signal is not None:
            self._io.set(signal, int(on))
        self._valve(valve, cup, on)

    def _valve(self, valve: str, cup: int, on: float) -> None:
        (self.vacuum if valve == "vacuum" else self.blow)[cup] = bool(on)
        self._report()

    def set_register(self, register: str, value: float) -> None:
        """Write a register and its signal.

        Registers are max_position, min_position, max_speed and hold_force.
        """
        setattr(self, register, value)
        for name, known in _REGISTERS.items():
            signal = self._signal(name) if known == register else None
            if signal is not None:
                self._io.set(signal, min(round(value * 10), signal.largest))

    # -- its signals -----------------------------------------------------------------------------

    def _signal(self, name: str) -> Signal | None:
        return self._io.get(f"{name}_{self.side}")

    def _listen(self) -> None:
        """React to outputs of a RAPID driver, where the system has them."""
        self._on("hand_CmdGripper", lambda value: self.command(int(value)))
        for name, register in _REGISTERS.items():
            self._on(name, partial(self._take, register))
        for cup in range(2):
            self._on(f"hand_CmdVacuum{cup + 1}", partial(self._valve, "vacuum", cup))
            self._on(f"hand_CmdBlowoff{cup + 1}", partial(self._valve, "blow", cup))

    def _take(self, register: str, value: float) -> None:
        setattr(self, register, value / 10)

    def _on(self, name: str, act: Callable[[float], None]) -> None:
        signal = self._signal(name)
        if signal is not None:
            signal.changed.add(lambda: act(signal.value))
            if signal.value:
                act(signal.value)

    def _report(self) -> None:
        values = {
            "ActualPosition": round(self.position * 10),
            "ActualSpeed": round(self.speed * 10),
            "SysState": self.state,
            "StatusCalibrated": self.calibrated,
        }
        for cup in range(2):
            values[f"StatusVacuum{cup + 1}"] = self.vacuum[cup]
            values[f"StatusBlowoff{cup + 1}"] = self.blow[cup]
            values[f"ActualPressure{cup + 1}"] = round(self.pressure(cup))
        for name, value in values.items():
            signal = self._signal(f"hand_{name}")
            if signal is not None:
                self._io.set(signal, min(max(int(value), 0), signal.largest))
        self.changed.notify()


class Hands:
    """Both hands of a YuMi, and their settings by programs."""

    def __init__(self, scheduler: Scheduler, io: IOSystem, *, calibrated: bool = False) -> None:
        self.hands = {
            side: SmartGripper(scheduler, io, side, calibrated=calibrated) for side in "LR"
        }
        self.limits = dict.fromkeys("LR", PHYSICAL_LIMIT)
        """mm that positions may ask for, by side."""
        self.chosen: dict[str, str] = {}
        """The side that a task has chosen (Hand_CastChirality)."""

    def __getitem__(self, side: str) -> SmartGripper:
        return self.hands[side]
