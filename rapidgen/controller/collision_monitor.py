"""Collision detection of a running virtual controller, and its state for a view.

While a robot moves, the path since the last look is proved every 20 ms, on the planned path with
its corners. A contact stops the robots as collision detection of a controller does: the event
50204 [mem], a quick stop on the path, motors stay on. A controller also moves back a little on its
path to release the force [3HAC18154]; that is not simulated, since nothing here has forces.

With the switch `collision_error` the move raises ERR_COLL_STOP instead of stopping the program, as
with the system parameter Collision Error Handling. Handlers of public programs then use ClearPath
and StartMove, so the movement waits for them [code].

A pair that touches already, after a stop or at the start, stops the robots again only if it goes
deeper, so that a robot can leave a contact. Detection is late by at most one look; that of a
controller needs a force, and is late as well.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf
from typing import Literal, Protocol, TypeAlias

import numpy as np

from rapidgen.collision.check import LIMIT, near_pairs
from rapidgen.collision.path import Path
from rapidgen.collision.proof import Violation, prove
from rapidgen.collision.scene import Pair
from rapidgen.collision.world import World
from rapidgen.controller.collisions import CollisionSetup, WatchedRobots, WorldHistory
from rapidgen.controller.operation import Operation
from rapidgen.machine.scheduler import S, Timer
from rapidgen.motion.motion import Motion
from rapidgen.motion.recorder import PERIOD
from rapidgen.rapid.switches import Switches
from rapidgen.runtime.errors import Location, errnum
from rapidgen.runtime.motion_interface import RobotData
from rapidgen.runtime.task.interrupts import ProcessError
from rapidgen.runtime.task.task import Task

LOOK = 0.02
"""s between two looks while a robot moves."""
COLLISION = 50_204
"""Event: motion supervision."""
_DEEPER = 5e-4
"""m by which a pair that touches has to go deeper to stop the robots again."""
Point: TypeAlias = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class NearPair:
    """Two bodies that touch or are near each other: m, points in the world of the cell."""

    bodies: tuple[str, str]
    distance: float
    """Negative: depth of the overlap."""
    clearance: float
    points: tuple[Point, Point]
    """Nearest points, one on each body."""

    @property
    def verdict(self) -> Literal["contact", "too near", "near"]:
        """Return how the distance compares with the clearance."""
        if self.distance <= 0:
            return "contact"
        return "too near" if self.distance <= self.clearance else "near"


@dataclass(frozen=True, slots=True)
class Contact:
    """The first contact of two bodies: s, m."""

    time: float
    bodies: tuple[str, str]
    point: Point
    depth: float
    """Depth at the next look, at most 20 ms later."""
    place: str
    """Move instructions under way; empty if there are none."""
    values: tuple[float, ...]
    """URDF values of the world's columns at that time, rad and m."""


@dataclass(frozen=True, slots=True)
class CollisionState:
    """Distances at one time, for a view. All data are immutable."""

    time: float
    least: float
    """m; infinite if no pair is nearer than 100 mm."""
    near: tuple[NearPair, ...]
    """Pairs nearer than 100 mm, the nearest first."""
    first: Contact | None
    """The first contact since the start of the controller."""
    gripped: tuple[tuple[str, str], ...]
    """(part, gripper) of gripped parts."""
    unchecked: tuple[str, ...]
    """Sentences on what is not checked, such as links without shapes."""


class StoppedRobots(WatchedRobots, Protocol):
    """The parts of a controller that detection uses."""

    operation: Operation
    robot_data: dict[str, RobotData]
    rapid_tasks: dict[str, Task]
    dialect: Switches


class CollisionMonitor:
    """Watches all robots of a controller from its creation.

    Raises DiagnosticError for a cell that describes no world (RG825 to RG833, RG847), and
    ModuleNotFoundError for meshes without coal. All methods belong to the controller's thread.
    """

    def __init__(self, controller: StoppedRobots, setup: CollisionSetup) -> None:
        self._controller = controller
        self._is_error = setup.mode == "error"
        self.history = WorldHistory(controller, setup)
        self.contacts: list[Contact] = []
        """Contacts in the order of time, one for each time a pair touches."""
        self._known = self._touching()
        self._since = controller.scheduler.now
        self._timer: Timer | None = None
        for name in self.history.recorders:
            controller.motion.groups[name].observers.append(self._moved)
        self.history.before_change.append(self._flush)
        self.history.after_change.append(self._renew)

    @property
    def world(self) -> World:
        """The present world: parts hang where they are gripped."""
        return self.history.world

    def state(self) -> CollisionState:
        """Return distances now; computed when it is asked for."""
        scene = self.world.scene
        near = tuple(
            NearPair(scene.names(pair), far, scene.pairs[pair].clearance, (first, second))
            for pair, far, first, second in near_pairs(scene, self._values(), LIMIT)
        )
        return CollisionState(
            self._controller.scheduler.now / S,
            min((one.distance for one in near), default=inf),
            near,
            self.contacts[0] if self.contacts else None,
            tuple(self.world.held.items()),
            self.world.unchecked,
        )

    def _values(self) -> "np.ndarray[tuple[int, ...], np.dtype[np.float64]]":
        return self.history.values([self._controller.scheduler.now])

    def _touching(self) -> dict[int, float]:
        """Return the depths of pairs that touch now, by pair."""
        found = near_pairs(self.world.scene, self._values(), 0.0)
        return {pair: far for pair, far, _, _ in found}

    # -- looks -----------------------------------------------------------------------------------

    def _moved(self, _motion: Motion) -> None:
        if self._timer is None:
            scheduler = self._controller.scheduler
            self._since = scheduler.now
            self._timer = scheduler.after(round(LOOK * S), self._look)

    def _look(self) -> None:
        self._flush()
        scheduler = self._controller.scheduler
        self.history.forget(scheduler.now)
        groups = self._controller.motion.groups
        self._timer = None
        if not all(groups[name].is_standing for name in self.history.recorders):
            self._timer = scheduler.after(round(LOOK * S), self._look)

    def _flush(self) -> None:
        """Prove the path since the last look."""
        now = self._controller.scheduler.now
        low, self._since = self._since, now
        if now <= low:
            return
        times = [*range(low, now, round(PERIOD * S)), now]
        values = self.history.values(times)
        if not np.ptp(values, axis=0).any():
            return
        path = Path.sampled(np.array(times) / S, values)
        scene = self.world.scene
        pairs = [Pair(p.first, p.second, min(p.clearance, 0.0)) for p in scene.pairs]
        proof = prove(path, scene.with_pairs(pairs))
        met = [v for v in proof.violations if v.verdict == "contact"]
        deep = {v.pair: self._deepest(path, v.pair) for v in met}
        references = {pair: far for pair, far in self._touching().items() if pair not in deep}
        for pair, far in references.items():
            # A robot that leaves a contact and comes back is stopped where it went out of it.
            references[pair] = max(far, self._known.get(pair, far))
        for violation in met:
            distance, known = deep[violation.pair], self._known.get(violation.pair)
            if known is None or distance < known - _DEEPER:
                is_stopping = self._is_stopping(violation)
                if known is None or not is_stopping:
                    contact = self._record(violation, path, distance)
                    stops = is_stopping or self._stop(contact, self._movers(violation))
                    # What does not stop the robots is reported once.
                    distance = distance if stops else -inf
                known = distance if known is None else min(known, distance)
            references[violation.pair] = known
        self._known = references

    def _renew(self) -> None:
        """Take what touches when the world changes as known, such as a gripped part's table."""
        self._known = self._touching()

    def _deepest(self, path: Path, pair: int) -> float:
        far = self.world.scene.body_distances(path.values, [pair])
        return float(far.min())

    def _is_stopping(self, violation: Violation) -> bool:
        """True if all robots of a contact that move are stopping."""
        groups = self._controller.motion.groups
        return all(groups[name].stop_reasons for name in self._movers(violation))

    def _record(self, violation: Violation, path: Path, distance: float) -> Contact:
        time = path.time(violation.position)
        place = self.history.place(round(time * S))[0]
        bodies = self.world.scene.names(violation.pair)
        values = tuple(path.at(np.array([violation.position]))[0].tolist())
        contact = Contact(time, bodies, violation.point, max(0.0, -distance), place, values)
        self.contacts.append(contact)
        return contact

    def _movers(self, violation: Violation) -> dict[str, int]:
        """Return the robots of a contact that move, and the numbers of their axes."""
        scene, groups = self.world.scene, self._controller.motion.groups
        pair = scene.pairs[violation.pair]
        result: dict[str, int] = {}
        for body in (scene.bodies[pair.first], scene.bodies[pair.second]):
            if body.owner not in self.history.recorders or groups[body.owner].is_standing:
                continue
            columns = [c for c, _ in scene.tree.nodes[body.node].columns] if body.node >= 0 else []
            first = self.world.columns[body.owner].start
            result.setdefault(body.owner, 1 + min(columns, default=first) - first)
        return result

    def _stop(self, contact: Contact, movers: Mapping[str, int]) -> bool:
        """Log a contact, and stop as the switch says; MotionSup \\Off stops nothing."""
        controller = self._controller
        x, y, z = (1000 * value for value in contact.point)
        one, other = contact.bodies
        text = (
            f"{one} touches {other} at ({x:.0f}, {y:.0f}, {z:.0f}) mm, "
            f"{1000 * contact.depth:.1f} mm deep"
        )
        supervised = [
            name for name in movers if controller.robot_data[name].extra.get("MotionSup", True)
        ]
        for name in supervised or movers:
            config = controller.motion.groups[name].config
            controller.log.record(
                COLLISION,
                str(movers[name]),
                config.mechanical_unit,
                texts=(text, contact.place),
                task=config.task,
            )
        if not self._is_error or not supervised:
            return False
        if controller.dialect.collision_error == "error":
            for name in supervised:
                self._raise(name)
        else:
            controller.operation.stop_program(quick=True)
        return True

    def _raise(self, name: str) -> None:
        """Stop a robot; when it stands, raise ERR_COLL_STOP in the routine of its move."""
        group = self._controller.motion.groups[name]
        task = self._controller.rapid_tasks[group.config.task]
        place = group.legs[0].move.place if group.legs else None
        found = place() if place is not None else None
        owner = (found.module, found.routine) if isinstance(found, Location) else ("", "")
        group.stop("move task", quick=True)

        def arrive() -> None:
            if task.state == "running":
                task.interrupts.process_error = ProcessError(errnum("ERR_COLL_STOP"), owner)
                task.wake_at_next_statement()

        self._controller.scheduler.at(group.motion.end, arrive)
