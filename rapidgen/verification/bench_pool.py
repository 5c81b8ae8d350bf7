"""Controllers before their first moment: booted and compiled once, begun many times in copies.

Nothing has been executed on such a controller, no chance was drawn and no client was there. So a
copy of the process that takes it, with chances and a network of its own, does what a controller
does that boots with these.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

from rapidgen.config.model import RobotConfig
from rapidgen.system.model import System
from rapidgen.verification.settings import Setting
from rapidgen.verification.testbench import Bench

Boot: TypeAlias = Callable[[RobotConfig, System, Setting], Bench]
"""Gives a controller of which nothing has run yet; `Bench` is one."""


class BenchPool:
    """Those of a worker, by what is decided at boot."""

    def __init__(self) -> None:
        self._kept: dict[tuple[System, Setting], Bench] = {}

    def keep(self, config: RobotConfig, system: System, setting: Setting) -> None:
        """Have one there that can begin under a setting: for copies of this process."""
        key = system, _at_boot(setting)
        # While a robot settles something is executed already.
        if key not in self._kept and setting.early() == setting:
            self._kept[key] = bench = Bench(config, *key)
            bench.compile()

    def take(self, config: RobotConfig, system: System, setting: Setting) -> Bench:
        """The one for a setting, or one that boots.

        It can be taken once: by a copy.
        """
        bench = self._kept.pop((system, _at_boot(setting)), None)
        if bench is None:
            return Bench(config, system, setting)
        bench.begin(setting)
        return bench


def _at_boot(setting: Setting) -> Setting:
    """The same without what can still be chosen when it is booted."""
    return replace(setting, seed=0, faults=replace(setting.faults, network=()))
