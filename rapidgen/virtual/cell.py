"""What stands around a controller and is in none of its generated files.

A configuration exposes signals of the cell to clients. They are the customer's: his own EIO.cfg
defines them, with units and bits, so that a generated one must not. Whoever boots a driver here
gets them as virtual signals of the types that the configuration names.
"""

from dataclasses import replace

from rapidgen.config.model import RobotConfig
from rapidgen.system.model import SignalSpec, System

GROUP_BITS = 32
"""Bits of an exposed group signal; the configuration does not tell how many there are."""


def in_its_cell(system: System, config: RobotConfig) -> System:
    """`system` with the signals that `config` exposes, but for those that it has."""
    known = {signal.name.lower() for signal in system.signals}
    exposed = tuple(
        SignalSpec(signal.name, signal.kind, size=GROUP_BITS if signal.kind[0] == "G" else 1)
        for signal in config.signals
        if signal.name.lower() not in known
    )
    return replace(system, signals=(*system.signals, *exposed))
