"""Charts as a picture by matplotlib, an optional package."""

import io
from collections.abc import Sequence

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from rapidgen.viewer.chart_data import Chart

_LIMIT = "0.6"


def picture(title: str, charts: Sequence[Chart], kind: str) -> bytes:
    """PNG or SVG (`kind` png, svg), two charts a row.

    The global state of pyplot is not changed.
    """
    columns = 1 if len(charts) <= 1 else 2
    rows = max(1, -(-len(charts) // columns))
    figure = Figure(figsize=(5.6 * columns, 2.2 * rows + 0.8), layout="constrained")
    FigureCanvasAgg(figure)
    figure.suptitle(_plain(title), fontsize=12)
    for index, chart in enumerate(charts):
        axes = figure.add_subplot(rows, columns, index + 1)
        axes.set_title(_plain(chart.heading), fontsize=10, loc="left")
        for number, curve in enumerate(chart.curves):
            # The first line is wider, so that later ones do not hide it.
            (line,) = axes.plot(curve.times, curve.values, label=_plain(curve.label))
            line.set_linewidth(2.6 if number == 0 and len(chart.curves) > 1 else 1.2)
            if curve.is_limit:
                line.set(linestyle="--", color=_LIMIT)
        axes.grid(alpha=0.3)
        axes.tick_params(labelsize=8)
        axes.set_xlabel("s", fontsize=8)
        low, high = axes.get_ylim()
        if high - low < chart.least_height:
            middle, half = (low + high) / 2, chart.least_height / 2
            axes.set_ylim(middle - half, middle + half)
        if chart.curves:
            axes.legend(fontsize=7, loc="best")
    drawn = io.BytesIO()
    figure.savefig(drawn, format=kind, dpi=110)
    return drawn.getvalue()


def _plain(text: str) -> str:
    """Escape text: matplotlib takes dollars for mathematics.

    It also hides labels that begin with an underscore.
    """
    return text.replace("$", r"\$").lstrip("_") or " "
