"""Collision check of commanded motions, before a byte is sent.

Nothing imports this module without a cell: NumPy's closed forms are quick to import, coal and the
reading of meshes are not.

The path of a trajectory is that of its points, with the corners that the driver may take: at most
the configured zone, and half of a segment. The path of a program are the samples of its check.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path as FilePath
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rapidgen.client.core.program_checks import CheckedProgram
from rapidgen.client.errors import TargetRejected
from rapidgen.client.program import ZONES
from rapidgen.client.trajectory import Array
from rapidgen.collision import gripping
from rapidgen.collision.boxes import BoxViolation, prove_boxes
from rapidgen.collision.check import CollisionReport, check_path
from rapidgen.collision.gripping import grip_of, with_parts
from rapidgen.collision.path import Path
from rapidgen.collision.scene import Pair, Scene
from rapidgen.collision.world import World, build_world, other_groups, sources_of
from rapidgen.config.cell import load_cell
from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.diagnostics import Diagnostic, Span, error, refusal

if TYPE_CHECKING:
    from rapidgen.client.egm.envelope import Envelope
    from rapidgen.client.egm.exchange import EgmState
    from rapidgen.client.egm.exchange import Path as EgmPath

_PIECE = 0.03
"""rad or m, summed over the joints: length of the pieces of a leg that have one box of stops."""
_LEAVES = 5e-4
"""m by which a jog may bring bodies nearer that are too near already."""
_AROUND = 0.05
"""rad or m around a box of guidance that are tried together with it."""
_LATE = 0.02
"""s from a state to the first answer with a target that follows it, at most."""
_SAMPLE, _MOST_SAMPLES = 0.008, 5_000
"""s between samples of a trajectory that a robot follows under guidance, and their number."""
_TRIED, _MOST_BOXES = 200, 2_000
"""Boxes of a trial, and of the proof that decides."""


class CellCheck:
    """The world of a cell for one motion group; other robots stand at their start.

    Raises DiagnosticError for a faulty cell, and ModuleNotFoundError for meshes without coal.
    """

    def __init__(self, cell: FilePath, config: RobotConfig, group: GroupConfig) -> None:
        described = load_cell(cell)
        groups = (group, *other_groups(described, (group,)))
        paths = {group.name: config.path} if config.path.suffix else {}
        self.world: World = with_parts(build_world(described, sources_of(described, groups, paths)))
        """The present world: parts hang where they are gripped."""
        self.position: Callable[[], Sequence[float]] | None = None
        """Returns the robot's axis values, once it is connected."""
        self.group = group
        self._zone = ZONES[config.trajectory.zone]

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """Return warnings about the cell, such as links without shapes."""
        return self.world.diagnostics

    @property
    def held(self) -> Mapping[str, str]:
        """Return the tools that hold parts, by part."""
        return self.world.held

    def attach(self, part: str, to: str = "", *, at: Sequence[float] | None = None) -> None:
        """Let a tool hold a part: it moves with the tool in the checks that follow.

        The cell file declares both under `attach`; `to` is needed if several tools may hold the
        part. `at` are axis values in rad and m, by default the robot's present position. Raises
        DiagnosticError RG829 (not declared) and RG830 (out of the tool's reach), NotReady.
        """
        grip = grip_of(self.world, part, to)
        self.world = gripping.attach(self.world, grip, self._values(at))

    def release(self, part: str, *, at: Sequence[float] | None = None) -> None:
        """Let a part stay where it is; without effect if no tool holds it. Raises NotReady."""
        if part in self.world.held:
            self.world = gripping.release(self.world, part, self._values(at))

    def _values(self, at: Sequence[float] | None) -> Array:
        if at is None and self.position is not None:
            at = self.position()
        if at is None:
            at = self.world.home[self.group.name]
        row = np.array([at[: len(self.group.joints)]], dtype=np.float64)
        return self.world.values({self.group.name: row})

    def check_points(
        self,
        wire: Array,
        durations: Array,
        start: Sequence[float],
        *,
        first: int = 0,
        since: float = 0.0,
        corners: bool = True,
    ) -> CollisionReport:
        """Check points (n, k) of axis values that follow the axis values `start`.

        `durations` (n,) s lead to each point; `first` is the number of the first point, `since` its
        time in s. Without `corners` the points are
        samples of a curve.
        """
        count = wire.shape[1]
        rows = np.concatenate([np.array([start[:count]]), wire])
        times = np.concatenate([[0.0], np.maximum(durations, 1e-6).cumsum()])
        times += since - times[1]
        values = self.world.values({self.group.name: rows})
        path = Path.sampled(times, values)
        if corners:
            path = Path.cornered(times, values, self._shares(values))

        def place_of(position: float) -> tuple[str, Span | None]:
            # Three knots a leg, if there are corners.
            leg = int(position // (3 if path.last > len(wire) else 1))
            return (f"before point {min(leg, len(wire) - 1) + first}", None)

        return check_path(self.world, path, place_of)

    def check_stops(
        self,
        wire: Array,
        durations: Array,
        start: Sequence[float],
        *,
        first: int = 0,
        accelerations: Array | None = None,
    ) -> tuple[Diagnostic, ...]:
        """Check where a stop may bring the axes from any place on points: see `check_points`.

        A stop by the brakes leaves the path: each axis comes to rest by itself, within v^2 / 2a,
        with its speed v on the leg and its acceleration a (k,) of the configuration. All postures
        within these ranges have to be free of contacts (RG838), so the return from there to the
        path is free as well.
        """
        count = wire.shape[1]
        rows = np.concatenate([np.array([start[:count]]), wire])
        steps = np.diff(rows, axis=0)
        speeds = steps / np.maximum(durations, 1e-6)[:, None]
        if accelerations is None:
            accelerations = np.array([joint.acceleration for joint in self.group.joints])
        reach = speeds * np.abs(speeds) / (2 * accelerations)
        lows, highs, legs = [], [], []
        for leg, step in enumerate(steps):
            pieces = 1 + int(np.abs(step).sum() / _PIECE)
            ends = rows[leg] + step * np.linspace(0.0, 1.0, pieces + 1)[:, None]
            # In the corner at its end the axes take over the speeds of the next leg.
            after = reach[min(leg + 1, len(steps) - 1)]
            stops = np.stack([np.zeros(count), reach[leg], after])
            lows.append(np.minimum(ends[:-1], ends[1:]) + stops.min(axis=0))
            highs.append(np.maximum(ends[:-1], ends[1:]) + stops.max(axis=0))
            legs += [leg] * pieces
        low, high = self._boxes(np.concatenate(lows), np.concatenate(highs))
        scene = _contacts_only(self.world.scene)
        found = prove_boxes(low, high, scene)
        return tuple(
            error(
                "RG838",
                None,
                f"a stop before point {legs[violation.box] + first} may bring "
                f"{_box_text(scene, violation)}",
                "go slower there, or keep more distance",
            )
            for violation in found
        )

    @property
    def moves(self) -> NDArray[np.bool_]:
        """Return True (columns,) for the columns of the world that are this robot's."""
        result = np.zeros(self.world.scene.tree.columns, dtype=np.bool_)
        result[self.world.columns[self.group.name]] = True
        return result

    def box(self, corners: Array) -> tuple[Array, Array]:
        """Return the box (columns,) of values of the world around axis values (n, k)."""
        low, high = self._boxes(corners.min(axis=0)[None], corners.max(axis=0)[None])
        return low[0], high[0]

    def box_fault(self, low: Array, high: Array, most: int) -> str:
        """Return the first violation in a box of values of the world; empty if it is proved."""
        scene = self.world.scene
        found = prove_boxes(low[None], high[None], scene, most)
        return _box_text(scene, found[0]) if found else ""

    def _boxes(self, low: Array, high: Array) -> tuple[Array, Array]:
        """Convert boxes (n, k) of axis values to boxes (n, columns) of values of the world."""
        name = self.group.name
        middle = self.world.values({name: (low + high) / 2})
        half = (high - low) / 2
        mapped = self.world.maps[name]
        if mapped.coupling:
            axes = [joint.axis for joint in mapped.joints]
            second, third = axes.index("rax_2"), axes.index("rax_3")
            half[:, third] += abs(mapped.coupling) * half[:, second]
        wide = np.zeros_like(middle)
        wide[:, self.world.columns[name]] = half
        return middle - wide, middle + wide

    def _shares(self, values: Array) -> Array:
        """Return the part of each segment that corners may take, 0 to 0.5."""
        tcp, turn = self._zone.tcp, self._zone.angle
        if self._zone.stops:
            return np.zeros(len(values) - 1)
        rotations, positions, _ = self.world.scene.tree.poses(values)
        node = self._last_node
        way = np.linalg.norm(np.diff(positions[:, node], axis=0), axis=1)
        between = np.einsum("nji,njk->nik", rotations[:-1, node], rotations[1:, node])
        cosine = (np.trace(between, axis1=1, axis2=2) - 1) / 2
        angle = np.arccos(np.clip(cosine, -1.0, 1.0))
        linear = np.where(way > 0, tcp / np.maximum(way, 1e-9), 0.5)
        turning = np.where(angle > 1e-6, turn / np.maximum(angle, 1e-9), 0.0)
        result: Array = np.minimum(np.maximum(linear, turning), 0.5)
        return result

    @property
    def _last_node(self) -> int:
        """Return the node of the robot's last joint."""
        own = self.world.columns[self.group.name]
        mix = np.abs(self.world.scene.tree.mix[:, own]).sum(axis=1)
        return int(np.flatnonzero(mix)[-1])

    def check_program(self, checked: CheckedProgram, *, leaving: bool = False) -> CollisionReport:
        """Check the samples of a program's path, one a second.

        Corners are bounded as those of trajectories, by the samples at the ends of their zones. A
        program that is `leaving`, such as a jog, may begin where bodies are too near, and must not
        bring them nearer.
        """
        numbers = [number for number, _ in checked.path]
        rows = np.array([posture for _, posture in checked.path], dtype=np.float64)
        values = self.world.values({self.group.name: rows})
        path = Path.sampled(np.arange(float(max(len(values), 2))), _at_least_two(values))
        slack = path.slack.copy()
        tcp = self.world.scene.tree.poses(values)[1][:, self._last_node]
        for c in range(1, len(numbers) - 1):
            zone = checked.program.steps[numbers[c]].zone
            if numbers[c] == numbers[c + 1] or zone.stops:
                continue
            far = np.linalg.norm(tcp - tcp[c], axis=1) >= zone.tcp
            before = np.flatnonzero(far[:c])
            after = np.flatnonzero(far[c + 1 :])
            a = max(int(before[-1]) if len(before) else 0, numbers.index(numbers[c]) - 1, 0)
            last = len(numbers) - 1 - numbers[::-1].index(numbers[c + 1])
            b = min(c + 1 + int(after[0]) if len(after) else last, last)
            bend = np.abs(values[a] + values[b] - 2 * values[c]) / 2
            slack[a:b] = np.maximum(slack[a:b], bend)
        path = Path(path.times, path.values, slack)

        def place_of(position: float) -> tuple[str, Span | None]:
            index = min(int(np.ceil(position)), len(numbers) - 1)
            return f"instruction {numbers[index]}", None

        world = _leaving(self.world, values[:1]) if leaving else self.world
        return check_path(world, path, place_of)


class GuidanceCheck:
    """Check of the targets of externally guided motion, before they are sent.

    Between two looks the robot may be anywhere in the box of axis values that its position, its
    reference, the target and a stop span. A box that is proved with a margin around it is kept:
    targets inside need no further check.
    """

    def __init__(self, check: CellCheck, envelope: "Envelope", timeout: float) -> None:
        """`timeout` in s: after it without a target, the partner stops the robot."""
        self._check, self._envelope, self._timeout = check, envelope, timeout
        self._free: tuple[World, Array, Array] | None = None

    def check_target(
        self,
        state: "EgmState",
        speeds: Sequence[float],
        targets: Sequence[Sequence[float]],
        rates: Sequence[float] | None,
    ) -> None:
        """Raise TargetRejected (RG837) if the robot may come too near to something.

        `speeds` (k,) are those of the reference, `targets` the ones that are not reached yet, the
        new one last, `rates` the speeds (k,) with which it moves on. rad and m in URDF order.
        """
        here, speed = np.array(state.reference), np.array(speeds)
        stop = here + speed * _LATE + self._stop(speed)
        corners = [np.array(state.joints), here, stop]
        corners += [np.array(target) for target in targets]
        if rates is not None:
            rate = np.array(rates)
            corners.append(corners[-1] + rate * self._timeout + self._stop(rate))
        self._require_free(np.array([self._to_axes(corner) for corner in corners]))

    def check_path(self, path: "EgmPath", state: "EgmState", speeds: Sequence[float]) -> None:
        """Raise TargetRejected (RG837) for a trajectory that is not free, with stops from it.

        `speeds` (k,) are those of the reference at its beginning.
        """
        # Needs an extra, as guidance does.
        from rapidgen.client.egm.exchange import sample

        first, last = max(path.since, path.times[0]), path.times[-1]
        if len(path.times) < 2 or first >= last:
            self.check_target(state, speeds, path.positions[-1:], None)
            return
        count = min(max(2, 1 + round((last - first) / _SAMPLE)), _MOST_SAMPLES)
        times = np.linspace(first, last, count)
        rows = np.array([self._to_axes(np.array(sample(path, t)[0])) for t in times.tolist()])
        here, speed = np.array(state.reference), np.array(speeds)
        corners = [np.array(state.joints), here, here + speed * _LATE + self._stop(speed)]
        self._require_free(np.array([*map(self._to_axes, corners), rows[0]]))
        durations = np.diff(times, prepend=times[0] - 1.0)
        check = self._check
        found = check.check_points(rows, durations, rows[0].tolist(), corners=False).diagnostics
        if not found:
            limits = np.array(self._envelope.acceleration)
            found = check.check_stops(rows, durations, rows[0].tolist(), accelerations=limits)
        if found:
            raise _target_rejected(found[0].message)

    def _stop(self, speeds: Array) -> Array:
        result: Array = speeds * np.abs(speeds) / (2 * np.array(self._envelope.acceleration))
        return result

    def _to_axes(self, joints: Array) -> Array:
        mapped = self._check.world.maps[self._check.group.name]
        return np.array(mapped.to_controller(joints.tolist()), dtype=np.float64)

    def _require_free(self, corners: Array) -> None:
        check = self._check
        low, high = check.box(corners)
        if self._free is not None:
            world, least, most = self._free
            if world is check.world and (least <= low).all() and (high <= most).all():
                return
        around = np.where(check.moves, _AROUND, 0.0)
        if not check.box_fault(low - around, high + around, _TRIED):
            self._free = (check.world, low - around, high + around)
            return
        fault = check.box_fault(low, high, _MOST_BOXES)
        if fault:
            raise _target_rejected(f"guidance may bring {fault}")


def _target_rejected(text: str) -> TargetRejected:
    return TargetRejected.because(
        "RG837", f"target not sent: {text}", "guide the robot on another way, or slower"
    )


def _contacts_only(scene: Scene) -> Scene:
    return scene.with_pairs(
        [Pair(pair.first, pair.second, min(pair.clearance, 0.0)) for pair in scene.pairs]
    )


def _leaving(world: World, values: Array) -> World:
    """Return a world whose pairs need not be farther from each other than they are at first."""
    scene = world.scene
    present = scene.body_distances(values)[0] - _LEAVES
    pairs = [
        Pair(pair.first, pair.second, min(pair.clearance, float(far)))
        for pair, far in zip(scene.pairs, present, strict=True)
    ]
    return replace(world, scene=scene.with_pairs(pairs))


def _box_text(scene: Scene, violation: BoxViolation) -> str:
    one, other = scene.names(violation.pair)
    x, y, z = (1000 * value for value in violation.point)
    clearance = 1000 * scene.pairs[violation.pair].clearance
    at = f"at ({x:.0f}, {y:.0f}, {z:.0f}) mm"
    if violation.verdict == "contact":
        return f"{one} {-1000 * violation.distance:.1f} mm into {other} {at}"
    text = f"{one} within {1000 * violation.distance:.1f} mm of {other} {at}"
    proved = ", which is not proved" if violation.verdict == "not proved" else ""
    return f"{text}; the clearance is {clearance:.1f} mm{proved}"


def _at_least_two(values: Array) -> Array:
    return np.repeat(values, 2, axis=0) if len(values) == 1 else values


def cell_check(cell: object, config: RobotConfig | None, group: str) -> CellCheck:
    """Return the check of a robot in a cell file. Raises DiagnosticError (RG834: an address).

    A check that was made before, for another connection of the same robot, is used again.
    """
    if isinstance(cell, CellCheck):
        return cell
    if config is None:
        raise refusal(
            "RG834",
            None,
            "a collision check needs the robot's configuration",
            "`Robot(CONFIG, address=HOST, cell=CELL)` instead of an address alone",
        )
    chosen = next(g for g in config.groups if not group or g.name == group)
    return CellCheck(FilePath(str(cell)), config, chosen)
