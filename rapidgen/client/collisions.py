"""Collision check of commanded motions, before a byte is sent.

Nothing imports this module without a cell: NumPy's closed forms are quick to import, coal and the
reading of meshes are not.

The path of a trajectory is that of its points, with the corners that the driver may take: at most
the configured zone, and half of a segment. The path of a program are the samples of its check.
"""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path as FilePath

import numpy as np

from rapidgen.client.core.program_checks import CheckedProgram
from rapidgen.client.program import ZONES
from rapidgen.client.trajectory import Array
from rapidgen.collision import gripping
from rapidgen.collision.check import CollisionReport, check_path
from rapidgen.collision.gripping import grip_of, with_parts
from rapidgen.collision.path import Path
from rapidgen.collision.world import World, build_world, sources_of
from rapidgen.config.cell import load_cell
from rapidgen.config.load import load_config
from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.config.registry import is_path, shipped_names
from rapidgen.diagnostics import Diagnostic, Span, refusal


class CellCheck:
    """The world of a cell for one motion group; other robots stand at their start.

    Raises DiagnosticError for a faulty cell, and ModuleNotFoundError for meshes without coal.
    """

    def __init__(self, cell: FilePath, config: RobotConfig, group: GroupConfig) -> None:
        described = load_cell(cell)
        groups = {group.name: group}
        own = {group.task.casefold()}
        for task, keys in described.robots.items():
            if task.casefold() in own or not keys.model:
                continue
            known = is_path(keys.model) or keys.model in shipped_names()
            other = load_config(keys.model).groups if known else ()
            for one in other:
                if one.task.casefold() == task.casefold():
                    groups.setdefault(one.name, one)
        paths = {group.name: config.path} if config.path.suffix else {}
        self.world: World = with_parts(
            build_world(described, sources_of(described, tuple(groups.values()), paths))
        )
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
    ) -> CollisionReport:
        """Check points (n, k) of axis values that follow the axis values `start`.

        `durations` (n,) s lead to each point; `first` is the number of the first point, `since` its
        time in s.
        """
        count = wire.shape[1]
        rows = np.concatenate([np.array([start[:count]]), wire])
        times = np.concatenate([[0.0], np.maximum(durations, 1e-6).cumsum()])
        times += since - times[1]
        values = self.world.values({self.group.name: rows})
        path = Path.cornered(times, values, self._shares(values))

        def place_of(position: float) -> tuple[str, Span | None]:
            # Three knots a leg, if there are corners.
            leg = int(position // (3 if path.last > len(wire) else 1))
            return (f"before point {min(leg, len(wire) - 1) + first}", None)

        return check_path(self.world, path, place_of)

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

    def check_program(self, checked: CheckedProgram) -> CollisionReport:
        """Check the samples of a program's path, one a second.

        Corners are bounded as those of trajectories, by the samples at the ends of their zones.
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

        return check_path(self.world, path, place_of)


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
