"""Check of a path in a world: findings for users, clearances over time.

The three results of the proof stay apart: RG820 a contact, RG821 too near, RG822 not proved.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from rapidgen.collision.path import Path
from rapidgen.collision.proof import Proof, Violation, prove
from rapidgen.collision.scene import Scene
from rapidgen.collision.shapes import Array, Indices
from rapidgen.collision.timing import ShiftViolation, Timing, Together, prove_timing
from rapidgen.collision.world import World
from rapidgen.diagnostics import Diagnostic, Severity, Span, error

LIMIT = 0.1
"""m: clearances above are not computed."""
_SAMPLES = 1000
"""Postures of a path at which depths and clearances are computed."""
_CHUNK = 128
_MOST = 20
"""Findings of one check, the earliest ones."""
_CODES = {"contact": "RG820", "too near": "RG821", "not proved": "RG822"}
Point: TypeAlias = tuple[float, float, float]
PlaceOf = Callable[[float], tuple[str, Span | None]]
"""Text and place in a file of a position on the path."""


@dataclass(frozen=True, eq=False)
class Clearances:
    """Distances of pairs over time: `distances` (n, p) in m at `times` (n,) s.

    Infinite: more than `limit`. Samples only; proofs are in `CollisionReport.proof`.
    """

    scene: Scene
    times: Array
    distances: Array
    limit: float = LIMIT

    @property
    def least(self) -> float:
        """Return the least distance; infinite above the limit."""
        return float(self.distances.min(initial=np.inf))

    def curve(self) -> Array:
        """Return the least distance (n,) at each time."""
        result: Array = self.distances.min(axis=1, initial=np.inf)
        return result

    def by_pair(self) -> list[tuple[str, str, float, float]]:
        """Return (body, body, least distance, its time) of pairs within the limit, nearest first.

        Distances in m, times in s.
        """
        result = []
        for number in range(self.distances.shape[1]):
            row = int(self.distances[:, number].argmin())
            far = float(self.distances[row, number])
            if np.isfinite(far):
                result.append((*self.scene.names(number), far, float(self.times[row])))
        return sorted(result, key=lambda one: one[2])

    def between(self, one: str, other: str) -> float:
        """Return the least distance of two bodies; infinite above the limit.

        Raises KeyError if the pair is not checked.
        """
        for number in range(self.distances.shape[1]):
            if set(self.scene.names(number)) == {one, other}:
                return float(self.distances[:, number].min())
        raise KeyError(f"no pair {one} - {other}")


@dataclass(frozen=True, eq=False)
class Stage:
    """A part of a path in one world: a grip or a release begins the next stage.

    All stages of a check have the same bodies and pairs, in the same order.
    """

    world: World
    path: Path
    proof: Proof


@dataclass(frozen=True, eq=False)
class CollisionReport:
    """Result of a check: findings, and what was not checked."""

    stages: tuple[Stage, ...]
    diagnostics: tuple[Diagnostic, ...]
    timings: tuple[Timing, ...] = ()
    """Of each two robots that move, unless they keep one clock."""

    @property
    def world(self) -> World:
        """Return the world at the end of the path."""
        return self.stages[-1].world

    @property
    def is_free(self) -> bool:
        """True if all checked pairs keep their clearances, which is proved."""
        free = all(stage.proof.is_free for stage in self.stages)
        return free and not any(timing.violations for timing in self.timings)

    @property
    def postures(self) -> int:
        """Return the number of postures of the proofs."""
        return sum(stage.proof.postures for stage in self.stages)

    def clearances(self, samples: int = _SAMPLES) -> Clearances:
        """Return distances at evenly spaced times."""
        return stage_clearances([(stage.world, stage.path) for stage in self.stages], samples)

    def as_json(self) -> list[Mapping[str, object]]:
        """Return the violations as data: m, s; names, point, verdict; normal or times.

        A violation with a time shift has `times`, one for each body, instead of the normal.
        """
        scene = self.world.scene
        shifted: list[Mapping[str, object]] = [
            {
                "verdict": v.verdict,
                "time": min(v.times),
                "times": list(v.times),
                "bodies": list(scene.names(v.pair)),
                "distance": v.distance,
                "point": list(v.point),
                "clearance": scene.pairs[v.pair].clearance,
            }
            for timing in self.timings
            for v in timing.violations
        ]
        found: list[Mapping[str, object]] = [
            {
                "verdict": v.verdict,
                "time": v.time,
                "bodies": list(stage.world.scene.names(v.pair)),
                "distance": v.distance,
                "point": list(v.point),
                "normal": list(v.normal),
                "clearance": stage.world.scene.pairs[v.pair].clearance,
            }
            for stage in self.stages
            for v in stage.proof.violations
        ]
        return found + shifted


def check_path(
    world: World,
    path: Path,
    place_of: PlaceOf | None = None,
    severity: Severity = Severity.ERROR,
    together: Sequence[Together] = (),
) -> CollisionReport:
    """Prove a path and describe each violation; two robots also with a time shift (RG845, RG846).

    `together` are intervals in which robots share a clock. Raises ModuleNotFoundError for hulls and
    cylinders without coal.
    """
    return check_stages([(world, path, place_of)], severity, together)


def check_stages(
    stages: Sequence[tuple[World, Path, PlaceOf | None]],
    severity: Severity = Severity.ERROR,
    together: Sequence[Together] = (),
) -> CollisionReport:
    """Prove the stages of a path, and describe each violation: see `check_path`.

    Time shifts of two robots are proved within each stage.
    """
    proofs: list[Stage] = []
    found: list[Diagnostic] = []
    for world, path, place_of in stages:
        proof = prove(path, world.scene)
        proofs.append(Stage(world, path, proof))
        found += [
            _finding(world, path, violation, place_of, severity)
            for violation in proof.violations[: max(0, _MOST - len(found))]
        ]
    left = sum(len(stage.proof.violations) for stage in proofs) - len(found)
    if left > 0:
        found[-1] = error(
            found[-1].code,
            found[-1].span,
            found[-1].message,
            found[-1].help,
            notes=(*found[-1].notes, f"and {left} further pairs"),
            severity=severity,
        )
    timings: list[Timing] = []
    for stage, (world, path, place_of) in zip(proofs, stages, strict=True):
        if len(world.columns) < 2 or world.time_tolerance == 0:
            continue
        known = frozenset(violation.pair for violation in stage.proof.violations)
        own = prove_timing(path, world.scene, world.columns, world.time_tolerance, together, known)
        for timing in own:
            found += [
                _shift_finding(world, path, v, timing, place_of, severity)
                for v in timing.violations[:_MOST]
            ]
        timings += own
    return CollisionReport(tuple(proofs), tuple(found), tuple(timings))


def _shift_finding(
    world: World,
    path: Path,
    v: ShiftViolation,
    timing: Timing,
    place_of: PlaceOf | None,
    severity: Severity,
) -> Diagnostic:
    """Describe a violation of two robots at two times (RG845, RG846)."""
    one, other = world.scene.names(v.pair)
    first, second = v.times
    x, y, z = (1000 * value for value in v.point)
    where = f"at ({x:.0f}, {y:.0f}, {z:.0f}) mm"
    clearance = f"{1000 * world.scene.pairs[v.pair].clearance:.1f} mm"
    at, then = f"{one} at {first:.3f} s", f"{other} at {second:.3f} s"
    if v.verdict == "contact":
        message = f"{at} touches {then} {where}"
    elif v.verdict == "too near":
        message = (
            f"{at} is {1000 * v.distance:.1f} mm from {then} {where}; the clearance is {clearance}"
        )
    else:
        message = (
            f"the clearance of {clearance} between {at} and {then} is not proved {where}: "
            f"{1000 * v.distance:.2f} mm"
        )
    notes = [f"proved for time shifts up to {timing.proved:.2f} s of {timing.tolerance:.2f} s"]
    span = None
    if place_of is not None:
        for time in v.times:
            text, place = place_of(path.position(time))
            span = span or place
            notes += [f"at {time:.3f} s: {text}"] if text else []
    return error(
        "RG846" if v.verdict == "not proved" else "RG845",
        span,
        message,
        "synchronise the robots there (SyncMoveOn), or set `collision: {time_tolerance: S}` to the "
        "shift that signals or WaitSyncTask guarantee",
        notes=tuple(notes),
        severity=severity,
    )


def _finding(
    world: World, path: Path, v: Violation, place_of: PlaceOf | None, severity: Severity
) -> Diagnostic:
    one, other = world.scene.names(v.pair)
    place, span = place_of(v.position) if place_of is not None else ("", None)
    at = f"at {v.time:.3f} s" + (f", {place}" if place else "")
    x, y, z = (1000 * value for value in v.point)
    where = f"at ({x:.0f}, {y:.0f}, {z:.0f}) mm"
    clearance = 1000 * world.scene.pairs[v.pair].clearance
    notes = _shapes(world.scene, v)
    if v.verdict == "contact":
        depth, when = _deepest(world.scene, path, v)
        message = f"{one} touches {other} {at} {where}, up to {1000 * depth:.1f} mm deep"
        notes = (f"deepest at {when:.3f} s", *notes)
        help = "move the path or the object"
    elif v.verdict == "too near":
        message = (
            f"{one} is {1000 * v.distance:.1f} mm from {other} {at} {where}; "
            f"the clearance is {clearance:.1f} mm"
        )
        help = f"move the path, or set collision: {{pairs: {{{one} - {other}: MM}}}}"
    else:
        message = (
            f"the clearance of {clearance:.1f} mm between {one} and {other} is not proved {at} "
            f"{where}: {1000 * v.distance:.2f} mm"
        )
        help = "treat it as too near: move the path, or lower the clearance of this pair"
    return error(_CODES[v.verdict], span, message, help, notes=notes, severity=severity)


def _shapes(scene: Scene, v: Violation) -> tuple[str, ...]:
    """Name the shapes if a body has several, and their mesh files."""
    texts = []
    for index in v.shapes:
        shape = scene.table.shapes[index]
        body = scene.bodies[scene.body_of[index]]
        number = f" {index - scene.shapes_of[scene.body_of[index]].start + 1}"
        several = number if len(body.shapes) > 1 else ""
        source = f" of {shape.source}" if shape.source else ""
        if several or source:
            texts.append(f"{body.name}: {shape.kind}{several}{source}")
    return tuple(texts)


def _deepest(scene: Scene, path: Path, v: Violation) -> tuple[float, float]:
    """Return the largest depth of a pair at samples of the path after the contact, and its time."""
    u = np.linspace(v.position, path.last, _SAMPLES)
    far = scene.body_distances(path.at(u), [v.pair])[:, 0]
    row = int(far.argmin())
    return max(0.0, -float(far[row])), path.time(float(u[row]))


def clearances(scene: Scene, path: Path, times: Array, limit: float = LIMIT) -> Clearances:
    """Return the distances of all checked pairs at times (n,), up to `limit` m."""
    result = np.full((len(times), len(scene.pairs)), np.inf)
    u = np.interp(times, path.times, np.arange(path.last + 1))
    count = len(scene.first)
    for low in range(0, len(u) if count else 0, _CHUNK):
        rows = u[low : low + _CHUNK]
        postures, pairs, far, _ = _near(scene, path.at(rows), limit)
        np.minimum.at(result, (postures + low, scene.pair_of[pairs]), far)
    result[result > limit] = np.inf
    return Clearances(scene, times, result, limit)


def stage_clearances(stages: Sequence[tuple[World, Path]], samples: int) -> Clearances:
    """Return the distances along the stages of a path at `samples` evenly spaced times."""
    first, last = stages[0][1].times[0], stages[-1][1].times[-1]
    times = np.linspace(first, last, samples)
    parts = []
    for number, (world, path) in enumerate(stages):
        is_last = number == len(stages) - 1
        end = np.inf if is_last else path.times[-1]
        own = times[(times >= path.times[0]) & (times < end)]
        parts.append(clearances(world.scene, path, own))
    return Clearances(
        stages[-1][0].scene,
        np.concatenate([part.times for part in parts]),
        np.concatenate([part.distances for part in parts]),
    )


def _near(
    scene: Scene, values: Array, limit: float
) -> tuple[Indices, Indices, Array, tuple[Array, Array]]:
    """Return postures, pairs of shapes, distances and nearest points of pairs within a limit.

    Bounding spheres leave out most others; the rest is not left out.
    """
    places = scene.places(*scene.tree.poses(values)[:2])
    count = len(scene.first)
    postures = np.repeat(np.arange(len(values)), count)
    pairs = np.tile(np.arange(count), len(values))
    is_near = scene.sphere_gaps(pairs, postures, *places) <= limit
    near = np.flatnonzero(is_near & (scene.clearance[pairs] > -np.inf))
    postures, pairs = postures[near], pairs[near]
    far, first, second = scene.distances(pairs, postures, *places)
    return postures, pairs, far, (first, second)


def near_pairs(scene: Scene, values: Array, limit: float) -> list[tuple[int, float, Point, Point]]:
    """Return (pair, distance, point, point) of checked pairs within `limit` m, nearest first.

    `values` is one posture (1, columns). The points are the nearest ones of the first and the
    second body of the pair, in the world.
    """
    _, pairs, far, points = _near(scene, values, limit)
    best: dict[int, tuple[int, float, Point, Point]] = {}
    for row, pair in enumerate(pairs.tolist()):
        number, distance = int(scene.pair_of[pair]), float(far[row])
        if distance > limit or (number in best and best[number][1] <= distance):
            continue
        (a, b, c), (x, y, z) = points[0][row].tolist(), points[1][row].tolist()
        one, other = (a, b, c), (x, y, z)
        if scene.body_of[scene.first[pair]] != scene.pairs[number].first:
            one, other = other, one
        best[number] = (number, distance, one, other)
    return sorted(best.values(), key=lambda found: found[1])
