"""Plots of trajectories and recordings: notebook, HTML, PNG or SVG.

HTML uses uPlot (bundled into `assets/plot.js` with the page): zoom, one cursor for all charts,
curves switched off by their names. Pictures use matplotlib, an extra: `rapidgen[plot]`.
"""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from importlib.util import find_spec
from os import PathLike
from pathlib import Path

import numpy as np

from rapidgen._atomic_write import write_whole
from rapidgen.client.core.group import Group
from rapidgen.client.recording import JointRecording
from rapidgen.diagnostics import refusal
from rapidgen.viewer.chart_data import Chart, Plottable, charts_of, layers_of

ASSETS = Path(__file__).resolve().parent / "assets"
KINDS = (".html", ".png", ".svg")
_LIMIT = "#b0b0b0"


@dataclass(frozen=True, slots=True)
class Plot:
    """Charts below one another; a notebook shows them, `save` writes them."""

    title: str
    charts: tuple[Chart, ...]

    def save(self, path: str | PathLike[str]) -> Path:
        """Write a whole .html, .png or .svg file.

        DiagnosticError RG626: another suffix, or matplotlib is missing; RG920: a checkout without
        the built page. Raises OSError.
        """
        path = Path(path)
        _require(path.suffix)
        if path.suffix == ".html":
            write_whole(path, self.html().encode())
        else:
            # Imported on use: matplotlib is an extra, and slow to import.
            from rapidgen.viewer.matplotlib_charts import picture

            write_whole(path, picture(self.title, self.charts, path.suffix[1:]))
        return path

    def html(self) -> str:
        """Return a self-contained page. DiagnosticError RG920."""
        # A name may hold "</script>".
        data = json.dumps(_data(self.charts)).replace("<", "\\u003c")
        return (
            '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
            f"<title>{escape(self.title)}</title><style>{_asset('plot.css')}</style></head><body>"
            f'<h1 style="font:600 18px system-ui,sans-serif">{escape(self.title)}</h1>'
            f'<div id="plots"></div><script type="application/json" id="plot-data">{data}</script>'
            f"<script>{_asset('plot.js')}</script></body></html>\n"
        )

    def _repr_html_(self) -> str:
        height = 60 + 300 * len(self.charts)
        return (
            f'<iframe srcdoc="{escape(self.html())}" style="width:100%;border:0;'
            f'height:min({height}px,80vh)"></iframe>'
        )


def plot(
    *displayed: Plottable,
    labels: Sequence[str] = (),
    group: Group | None = None,
    linear: Sequence[str] = (),
    title: str = "",
) -> Plot:
    """Plot trajectories and recordings over one time.

    One chart a joint in degrees or mm, with all items and the limits of `group` (a recording of a
    robot has its own); then the second minus the first. `labels` are names of the items, `linear`
    joints in m that no group declares.
    """
    for thing in displayed:
        if not isinstance(thing, Plottable):
            raise TypeError(
                "plot takes trajectories and recordings, not "
                f"{type(thing).__name__}; `Trajectory.from_csv(path)` reads a file"
            )
        if group is None and isinstance(thing, JointRecording):
            group = thing.group
    layers = layers_of(displayed, labels)
    return Plot(
        title or " and ".join(layer.label for layer in layers),
        tuple(charts_of(layers, group, linear)),
    )


def files_of(path: Path) -> list[Path]:
    """Return the files of a plot by suffix.

    Without a suffix they are .html and .png, as far as available. Refuses what `Plot.save` will
    refuse.
    """
    if path.suffix:
        _require(path.suffix)
        return [path]
    can = {".html": (ASSETS / "plot.js").is_file(), ".png": _has_matplotlib()}
    if not any(can.values()):
        _require(".html")
    return [path.with_name(f"{path.name}{kind}") for kind, is_so in can.items() if is_so]


def _has_matplotlib() -> bool:
    return find_spec("matplotlib") is not None


def _require(suffix: str) -> None:
    if suffix not in KINDS:
        raise refusal(
            "RG626",
            None,
            f"a plot is written as .html, .png or .svg, not as '{suffix}'",
            "give the file one of these suffixes",
        )
    if suffix == ".html":
        _asset("plot.js")
    elif not _has_matplotlib():
        raise refusal(
            "RG626",
            None,
            f"a {suffix} file is drawn by matplotlib, which is not installed",
            "pip install 'rapidgen[plot]'; .html needs nothing more",
        )


def _asset(name: str) -> str:
    path = ASSETS / name
    if not path.is_file():
        raise refusal(
            "RG920",
            None,
            "the page, which an HTML file includes, has not been built",
            "in a checkout, `make page` builds it; a wheel has it",
            exit_code=1,
        )
    return path.read_text(encoding="utf-8")


def _data(charts: Sequence[Chart]) -> dict[str, object]:
    """Return the data of `plot.js`: curves on the union of all times."""
    curves = [curve for chart in charts for curve in chart.curves]
    times = np.unique(np.concatenate([np.zeros(0), *(np.round(c.times, 4) for c in curves)]))

    def column(known: np.ndarray, values: np.ndarray) -> list[float | None]:
        if not len(known):
            return [None] * len(times)
        at = np.interp(times, known, values, left=np.nan, right=np.nan)
        return [None if value != value else round(value, 4) for value in at.tolist()]

    return {
        "time": times.tolist(),
        "charts": [
            {
                "title": chart.title,
                "unit": chart.unit,
                "curves": [
                    {
                        "name": curve.label,
                        "values": column(np.round(curve.times, 4), curve.values),
                        **({"dashed": True, "color": _LIMIT} if curve.is_limit else {}),
                    }
                    for curve in chart.curves
                ],
            }
            for chart in charts
        ],
    }
