"""Charts as a picture by matplotlib, an optional package."""

import io
from typing import TYPE_CHECKING

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from rapidgen.viewer.chart_data import SPEED, Chart, PathView, TimeAxis

if TYPE_CHECKING:
    from rapidgen.viewer.plotting import Plot

_LIMIT = "0.6"
_CORNER, _STOP, _LATE, _EVENT = "#2a9487", "0.35", "#c43c3c", "#8356b5"
_MARKS = {"stop": (_STOP, ":", "stop point"), "late": (_LATE, "-", "50024"),
          "event": (_EVENT, "--", "event on the path")}  # fmt: skip


def picture(plot: "Plot", kind: str) -> bytes:
    """PNG or SVG (`kind` png, svg): the TCP's speed, its path, then two charts a row.

    The global state of pyplot is not changed.
    """
    wide = [chart for chart in plot.charts if chart.title == SPEED]
    halves: list[Chart | PathView] = [*plot.paths]
    halves += [chart for chart in plot.charts if chart.title != SPEED]
    columns = 1 if len(halves) <= 1 else 2
    heights = [2.4] * len(wide)
    heights += [3.4] * -(-len(plot.paths) // columns)
    heights += [2.2] * -(-(len(halves) - len(plot.paths)) // columns)
    heights = heights or [2.2]
    figure = Figure(figsize=(5.6 * columns, sum(heights) + 0.8), layout="constrained")
    FigureCanvasAgg(figure)
    figure.suptitle(_plain(plot.title), fontsize=12)
    grid = figure.add_gridspec(len(heights), columns, height_ratios=heights)
    for row, chart in enumerate(wide):
        _over_time(figure.add_subplot(grid[row, :]), chart, plot.axis)
    for index, half in enumerate(halves):
        row = len(wide) + index // columns
        axes = figure.add_subplot(grid[row, index % columns])
        if isinstance(half, PathView):
            _path(axes, half)
        else:
            _over_time(axes, half, plot.axis)
    drawn = io.BytesIO()
    figure.savefig(drawn, format=kind, dpi=110)
    return drawn.getvalue()


def _over_time(axes: Axes, chart: Chart, time: TimeAxis) -> None:
    axes.set_title(_plain(chart.heading), fontsize=10, loc="left")
    for number, curve in enumerate(chart.curves):
        # The first line is wider, so that later ones do not hide it.
        times = time.displayed(curve.times)
        (line,) = axes.plot(times, curve.values, label=_plain(curve.label))
        line.set_linewidth(2.6 if number == 0 and len(chart.curves) > 1 else 1.2)
        if curve.is_limit:
            line.set(linestyle="--", color=_LIMIT)
    for number, (begin, end) in enumerate(chart.spans):
        low, high = time.displayed_one(begin), time.displayed_one(end)
        axes.axvspan(low, high, color=_CORNER, alpha=0.22, lw=0, label="" if number else "corner")
    seen: set[str] = set()
    for note in chart.notes:
        colour, style, label = _MARKS[note.kind]
        named = "" if note.kind in seen else label
        seen.add(note.kind)
        place = time.displayed_one(note.time)
        axes.axvline(place, color=colour, linestyle=style, linewidth=0.9, label=named)
    for place, length in time.breaks:
        axes.axvline(place, color="0.5", linewidth=4, alpha=0.35)
        axes.annotate(
            f"{length:.4g} s",
            (place, 1),
            xycoords=("data", "axes fraction"),
            fontsize=6,
            rotation=90,
            ha="right",
            va="top",
        )
    axes.grid(alpha=0.3)
    axes.tick_params(labelsize=8)
    if time.breaks:
        axes.xaxis.set_major_formatter(FuncFormatter(lambda at, _: f"{time.real(at):.5g}"))
    axes.set_xlabel("s, standstills cut" if time.breaks else "s", fontsize=8)
    low, high = axes.get_ylim()
    if high - low < chart.least_height:
        middle, half = (low + high) / 2, chart.least_height / 2
        axes.set_ylim(middle - half, middle + half)
    if chart.curves:
        axes.legend(fontsize=7, loc="best")


def _path(axes: Axes, view: PathView) -> None:
    title = f"TCP path, {view.horizontal} and {view.vertical} [mm]"
    axes.set_title(title, fontsize=10, loc="left")
    axes.plot(view.points[:, 0], view.points[:, 1], linewidth=1.2)
    for number, (first, last) in enumerate(view.corners):
        part = view.points[first : last + 1]
        label = "" if number else "corner"
        axes.plot(part[:, 0], part[:, 1], color=_CORNER, linewidth=3, alpha=0.7, label=label)
    if len(view.stops):
        axes.scatter(view.stops[:, 0], view.stops[:, 1], s=16, color=_STOP, label="stands")
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel(view.horizontal, fontsize=8)
    axes.set_ylabel(view.vertical, fontsize=8)
    axes.grid(alpha=0.3)
    axes.tick_params(labelsize=8)
    if len(view.stops) or view.corners:
        axes.legend(fontsize=7, loc="best")


def _plain(text: str) -> str:
    """Escape text: matplotlib takes dollars for mathematics.

    It also hides labels that begin with an underscore.
    """
    return text.replace("$", r"\$").lstrip("_") or " "
