"""Collision detection of a virtual controller: bodies, near pairs, the first contact."""

from collections.abc import Iterable, Iterator, Mapping

import numpy as np

from rapidgen.axes import frames
from rapidgen.collision.shapes import Shape
from rapidgen.collision.world import World
from rapidgen.controller.collision_monitor import Contact
from rapidgen.controller.runner import ControllerRunner
from rapidgen.viewer.appearance import PLAIN, Appearance
from rapidgen.viewer.messages import (
    CollisionBodies,
    Collisions,
    Pose,
    SeenBody,
    SeenContact,
    SeenPair,
    SeenShape,
    ToPage,
)
from rapidgen.viewer.provider import Handler
from rapidgen.viewer.robots import pose_of

_EVERY = 3
"""Looks of the page for one computation of distances: about ten times a second."""
_MOST = 40
"""Pairs that are sent, the nearest ones."""


class CollisionProvider:
    """Bodies and their distances while a controller has collision detection."""

    def __init__(self, runner: ControllerRunner, look: Appearance = PLAIN) -> None:
        monitor = runner.controller.collisions
        assert monitor is not None
        self._monitor = monitor
        self._controller = runner.controller
        self._look = look
        self._world: World | None = None
        self._values: bytes = b""
        self._looks = 0

    def whole(self) -> Iterable[ToPage]:
        """Return bodies and distances."""
        yield _bodies(self._monitor.world)
        yield self._now()

    def changes(self) -> Iterable[ToPage]:
        """Return the bodies of a new world, and distances after a motion."""
        self._looks += 1
        if self._looks % _EVERY:
            return
        world = self._monitor.world
        if world is not self._world:
            self._world, self._values = world, b""
            yield _bodies(world)
        values = self._posture().tobytes()
        if values != self._values:
            self._values = values
            yield self._now()

    def handlers(self) -> Mapping[type, Handler]:
        """There are no requests."""
        return {}

    def _posture(self) -> "np.ndarray[tuple[int, ...], np.dtype[np.float64]]":
        return self._monitor.history.values([self._controller.scheduler.now])

    def _now(self) -> Collisions:
        state, world = self._monitor.state(), self._monitor.world
        rotations, positions, _ = world.scene.tree.poses(self._posture())
        nodes = tuple(map(_pose, rotations[0, :-1], positions[0, :-1]))
        near = tuple(
            SeenPair(
                bodies=pair.bodies,
                distance=pair.distance,
                clearance=pair.clearance,
                verdict=pair.verdict,
                points=pair.points,
            )
            for pair in state.near[:_MOST]
        )
        first = None if state.first is None else self._contact(world, state.first)
        return Collisions(nodes=nodes, near=near, first=first)

    def _contact(self, world: World, contact: Contact) -> SeenContact:
        joints = {}
        for name, group in self._controller.motion.groups.items():
            part = world.columns.get(name)
            if part is not None:
                own = contact.values[part]
                joints[name] = self._look.of(group.config).values(own)
        return SeenContact(
            time=contact.time,
            bodies=contact.bodies,
            point=contact.point,
            depth=contact.depth,
            place=contact.place,
            joints=joints,
        )


def _bodies(world: World) -> CollisionBodies:
    return CollisionBodies(
        bodies=tuple(
            SeenBody(
                name=body.name,
                role=body.role,
                node=body.node,
                shapes=tuple(map(_shape, body.shapes)),
            )
            for body in world.scene.bodies
        ),
        unchecked=world.unchecked,
    )


def _shape(shape: Shape) -> SeenShape:
    # The page takes whole lengths of boxes, collision checks half ones.
    size = tuple(2 * value for value in shape.size) if shape.kind == "box" else shape.size
    return SeenShape(
        kind=shape.kind, size=size, pose=pose_of(shape.pose), corners=tuple(_corners(shape))
    )


def _corners(shape: Shape) -> Iterator[tuple[float, float, float]]:
    """Yield the vertices of a hull, to 0.1 mm."""
    if shape.kind == "hull":
        yield from ((x, y, z) for x, y, z in np.round(shape.vertices, 4).tolist())


def _pose(
    rotation: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]",
    position: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]",
) -> Pose:
    (a, b, c), (d, e, f), (g, h, i) = rotation.tolist()
    x, y, z = position.tolist()
    return pose_of(((x, y, z), frames.from_matrix(((a, b, c), (d, e, f), (g, h, i)))))
