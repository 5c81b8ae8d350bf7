"""Web UI of a robot, a simulation or a recording."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rapidgen.viewer.notebook import RobotView, progress, view
    from rapidgen.viewer.plotting import Plot, plot

__all__ = ["Plot", "RobotView", "plot", "progress", "view"]


def __getattr__(name: str) -> object:
    # A live table must not pay for curves.
    if name in __all__:
        from rapidgen.viewer import notebook, plotting

        return getattr(plotting if name in ("Plot", "plot") else notebook, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
