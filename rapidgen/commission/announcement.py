"""Words and a drawing of what a small move of one joint looks like at the robot."""

import math
from collections.abc import Sequence

from rapidgen.axes import frames
from rapidgen.axes.chain import Posture
from rapidgen.axes.frames import Vector
from rapidgen.axes.kinematics import MovingFrame
from rapidgen.commission.map_faults import figure
from rapidgen.config.model import GroupConfig

_SIDES = (
    ("forward (+x)", "backward (-x)"),
    ("to the left (+y)", "to the right (-y)"),
    ("up (+z)", "down (-z)"),
)
_VIEWS = ("from the front (+x)", "from the left (+y)", "from above (+z)")
_SMALL = 0.0005
"""m below which a displacement is not seen."""
_EXAGGERATED = 10.0
_SIZE = 260


def move_text(group: GroupConfig, index: int, before: Posture, after: Posture) -> str:
    """Describe a move of one joint: its value, the pendant's value, and what the flange does.

    Postures are controller axis values in wire order. Directions are those of a person who looks
    along +x of the robot's base.
    """
    joint = group.joints[index]
    step = after[index] - before[index]
    amount = figure(joint, abs(step))
    sense = "increases" if step > 0 else "decreases"
    parts = [f"axis {joint.axis} on the pendant {sense} by {amount}"]
    if group.chain:
        parts += _flange(group, before, after)
    return f"{joint.name} moves by {amount} and returns: " + "; ".join(parts)


def _flange(group: GroupConfig, before: Posture, after: Posture) -> list[str]:
    model = MovingFrame.of(group, group.chain)
    (start, q), (end, r) = model.pose(before), model.pose(after)
    way = frames.subtract(end, start)
    parts = []
    seen = [
        f"{abs(value) * 1000:.0f} mm {_SIDES[k][value < 0]}"
        for k, value in sorted(enumerate(way), key=lambda pair: -abs(pair[1]))
        if abs(value) > max(_SMALL, 0.2 * max(map(abs, way)))
    ]
    if seen:
        parts.append(f"the flange goes {' and '.join(seen)}")
    axis, angle = frames.to_axis(frames.multiply(r, frames.conjugate(q)))
    if angle > 1e-4:
        k = max(range(3), key=lambda i: abs(axis[i]))
        sense = "counter-clockwise" if axis[k] > 0 else "clockwise"
        turn = f"{math.degrees(angle):.1f} deg {sense} seen {_VIEWS[k]}"
        parts.append(f"the flange turns {turn}")
    return parts


def move_drawing(group: GroupConfig, before: Posture, after: Posture) -> str:
    """Return an SVG with the robot from the right and from above, before and after a move.

    The move is drawn ten times as large. Empty without geometry.
    """
    if not group.chain:
        return ""
    larger = tuple(a + _EXAGGERATED * (b - a) for a, b in zip(before, after, strict=True))
    lines = [_points(group, posture) for posture in (before, larger)]
    reach = max(max(map(abs, point)) for line in lines for point in line) or 1.0
    scale = 0.45 * _SIZE / reach
    views = []
    for number, (name, up) in enumerate((("from the right", 2), ("from above", 1))):
        left = number * _SIZE
        # From above, +x points up the page and +y to the left.
        across, height = (0, 2) if up == 2 else (1, 0)
        sign = 1 if up == 2 else -1
        bottom = 0.92 if up == 2 else 0.5
        for line, colour in zip(lines, ("#999999", "#c0392b"), strict=True):
            text = " ".join(
                f"{left + _SIZE / 2 + sign * scale * p[across]:.1f},"
                f"{_SIZE * bottom - scale * p[height]:.1f}"
                for p in line
            )
            views.append(
                f'<polyline points="{text}" fill="none" stroke="{colour}" stroke-width="4"/>'
            )
        views.append(f'<text x="{left + 6}" y="14" font-size="12">{name}</text>')
    size = f'width="{2 * _SIZE}" height="{_SIZE}" viewBox="0 0 {2 * _SIZE} {_SIZE}"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {size}>{"".join(views)}</svg>'


def _points(group: GroupConfig, posture: Posture) -> Sequence[Vector]:
    """Return the origins of all links, m."""
    count = len(group.chain)
    ends = [MovingFrame.of(group, group.chain[:k]).pose(posture)[0] for k in range(1, count + 1)]
    return [(0.0, 0.0, 0.0), *ends]
