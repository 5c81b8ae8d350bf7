"""Controllers before their first moment: booted and compiled once, begun many times in copies.

Nothing has been executed on such a controller, no chance was drawn and no client was there. So a
copy of the process that takes it, with chances and a network of its own, does what a controller
does that boots with these.
"""

from dataclasses import replace

from rapidgen.config.model import RobotConfig
from rapidgen.proving.bench import Bench
from rapidgen.proving.settings import Setting
from rapidgen.system.model import System


class FreshBenches:
    """Those of one driver, by what is decided at boot."""

    def __init__(self, config: RobotConfig, system: System) -> None:
        self._config = config
        self._system = system
        self._kept: dict[Setting, Bench] = {}

    def keep(self, setting: Setting) -> None:
        """Have one there that can begin under a setting: for copies of this process."""
        like = _at_boot(setting)
        # While a robot settles something is executed already.
        if like not in self._kept and like.early() == like:
            self._kept[like] = bench = Bench(self._config, self._system, like)
            bench.compile()

    def take(self, setting: Setting) -> Bench:
        """The one for a setting, or one that boots. It can be taken once: by a copy."""
        bench = self._kept.pop(_at_boot(setting), None)
        if bench is None:
            return Bench(self._config, self._system, setting)
        bench.begin(setting)
        return bench


def _at_boot(setting: Setting) -> Setting:
    """The same without what can still be chosen when it is booted."""
    return replace(setting, seed=0, faults=replace(setting.faults, network=()))
