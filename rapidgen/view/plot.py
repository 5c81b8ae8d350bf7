"""Commanded against executed joints over time, as PNG and as one self-contained HTML file.

One layout makes a list of shapes; an SVG writer and a Pillow writer draw them. (Pillow: it has
anti-aliased text and comes with yourdfpy anyway; matplotlib would be ten times its size.)
"""

import io
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from rapidgen._writing import write_whole
from rapidgen.client.trajectory import Array, Trajectory

COLOURS = ("#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e", "#17becf")
_WIDTH, _PANEL, _GAP = 520, 190, 26
_LEFT, _RIGHT, _TOP, _BOTTOM = 62, 14, 26, 30
_HEAD = 64
_MOST = 1200
"""Points of a drawn curve; more are thinned to the least and greatest of each column."""
_GREY, _TEXT, _GRID = "#666666", "#222222", "#dddddd"


@dataclass(frozen=True, slots=True)
class PlottedCurve:
    """One line style of the picture: what it is called, and the joints over time."""

    label: str
    trajectory: Trajectory


@dataclass(frozen=True, slots=True)
class _Line:
    points: Array
    colour: str
    width: float


@dataclass(frozen=True, slots=True)
class _Text:
    x: float
    y: float
    text: str
    anchor: str = "start"
    size: int = 12
    colour: str = _TEXT


@dataclass(frozen=True, slots=True)
class _Panel:
    """Where a joint is drawn, and how its pixels become seconds and values."""

    name: str
    unit: str
    x: float
    y: float
    width: float
    height: float
    times: tuple[float, float]
    values: tuple[float, float]

    def at(self, times: Array, values: Array) -> Array:
        """Pixels (n, 2)."""
        (t0, t1), (v0, v1) = self.times, self.values
        x = self.x + (times - t0) / (t1 - t0) * self.width
        y = self.y + self.height - (values - v0) / (v1 - v0) * self.height
        return np.column_stack([x, y])


@dataclass(frozen=True, slots=True)
class _Scene:
    width: int
    height: int
    lines: tuple[_Line, ...]
    texts: tuple[_Text, ...]
    panels: tuple[_Panel, ...]


def write_plot(
    png: Path | None,
    html: Path | None,
    curves: Sequence[PlottedCurve],
    *,
    title: str,
    prismatic: Sequence[str] = (),
    counts: Sequence[str] = (),
) -> None:
    """Draw one panel a joint, all curves in each, in degrees and mm.

    Joints are those of the first curve that has names; joints called in `prismatic` are in m,
    those in `counts` plain numbers. Curves without points are left out. Raises OSError.
    """
    units = {name: ("mm", 1000.0) for name in prismatic} | {name: ("", 1.0) for name in counts}
    scene = _layout(curves, title, units)
    if png is not None:
        _draw_png(scene, png)
    if html is not None:
        write_whole(html, _html(scene, curves, title, units).encode())


def _joints(curves: Sequence[PlottedCurve]) -> tuple[str, ...]:
    for curve in curves:
        if curve.trajectory.names:
            return curve.trajectory.names
    count = max((curve.trajectory.positions.shape[1] for curve in curves), default=0)
    return tuple(f"joint_{i + 1}" for i in range(count))


def _column(curve: PlottedCurve, name: str, index: int) -> Array | None:
    """The values of a joint in a curve; None when it does not have it."""
    trajectory = curve.trajectory
    if trajectory.names:
        if name not in trajectory.names:
            return None
        index = trajectory.names.index(name)
    if not len(trajectory) or index >= trajectory.positions.shape[1]:
        return None
    column: Array = trajectory.positions[:, index]
    return column


_Units = Mapping[str, tuple[str, float]]
"""What is not in degrees: unit and factor by name."""


def _unit(name: str, units: _Units) -> tuple[str, float]:
    return units.get(name, ("deg", 180.0 / math.pi))


def _layout(curves: Sequence[PlottedCurve], title: str, units: _Units) -> _Scene:
    names = _joints(curves)
    columns = 1 if len(names) <= 1 else 2
    rows = max(1, -(-len(names) // columns))
    width = columns * _WIDTH
    height = _HEAD + rows * (_PANEL + _GAP)
    lines: list[_Line] = []
    texts = [_Text(_LEFT, 24, title, size=16)]
    x = float(_LEFT)
    for index, curve in enumerate(curves):
        colour = COLOURS[index % len(COLOURS)]
        lines.append(_Line(np.array([[x, 44.0], [x + 24, 44.0]]), colour, 2.0))
        texts.append(_Text(x + 30, 48, curve.label))
        x += 60 + 7.5 * len(curve.label)
    panels = []
    end = max((c.trajectory.duration for c in curves if len(c.trajectory)), default=1.0) or 1.0
    for index, name in enumerate(names):
        unit, factor = _unit(name, units)
        drawn = [
            (i, curve.trajectory.times, column * factor)
            for i, curve in enumerate(curves)
            if (column := _column(curve, name, index)) is not None
        ]
        panel = _Panel(
            name,
            unit,
            (index % columns) * _WIDTH + _LEFT,
            _HEAD + (index // columns) * (_PANEL + _GAP) + _TOP,
            _WIDTH - _LEFT - _RIGHT,
            _PANEL - _TOP - _BOTTOM + _GAP,
            (0.0, end),
            _range([values for _, _, values in drawn]),
        )
        panels.append(panel)
        grid, labels = _axes(panel)
        lines += grid
        texts += labels
        for number, times, values in drawn:
            thin_times, thin_values = _thin(times, values)
            finite = np.isfinite(thin_values) & np.isfinite(thin_times)
            points = panel.at(thin_times[finite], thin_values[finite])
            # Later curves are thinner, so that they do not hide the earlier ones.
            stroke = 2.6 if number == 0 and len(curves) > 1 else 1.4
            lines.append(_Line(points, COLOURS[number % len(COLOURS)], stroke))
    return _Scene(width, height, tuple(lines), tuple(texts), tuple(panels))


def _range(columns: Sequence[Array]) -> tuple[float, float]:
    values = np.concatenate(columns) if columns else np.zeros(1)
    values = values[np.isfinite(values)]
    if not len(values):
        return -1.0, 1.0
    low, high = float(values.min()), float(values.max())
    # A joint that stands is a straight line, not an enlarged noise.
    margin = max(0.06 * (high - low), 0.5 - (high - low) / 2)
    return low - margin, high + margin


def _ticks(low: float, high: float, wanted: int) -> list[float]:
    rough = (high - low) / wanted
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(m * power for m in (1, 2, 5, 10) if m * power >= rough * (1 - 1e-9))
    first = math.ceil(low / step - 1e-9)
    last = math.floor(high / step + 1e-9)
    return [n * step for n in range(first, last + 1)]


def _heading(panel: _Panel) -> str:
    return f"{panel.name} [{panel.unit}]" if panel.unit else panel.name


def _axes(panel: _Panel) -> tuple[list[_Line], list[_Text]]:
    lines, texts = [], [_Text(panel.x, panel.y - 8, _heading(panel), size=13)]
    for value in _ticks(*panel.values, 4):
        row = panel.at(np.array(panel.times), np.array([value, value]))
        lines.append(_Line(row, _GRID, 1.0))
        texts.append(_Text(panel.x - 6, float(row[0, 1]) + 4, f"{value:g}", "end", colour=_GREY))
    bottom = panel.y + panel.height
    for time in _ticks(*panel.times, 6):
        x = float(panel.at(np.array([time]), np.array([panel.values[0]]))[0, 0])
        lines.append(_Line(np.array([[x, panel.y], [x, bottom]]), _GRID, 1.0))
        texts.append(_Text(x, bottom + 15, f"{time:g} s", "middle", 11, _GREY))
    box = [
        [panel.x, panel.y],
        [panel.x + panel.width, panel.y],
        [panel.x + panel.width, bottom],
        [panel.x, bottom],
        [panel.x, panel.y],
    ]
    lines.append(_Line(np.array(box, dtype=np.float64), _GREY, 1.0))
    return lines, texts


def _thin(times: Array, values: Array) -> tuple[Array, Array]:
    """At most _MOST points that draw the same curve: extremes survive."""
    if len(times) <= _MOST:
        return times, values
    keep = {0, len(times) - 1}
    edges = np.linspace(0, len(times), _MOST // 2 + 1).astype(int)
    for start, end in zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True):
        piece = values[start:end]
        keep.add(start + int(np.argmin(piece)))
        keep.add(start + int(np.argmax(piece)))
    chosen = np.array(sorted(keep))
    return times[chosen], values[chosen]


def _draw_png(scene: _Scene, path: Path) -> None:
    from PIL import Image, ImageDraw, ImageFont

    scale = 2
    image = Image.new("RGB", (scene.width * scale, scene.height * scale), "white")
    draw = ImageDraw.Draw(image)
    for line in scene.lines:
        points = [(x * scale, y * scale) for x, y in line.points.tolist()]
        if len(points) > 1:
            draw.line(points, fill=line.colour, width=round(line.width * scale), joint="curve")
    anchors = {"start": "ls", "middle": "ms", "end": "rs"}
    for text in scene.texts:
        font = ImageFont.load_default(text.size * scale)
        place = (text.x * scale, text.y * scale)
        draw.text(place, text.text, fill=text.colour, font=font, anchor=anchors[text.anchor])
    drawn = io.BytesIO()
    image.resize((scene.width, scene.height), Image.Resampling.LANCZOS).save(drawn, "PNG")
    write_whole(path, drawn.getvalue())


def _svg(scene: _Scene) -> str:
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {scene.width} {scene.height}" '
        f'width="{scene.width}" font-family="sans-serif">'
    ]
    for line in scene.lines:
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in line.points.tolist())
        parts.append(
            f'<polyline points="{points}" fill="none" stroke="{line.colour}" '
            f'stroke-width="{line.width:g}" stroke-linejoin="round"/>'
        )
    for text in scene.texts:
        parts.append(
            f'<text x="{text.x:.1f}" y="{text.y:.1f}" font-size="{text.size}" '
            f'fill="{text.colour}" text-anchor="{text.anchor}">{escape(text.text)}</text>'
        )
    parts.append('<line id="cursor" stroke="#000" stroke-width="0.6" y1="0" y2="0"/></svg>')
    return "\n".join(parts)


# Shows the values of all curves at the pointer's time.
_SCRIPT = """
const svg = document.querySelector("svg"), cursor = document.getElementById("cursor");
const out = document.getElementById("readout");
svg.addEventListener("pointermove", event => {
  const at = new DOMPoint(event.clientX, event.clientY)
    .matrixTransform(svg.getScreenCTM().inverse());
  const panel = data.panels.find(p => at.x >= p.x && at.x <= p.x + p.width
    && at.y >= p.y && at.y <= p.y + p.height);
  if (!panel) { return; }
  const time = panel.t0 + (at.x - panel.x) / panel.width * (panel.t1 - panel.t0);
  for (const [name, value] of [["x1", at.x], ["x2", at.x], ["y1", panel.y],
    ["y2", panel.y + panel.height]]) { cursor.setAttribute(name, value); }
  const found = panel.curves.map(curve => {
    let i = curve.times.findIndex(t => t >= time);
    if (i < 0) { i = curve.times.length - 1; }
    const a = Math.max(0, i - 1), step = curve.times[i] - curve.times[a];
    const share = step > 0 ? Math.min(1, Math.max(0, (time - curve.times[a]) / step)) : 0;
    const value = curve.values[a] + share * (curve.values[i] - curve.values[a]);
    return `${curve.label} ${value.toFixed(3)} ${panel.unit}`;
  });
  out.textContent = `${panel.name} at ${time.toFixed(3)} s: ${found.join(", ")}`;
});
"""


def _html(scene: _Scene, curves: Sequence[PlottedCurve], title: str, units: _Units) -> str:
    panels: list[dict[str, Any]] = []
    for index, panel in enumerate(scene.panels):
        drawn = []
        for curve in curves:
            column = _column(curve, panel.name, index)
            if column is None:
                continue
            times, values = _thin(curve.trajectory.times, column * _unit(panel.name, units)[1])
            finite = np.isfinite(values) & np.isfinite(times)
            drawn.append(
                {
                    "label": curve.label,
                    "times": np.round(times[finite], 4).tolist(),
                    "values": np.round(values[finite], 4).tolist(),
                }
            )
        panels.append(
            {
                "name": panel.name,
                "unit": panel.unit,
                "x": panel.x,
                "y": panel.y,
                "width": panel.width,
                "height": panel.height,
                "t0": panel.times[0],
                "t1": panel.times[1],
                "curves": drawn,
            }
        )
    # A name may hold "</script>".
    data = json.dumps({"panels": panels}).replace("<", "\\u003c")
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        f"<title>{escape(title)}</title>"
        "<style>body{margin:1rem;font-family:sans-serif}svg{max-width:100%;height:auto}"
        "#readout{min-height:1.4em}</style></head><body>\n"
        f'{_svg(scene)}\n<p id="readout">Point at a curve to read its values.</p>\n'
        f"<script>const data = {data};{_SCRIPT}</script>\n</body></html>\n"
    )
