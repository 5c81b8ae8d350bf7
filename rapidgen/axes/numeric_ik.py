"""Inverse kinematics by iteration, for arms without a closed form (numpy).

Rules:

- Near a start: Newton's method on the six equations of a pose (three of position, three of a
  rotation vector).
- Far from it: many starts at once, by damped least squares. First come those of some thousand
  random postures of the arm whose poses are closest, then more of them, then postures all over the
  ranges.
- A round limits the step of each joint, so that it does not leave the branch of its start.
- Values are the controller's, of the arm's own axes. The chain's joints are linear in them, which
  covers signs, offsets and the coupling of axis 3.
- The random postures have a fixed seed: the same pose and start give the same result.
- More than six values (a seventh axis) leave a free direction. The caller fixes it by the arm
  angle.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from rapidgen.axes import frames
from rapidgen.axes.frames import Axis, Pose, Vector, multiply, subtract

Floats: TypeAlias = NDArray[np.float64]
Values = tuple[float, ...]
_ROUNDS, _HOPELESS, _FAR = 60, 10, 1e-3
"""Rounds of Newton's method: it is slow near singularities, elsewhere ten are enough."""
_EXACT = 1e-10
"""m and rad of a solution"""
_LARGEST = 0.6
"""rad (or m) that a joint may move in one round."""
_HOPEFUL = 300
_SINGLY = 6
"""Starts that are tried one after the other: usually one of them converges."""
_STARTS = (24, 96, 400, 1600, 3800)
_TOGETHER_ROUNDS = 40
_CLOSE = 1e-5
_SAMPLES = 6000
_DAMPING = 1e-8


def solved(normal: Floats, right: Floats) -> Floats:
    """Return the step of damped Newton.

    If the damping is too small for a singular arm, the shortest step.
    """
    try:
        return np.asarray(np.linalg.solve(normal, right), dtype=np.float64)
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.pinv(normal) @ right, dtype=np.float64)


@dataclass(frozen=True)
class Link:
    """A step of the chain: its fixed part, then the motion by the arm's values."""

    fixed: Pose
    axis: Vector
    slides: bool
    weights: Values
    """For each value of the arm; the joint moves by their weighted sum."""
    constant: float


@dataclass(frozen=True)
class Search:
    """Search for postures of one arm, in the frame of its chain.

    `ranges` are those of the values, rad or m; `around` holds external axes of the arm, which a
    search does not change, at the end of the values.
    """

    links: tuple[Link, ...]
    ranges: tuple[tuple[float, float], ...]
    turning: tuple[bool, ...]
    free: int
    """Number of values, from the first, that a search may change: six or fewer."""

    # -- one posture ------------------------------------------------------------------------

    def pose(self, values: Sequence[float]) -> Pose:
        """Return the flange."""
        return self.lines(values)[0]

    def lines(self, values: Sequence[float]) -> tuple[Pose, list[Axis]]:
        """Return the flange, and position and direction of each moving axis."""
        place: Vector = (0.0, 0.0, 0.0)
        q = frames.UNIT
        result = []
        for link in self.links:
            (x, y, z), turned = link.fixed
            if x or y or z:
                place = frames.add(place, frames.rotate(q, link.fixed[0]))
            if turned != frames.UNIT:
                q = multiply(q, turned)
            if not link.weights:
                continue
            amount = link.constant
            for value, weight in zip(values, link.weights, strict=True):
                if weight:
                    amount += value * weight
            direction = frames.rotate(q, link.axis)
            result.append((place, direction))
            if link.slides:
                place = frames.add(place, frames.scale(direction, amount))
            else:
                q = multiply(q, frames.about(link.axis, amount))
        return (place, q), result

    def near(self, pose: Pose, start: Sequence[float]) -> Values | None:
        """Return values for a pose on the branch of a start, or None.

        None: Newton does not converge.
        """
        values = list(start)
        last = 1e9
        for rounds in range(_ROUNDS):
            flange, axes = self.lines(values)
            error = frames.error(flange, pose)
            size = max(map(abs, error))
            if size < _EXACT:
                return tuple(values)
            if size > 4 * last or (rounds > _HOPELESS and size > _FAR):
                return None
            last = size
            jacobian = self.by_value(self.columns(flange, axes), self.free)
            normal = jacobian.T @ jacobian
            normal.flat[:: self.free + 1] += _DAMPING * size
            step = solved(normal, jacobian.T @ np.array(error))
            longest = float(np.max(np.abs(step)))
            fraction = _LARGEST / longest if longest > _LARGEST else 1.0
            for n in range(self.free):
                values[n] += fraction * float(step[n])
        return tuple(values) if last < 100 * _EXACT else None

    def columns(self, flange: Pose, axes: Sequence[Axis]) -> list[tuple[float, ...]]:
        """Return the flange's derivatives by each moving joint, from `lines`."""
        result: list[tuple[float, ...]] = []
        for link, (at, direction) in zip(self._moving, axes, strict=True):
            if link.slides:
                result.append((*direction, 0.0, 0.0, 0.0))
            else:
                across = frames.cross(direction, subtract(flange[0], at))
                result.append((*across, *direction))
        return result

    def by_value(self, columns: Sequence[Sequence[float]], count: int) -> Floats:
        """Return derivatives by the first values, from those by joints."""
        rows = [[0.0] * count for _ in columns[0]]
        for link, column in zip(self._moving, columns, strict=True):
            for n in range(count):
                weight = link.weights[n]
                if weight:
                    for row, part in zip(rows, column, strict=True):
                        row[n] += weight * part
        return np.array(rows)

    @cached_property
    def _moving(self) -> list[Link]:
        return [link for link in self.links if link.weights]

    # -- many at once -----------------------------------------------------------------------

    def rounds(self, pose: Pose, start: Sequence[float]) -> Iterator[Iterator[Values]]:
        """Yield postures for a pose in rounds, those near the start first.

        Fixed values are the last values of the start. A pose that none of some hundred starts has
        reached is out of reach.
        """
        arrived = [0]

        def report(result: Values | None) -> Iterator[Values]:
            if result is not None:
                arrived[0] += 1
                yield result

        order = self._closest(pose, start)
        singly = self._samples[0][order[:_SINGLY]]

        def one_by_one() -> Iterator[Values]:
            yield from report(self.near(pose, start))
            for row in singly.tolist():
                yield from report(self.near(pose, (*row[: self.free], *start[self.free :])))

        def together(values: Floats) -> Iterator[Values]:
            values[:, self.free :] = start[self.free :]
            for row in self._together(pose, values):
                yield from report(self.near(pose, tuple(row)))

        yield one_by_one()
        begin = _SINGLY
        for count in _STARTS:
            if begin > _HOPEFUL and not arrived[0]:
                return
            yield together(self._samples[0][order[begin : begin + count]].copy())
            begin += count

    def closest(self, pose: Pose, count: int) -> list[Values]:
        """Return random postures, those with the closest poses first."""
        values, places, turns = self._samples
        away = np.linalg.norm(places - np.array(pose[0]), axis=1) / self._reach
        away += 1 - np.abs(turns @ np.array(pose[1]))
        return [tuple(row) for row in values[np.argsort(away)[:count]].tolist()]

    def _closest(self, pose: Pose, start: Sequence[float]) -> NDArray[np.intp]:
        values, places, turns = self._samples
        away = np.linalg.norm(places - np.array(pose[0]), axis=1) / self._reach
        dots = np.abs(turns @ np.array(pose[1]))
        away += np.sqrt(np.maximum(0.0, 2 - 2 * np.minimum(dots, 1.0)))
        for n in range(self.free, len(start)):
            away += 0.5 * np.abs(values[:, n] - start[n])
        most = sum(_STARTS) + _SINGLY
        if most >= len(away):
            return np.argsort(away)
        nearest = np.argpartition(away, most)[:most]
        return nearest[np.argsort(away[nearest])]

    @cached_property
    def _reach(self) -> float:
        return max(0.1, float(np.max(np.linalg.norm(self._samples[1], axis=1))) / 2)

    @cached_property
    def _samples(self) -> tuple[Floats, Floats, Floats]:
        """Return random postures with their positions and orientations."""
        draw = np.random.default_rng(1).random((_SAMPLES, len(self.ranges)))
        low, high = np.array(self.ranges).T
        values = low + draw * (high - low)
        rotations, places, _ = self._forward(values)
        return values, places, _quaternions(rotations)

    def _forward(self, values: Floats) -> tuple[Floats, Floats, list[tuple[Floats, Floats, Link]]]:
        """Return flange rotations and positions, and the moving axes."""
        count = len(values)
        rotation = np.broadcast_to(np.eye(3), (count, 3, 3))
        place = np.zeros((count, 3))
        axes = []
        for link in self.links:
            place = place + rotation @ np.array(link.fixed[0])
            rotation = rotation @ np.array(frames.to_matrix(link.fixed[1]))
            if not link.weights:
                continue
            amount = values @ np.array(link.weights) + link.constant
            direction = rotation @ np.array(link.axis)
            axes.append((place, direction, link))
            if link.slides:
                place = place + direction * amount[:, None]
            else:
                x, y, z = link.axis
                skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
                rotation = rotation @ (
                    np.eye(3)
                    + np.sin(amount)[:, None, None] * skew
                    + (1 - np.cos(amount))[:, None, None] * (skew @ skew)
                )
        return rotation, place, axes

    def _together(self, pose: Pose, values: Floats) -> Iterator[Floats]:
        """Yield converged values of many starts, each once, fastest first.

        Damped least squares.
        """
        goal = np.array(frames.to_matrix(pose[1]))
        target = np.array(pose[0])
        # A pose on axis 1 has infinitely many postures: thousands of starts may converge.
        seen, count = np.empty_like(values), 0
        for _ in range(_TOGETHER_ROUNDS):
            rotation, place, axes = self._forward(values)
            error = np.empty((len(values), 6))
            error[:, :3] = target - place
            error[:, 3:] = _rotation_vectors(goal @ rotation.transpose(0, 2, 1))
            size = np.max(np.abs(error), axis=1)
            for row in values[size < _CLOSE]:
                apart = np.abs(_wrapped(row - seen[:count], self.turning))
                if np.all(np.max(apart, axis=1) > 1e-4):
                    seen[count] = row
                    count += 1
                    yield row
            left = size >= _CLOSE
            if not left.any():
                return
            jacobian = np.zeros((len(values), 6, self.free))
            for at, direction, link in axes:
                column = np.zeros((len(values), 6))
                if link.slides:
                    column[:, :3] = direction
                else:
                    column[:, :3] = np.cross(direction, place - at)
                    column[:, 3:] = direction
                for n in range(self.free):
                    if link.weights[n]:
                        jacobian[:, :, n] += link.weights[n] * column
            values, error, jacobian = values[left], error[left], jacobian[left]
            transposed = jacobian.transpose(0, 2, 1)
            normal = transposed @ jacobian
            # Sugihara's damping: the square of the error itself.
            damping = 0.5 * np.sum(error**2, axis=1) * 0.02 + _DAMPING
            normal += damping[:, None, None] * np.eye(self.free)
            step = solved(normal, (transposed @ error[:, :, None]))[:, :, 0]
            longest = np.max(np.abs(step), axis=1)
            step *= np.minimum(1.0, _LARGEST / np.maximum(longest, 1e-12))[:, None]
            values = values.copy()
            values[:, : self.free] += step


def _wrapped(difference: Floats, turning: Sequence[bool]) -> Floats:
    turn = 2 * np.pi
    return np.where(turning, difference - turn * np.round(difference / turn), difference)


def _rotation_vectors(rotations: Floats) -> Floats:
    """Return axis times angle of rotation matrices, also near half a turn."""
    turns = _quaternions(rotations)
    parts = turns[:, 1:]
    sizes = np.linalg.norm(parts, axis=1)
    angles = 2 * np.arctan2(sizes, turns[:, 0])
    return parts * np.where(sizes > 1e-12, angles / np.maximum(sizes, 1e-12), 2.0)[:, None]


def _quaternions(rotations: Floats) -> Floats:
    """Return unit quaternions, scalar first and not negative (Shepperd)."""
    m = rotations
    trace = m[:, 0, 0] + m[:, 1, 1] + m[:, 2, 2]
    squares = np.stack(
        [
            1 + trace,
            1 + 2 * m[:, 0, 0] - trace,
            1 + 2 * m[:, 1, 1] - trace,
            1 + 2 * m[:, 2, 2] - trace,
        ],
        axis=1,
    )
    largest = np.argmax(squares, axis=1)
    a, b, c = m[:, 2, 1] - m[:, 1, 2], m[:, 0, 2] - m[:, 2, 0], m[:, 1, 0] - m[:, 0, 1]
    d, e, f = m[:, 1, 0] + m[:, 0, 1], m[:, 0, 2] + m[:, 2, 0], m[:, 2, 1] + m[:, 1, 2]
    s = squares
    choices = np.stack(
        [
            np.stack([s[:, 0], a, b, c], axis=1),
            np.stack([a, s[:, 1], d, e], axis=1),
            np.stack([b, d, s[:, 2], f], axis=1),
            np.stack([c, e, f, s[:, 3]], axis=1),
        ],
        axis=1,
    )
    result = choices[np.arange(len(m)), largest]
    result = result / np.linalg.norm(result, axis=1)[:, None]
    made: Floats = np.where(result[:, :1] < 0, -result, result)
    return made


def linear(
    to_urdf: Callable[[Sequence[float]], Values], at: Sequence[float], places: Sequence[int]
) -> tuple[list[Values], Values]:
    """Return URDF values as linear functions of the controller's.

    Weights of the values at `places` for each joint, and constants.
    """
    zero = [0.0 if n in places else value for n, value in enumerate(at)]
    constant = to_urdf(zero)
    columns = []
    for place in places:
        moved = list(zero)
        moved[place] = 1.0
        columns.append([a - b for a, b in zip(to_urdf(moved), constant, strict=True)])
    return [tuple(column[n] for column in columns) for n in range(len(at))], constant
