"""Web UI of a robot, a simulation or a recording."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rapidgen.viewer.plotting import Plot, plot

__all__ = ["Plot", "plot"]


def __getattr__(name: str) -> object:
    # A live table must not pay for curves.
    if name in __all__:
        from rapidgen.viewer import plotting

        return getattr(plotting, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
