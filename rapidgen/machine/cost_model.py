"""Reference cost model of the virtual clock.

See docs/rapid/virtual-controller.md.
"""

from dataclasses import dataclass, replace


@dataclass(frozen=True, slots=True)
class Costs:
    """Nanoseconds of the one CPU.

    No public source has better figures; all can be changed.
    """

    statement: int = 5_000
    operator: int = 1_000
    """Each operator, component or element access."""
    call: int = 5_000
    builtin_scale: float = 1.0
    """Factor of the string, raw-bytes, socket and move built-ins (50 us, 500 us, 1 ms)."""
    module_load: int = 1_000
    """A byte of a module that Load and StartLoad read."""
    module_link: int = 0
    """A byte of a module that Load and WaitLoad link."""
    quantum: int = 2_000_000
    """Round robin."""
    interrupt_delay: tuple[int, int] = (2_000_000, 30_000_000)
    """From event to trap [K §8.1]."""

    def scaled(self, factor: float) -> "Costs":
        """Return the costs with `builtin_scale` multiplied by `factor`."""
        return replace(self, builtin_scale=self.builtin_scale * factor)
