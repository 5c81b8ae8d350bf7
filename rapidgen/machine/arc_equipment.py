"""Arc welding equipment: gas, arc and references.

PROC.cfg names the signals. The power source is simulated: it answers WeldOn with ArcEst at once.
Data of an arc are those of arcdata, by component.
"""

from collections.abc import Mapping
from typing import Final

from rapidgen.machine.io import IOSystem, Signal
from rapidgen.system.model import ArcSignals

REFERENCES: Final = {
    "SchedulePort": "sched",
    "ModePort": "mode",
    "VoltReference": "voltage",
    "FeedReference": "wirefeed",
    "ControlPort": "control",
    "CurrentReference": "current",
}
"""Which component of arcdata an output shows."""


class ArcEquipment:
    """Welding equipment of a task."""

    def __init__(self, io: IOSystem, signals: tuple[ArcSignals, ...], task: str) -> None:
        self._io = io
        own = [s for s in signals if s.instance.lower().endswith(task.lower())]
        self._names = {use.lower(): name for one in own for use, name in one.names}
        self.gas = self.arc = self.feed = False
        self._held = False
        self.data: Mapping[str, float] = {}

    @property
    def inhibited(self) -> bool:
        """True if the cell's input WeldInhib forbids welding."""
        signal = self.signal("WeldInhib")
        return signal is not None and bool(signal.value)

    def signal(self, use: str) -> Signal | None:
        """Return the signal for a use, None without one."""
        return self._io.get(self._names.get(use.lower(), ""))

    def set_gas(self, on: bool) -> None:
        """Open or close the gas valve."""
        self.gas = on
        self._set("GasOn", on)

    def set_arc(self, on: bool) -> None:
        """Switch the arc on or off; the power source answers."""
        self.arc = self.feed = on
        self._set("WeldOn", on)
        self._set("FeedOn", on)
        self._set("ArcEst", on)

    def put_out(self) -> None:
        """Switch arc and gas off."""
        self.set_arc(False)
        self.set_gas(False)

    def hold(self) -> None:
        """Extinguish a burning arc while the program is stopped."""
        if self.arc:
            self.put_out()
            self._held = True

    def go_on(self) -> None:
        """Continue after a stop of the program."""
        if self._held:
            self._held = False
            self.set_gas(True)
            self.set_arc(True)

    def reset(self) -> None:
        """End the weld, for PP to main."""
        self._held = False
        self.put_out()

    def stop_feeding(self) -> None:
        """Stop the wire feed; the arc burns back."""
        self.feed = False
        self._set("FeedOn", False)

    def refer(self, data: Mapping[str, float]) -> None:
        """Set the reference values. ValueError: a signal cannot represent one."""
        self.data = dict(data)
        for use, component in REFERENCES.items():
            self._set(use, data[component])

    def _set(self, use: str, value: float) -> None:
        signal = self.signal(use)
        if signal is not None:
            self._io.set(signal, value)
