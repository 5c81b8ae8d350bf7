"""Pool of booted controllers that have not executed anything yet.

A controller is booted and compiled once, and copies of it start many times. A pooled controller has
executed nothing, has drawn no random number and has had no client. A copy of the process that takes
it sets a random generator and a network of its own. The copy then behaves like a controller that
boots with these.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

from rapidgen.config.model import RobotConfig
from rapidgen.system.model import System
from rapidgen.verification.settings import Setting
from rapidgen.verification.testbench import Bench

Boot: TypeAlias = Callable[[RobotConfig, System, Setting], Bench]
"""Return a controller that has executed nothing yet; `Bench` is one."""


class BenchPool:
    """The pooled controllers of a worker, keyed by what is decided at boot."""

    def __init__(self) -> None:
        self._kept: dict[tuple[System, Setting], Bench] = {}

    def keep(self, config: RobotConfig, system: System, setting: Setting) -> None:
        """Boot a controller for a setting, for copies of this process."""
        key = system, _at_boot(setting)
        # While a robot settles, tasks execute already.
        if key not in self._kept and setting.early() == setting:
            self._kept[key] = bench = Bench(config, *key)
            bench.compile()

    def take(self, config: RobotConfig, system: System, setting: Setting) -> Bench:
        """Return the pooled controller for a setting, or boot one.

        Each copy of the process can take it once.
        """
        bench = self._kept.pop((system, _at_boot(setting)), None)
        if bench is None:
            return Bench(config, system, setting)
        bench.begin(setting)
        return bench


def _at_boot(setting: Setting) -> Setting:
    """Return the setting without the options that can change after boot."""
    return replace(setting, seed=0, faults=replace(setting.faults, network=()))
