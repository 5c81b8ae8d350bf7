"""Plots of trajectories and recordings: notebook, HTML, PNG or SVG.

HTML uses uPlot (bundled into `assets/plot.js` with the page): zoom, one cursor for all charts,
curves switched off by their names. Pictures use matplotlib, an extra: `rapidgen[plot]`.
"""

import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from html import escape
from importlib.util import find_spec
from os import PathLike
from pathlib import Path

import numpy as np

from rapidgen._atomic_write import write_whole
from rapidgen.client.core.group import Group
from rapidgen.client.recording import JointRecording
from rapidgen.diagnostics import refusal
from rapidgen.motion.recorder import Recording
from rapidgen.viewer.chart_data import (
    Chart,
    Curve,
    PathView,
    Plottable,
    TimeAxis,
    charts_of,
    idle_cuts,
    layers_of,
    motion_charts,
)

ASSETS = Path(__file__).resolve().parent / "assets"
KINDS = (".html", ".png", ".svg")
_LIMIT = "#b0b0b0"
_KINDS = {
    "stop": "grey line: stop point",
    "late": "red: a corner became a stop (50024)",
    "event": "violet: event on the path",
}


@dataclass(frozen=True, slots=True)
class Plot:
    """Charts below one another; a notebook shows them, `save` writes them."""

    title: str
    charts: tuple[Chart, ...]
    paths: tuple[PathView, ...] = ()
    """The path of the TCP."""
    axis: TimeAxis = field(default_factory=lambda: TimeAxis(()))
    """Long standstills are cut."""

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

            write_whole(path, picture(self, path.suffix[1:]))
        return path

    def html(self) -> str:
        """Return a self-contained page. DiagnosticError RG920."""
        # A name may hold "</script>".
        data = json.dumps(_data(self.charts, self.axis)).replace("<", "\\u003c")
        return (
            '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
            f"<title>{escape(self.title)}</title><style>{_asset('plot.css')}</style></head><body>"
            f'<h1 style="font:600 18px system-ui,sans-serif">{escape(self.title)}</h1>'
            f'<div class="paths">{"".join(map(_path_svg, self.paths))}{self._key()}</div>'
            f'<div id="plots"></div><script type="application/json" id="plot-data">{data}</script>'
            f"<script>{_asset('plot.js')}</script></body></html>\n"
        )

    def _key(self) -> str:
        """Return what shades and lines of the charts mean."""
        texts = []
        if any(chart.spans for chart in self.charts):
            texts.append("green: corner of a fly-by point")
        kinds = {note.kind for chart in self.charts for note in chart.notes}
        texts += [text for kind, text in _KINDS.items() if kind in kinds]
        if self.axis.cuts:
            texts.append("grey bar: a standstill is cut")
        return f"<p>{'; '.join(texts)}</p>" if texts else ""

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
    robot has its own); then the second minus the first. A recording of the simulation begins with
    the TCP's speed and path. Standstills that are long compared with the movement are cut. `labels`
    are names of the items, `linear` joints in m that no group declares.
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
    charts, paths = [], []
    for thing in displayed:
        if isinstance(thing, Recording):
            speed, views = motion_charts(thing)
            charts += speed
            paths += views
    return Plot(
        title or " and ".join(layer.label for layer in layers),
        (*charts, *charts_of(layers, group, linear)),
        tuple(paths),
        TimeAxis(idle_cuts(layers)),
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


def _data(charts: Sequence[Chart], axis: TimeAxis) -> dict[str, object]:
    """Return the data of `plot.js`: curves on the union of all displayed times."""
    curves = [curve for chart in charts for curve in chart.curves]
    displayed = {id(curve): np.round(axis.displayed(curve.times), 4) for curve in curves}
    times = np.unique(np.concatenate([np.zeros(0), *displayed.values()]))

    def column(curve: Curve) -> list[float | None]:
        known = displayed[id(curve)]
        if not len(known):
            return [None] * len(times)
        at = np.interp(times, known, curve.values, left=np.nan, right=np.nan)
        return [None if value != value else round(value, 4) for value in at.tolist()]

    def at(time: float) -> float:
        return round(axis.displayed_one(time), 4)

    return {
        "time": times.tolist(),
        "cuts": [[round(place, 4), round(length, 4)] for place, length in axis.breaks],
        "charts": [
            {
                "title": chart.title,
                "unit": chart.unit,
                "spans": [[at(begin), at(end)] for begin, end in chart.spans],
                "marks": [[at(note.time), note.text, note.kind] for note in chart.notes],
                "curves": [
                    {
                        "name": curve.label,
                        "values": column(curve),
                        **({"dashed": True, "color": _LIMIT} if curve.is_limit else {}),
                    }
                    for curve in chart.curves
                ],
            }
            for chart in charts
        ],
    }


def _path_svg(view: PathView) -> str:
    """Return a path of the TCP as SVG; corners are thick, stops are dots."""
    low, high = view.points.min(axis=0), view.points.max(axis=0)
    size = max(float((high - low).max()), 1.0)
    margin = size * 0.06
    left, top = float(low[0]) - margin, -float(high[1]) - margin
    width, height = (float(span) + 2 * margin for span in high - low)

    def line(points: np.ndarray, thick: float, kind: str) -> str:
        places = " ".join(f"{x:.1f},{-y:.1f}" for x, y in points.tolist())
        return f'<polyline class="{kind}" points="{places}" stroke-width="{thick:.2f}"/>'

    parts = [line(view.points, size / 250, "path")]
    parts += [line(view.points[a : b + 1], size / 100, "corner") for a, b in view.corners]
    parts += [
        f'<circle cx="{x:.1f}" cy="{-y:.1f}" r="{size / 120:.2f}"/>' for x, y in view.stops.tolist()
    ]
    ranges = "; ".join(
        f"{name} {a:.0f} to {b:.0f} mm"
        for name, a, b in zip((view.horizontal, view.vertical), low, high, strict=True)
    )
    box = f"{left:.1f} {top:.1f} {width:.1f} {height:.1f}"
    return (
        f"<figure><figcaption>TCP path: {ranges}</figcaption>"
        f'<svg viewBox="{box}">{"".join(parts)}</svg></figure>'
    )
