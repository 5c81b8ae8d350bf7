"""The pictures of docs/start/robots.md, drawn from the chains of the shipped models.

`python -m tests.docs.robots_picture` draws docs/start/robots.svg again (`make diagrams`): every
model on a grid of 500 mm, its links as bars between the axes, its axes as short thick lines. Arms
stand at 0; those that would look like one line there are bent.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape

from rapidgen.axes import frames
from rapidgen.axes.chain import Step
from rapidgen.axes.frames import Pose, Vector
from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config, shipped_names
from tests.docs.tree import ROOT

PAGE = ROOT / "docs" / "start" / "robots.svg"
CELL, HEAD, COLUMNS = (230, 230), 24, 4
LINK, AXIS, SLIDE, FLANGE, GROUND = "#f28c28", "#3b3f45", "#2f78b7", "#c02f1d", "#d9d9d9"
POSTURES = {
    "irb14000": {"rob_l": (0, -130, 30, 0, 40, 0, 135), "rob_r": (0, -130, 30, 0, 40, 0, -135)},
    "irb14050": {"rob1": (0, -60, 20, 0, 40, 0, 0)},
    "irb910sc": {"rob1": (25, 40, 0, 0)},
}
"""Degrees (mm), in the order of the joints."""
TURN, TILT = math.radians(-62), math.radians(16)


@dataclass(frozen=True)
class Bar:
    """A line on the paper; `depth` grows towards the eye."""

    start: tuple[float, float]
    end: tuple[float, float]
    width: float
    colour: str
    depth: float


def on_paper(point: Vector) -> tuple[float, float, float]:
    """Right, down and towards the eye, of a point in m."""
    x, y, z = point
    right = x * math.cos(TURN + math.pi / 2) + y * math.sin(TURN + math.pi / 2)
    away = -(x * math.cos(TURN) + y * math.sin(TURN))
    return right, -(z * math.cos(TILT)) - away * math.sin(TILT), -away


def chain(own: Kinematics, degrees: tuple[float, ...]) -> Iterator[tuple[Step, Pose]]:
    """Each step of an arm with its frame, before its joint moves."""
    kinds = [joint.kind for joint in own.group.joints]
    controller = tuple(
        v / 1000 if kind == "prismatic" else math.radians(v)
        for v, kind in zip(degrees, kinds, strict=True)
    )
    values, pose = own.map.to_urdf(controller), frames.IDENTITY
    for step in own.steps:
        pose = frames.compose(pose, step.fixed)
        yield step, pose
        amount = values[step.joint] if step.joint >= 0 else 0.0
        amount += sum(values[i] * k for i, k in step.follows)
        if step.prismatic:
            pose = frames.compose(pose, (frames.scale(step.axis, amount), frames.UNIT))
        else:
            pose = frames.compose(pose, (frames.ORIGIN, frames.about(step.axis, amount)))
    yield own.steps[-1], pose


def bars(own: Kinematics, degrees: tuple[float, ...], size: float) -> Iterator[Bar]:
    """An arm of some size (m)."""
    last: Vector = frames.ORIGIN
    poses = list(chain(own, degrees))
    for n, (step, pose) in enumerate(poses):
        here = pose[0]
        if frames.distance(last, here) > 1e-6:
            yield bar(last, here, max(3.0, 9.0 - 0.6 * n), LINK)
            last = here
        if n < len(poses) - 1 and (step.joint >= 0 or step.follows):
            along = frames.scale(frames.rotate(pose[1], step.axis), 0.035 * size)
            colour = SLIDE if step.prismatic else AXIS
            yield bar(frames.subtract(here, along), frames.add(here, along), 7.0, colour, 0.01)
    pose = poses[-1][1]
    for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)):
        tip = frames.transform(pose, frames.scale(axis, 0.07 * size))
        yield bar(pose[0], tip, 1.6, FLANGE, 0.02)


def bar(start: Vector, end: Vector, width: float, colour: str, nearer: float = 0.0) -> Bar:
    """A line in space on the paper, in m."""
    (x, y, a), (u, v, b) = on_paper(start), on_paper(end)
    return Bar((x, y), (u, v), width, colour, (a + b) / 2 + nearer)


def ground(result: list[Bar]) -> Iterator[Bar]:
    """A grid of 500 mm under what is drawn."""
    reach = max(max(abs(b.start[0]), abs(b.end[0])) for b in result)
    count = max(1, math.ceil(reach / 0.5))
    for n in range(-1, count + 1):
        yield bar((n * 0.5, -0.5, 0.0), (n * 0.5, 0.5, 0.0), 0.8, GROUND, -9.0)
    for y in (-0.5, 0.0, 0.5):
        yield bar((-0.5, y, 0.0), (count * 0.5, y, 0.0), 0.8, GROUND, -9.0)


def model(name: str) -> list[Bar]:
    """All arms of a model on their ground."""
    result: list[Bar] = []
    for group in load_config(name).groups:
        own = Kinematics.of(group)
        assert own is not None
        degrees = POSTURES.get(name, {}).get(group.name, (0.0,) * len(group.joints))
        poses = list(chain(own, degrees))
        size = max(frames.norm(pose[0]) for _, pose in poses)
        result += bars(own, degrees, size)
    return [*ground(result), *sorted(result, key=lambda b: b.depth)]


def fitted(result: list[Bar], left: float, top: float) -> list[Bar]:
    """Lines of a model in the cell of the sheet that begins there."""
    places = [p for b in result for p in (b.start, b.end)]
    low = [min(p[i] for p in places) for i in (0, 1)]
    high = [max(p[i] for p in places) for i in (0, 1)]
    room = (CELL[0] - 30, CELL[1] - HEAD - 30)
    scale = min(room[i] / (high[i] - low[i]) for i in (0, 1))
    shift = [
        start + (CELL[i] - scale * (high[i] + low[i])) / 2
        for i, start in enumerate((left, top + HEAD / 2))
    ]

    def place(p: tuple[float, float]) -> tuple[float, float]:
        return round(p[0] * scale + shift[0], 1), round(p[1] * scale + shift[1], 1)

    return [Bar(place(b.start), place(b.end), b.width, b.colour, b.depth) for b in result]


def sheet() -> Iterator[tuple[str, float, float, list[Bar]]]:
    """Each model with its name, where its cell is, and its lines."""
    for n, name in enumerate(shipped_names()):
        left, top = (n % COLUMNS) * CELL[0], (n // COLUMNS) * CELL[1]
        yield name, left, top, fitted(model(name), left, top)


def draw() -> str:
    """The sheet as SVG."""
    rows = math.ceil(len(shipped_names()) / COLUMNS)
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {COLUMNS * CELL[0]} '
        f'{rows * CELL[1]}" font-family="sans-serif" font-size="14" stroke-linecap="round">',
        '<rect width="100%" height="100%" fill="white"/>',
    ]
    for name, left, top, result in sheet():
        out.append(f'<text x="{left + 12}" y="{top + 20}">{escape(name)}</text>')
        out += [
            f'<path d="M{b.start[0]:g} {b.start[1]:g}L{b.end[0]:g} {b.end[1]:g}" '
            f'stroke="{b.colour}" stroke-width="{b.width:g}"/>'
            for b in result
        ]
    return "\n".join([*out, "</svg>", ""])


if __name__ == "__main__":
    PAGE.write_text(draw(), encoding="utf-8")
