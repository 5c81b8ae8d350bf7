"""Parts that grippers hold: the world in which a part moves with a tool.

`with_parts` adds the pairs of all parts that the cell file declares under `attach`. Attaching and
releasing a part return another world with the same bodies and pairs in the same order, so that
results of different times refer to one list of pairs. Pairs that do not apply at a time have the
clearance UNCHECKED.

A part and the tools that can hold it may always touch. A held part may not come nearer to anything
than the clearance, or than it was when it was gripped, whichever is less: a part on a table can be
lifted off and put back, but not pushed through the table.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import inf

from rapidgen.axes import frames
from rapidgen.collision.scene import Body, Pair, Scene
from rapidgen.collision.shapes import Array
from rapidgen.collision.tree import WORLD
from rapidgen.collision.world import World
from rapidgen.config.cell import AttachKeys, CollisionKeys
from rapidgen.diagnostics import DiagnosticError, error, refusal, suggest

UNCHECKED = -inf
"""Clearance of a pair that is not checked at present."""
_SETTLED = 5e-4
"""m by which a held part may come nearer than it was at the grip."""


def with_parts(world: World) -> World:
    """Return a world whose parts can be attached. Raises DiagnosticError RG829."""
    if not world.cell.attach:
        return world
    scene = world.scene
    names = [body.name for body in scene.bodies]
    faults = []
    for grip in world.cell.attach:
        objects = [body.name for body in scene.bodies if body.role in ("object", "part")]
        if grip.part not in objects:
            help = suggest(grip.part, objects) or "declare it under `things:`, with a shape"
            faults.append(error("RG829", None, f"attach: no object '{grip.part}'", help))
        if not _tools(scene, grip):
            tools = [body.name for body in scene.bodies if body.role == "tool"]
            help = suggest(grip.to, tools) or f"tools with shapes: {', '.join(tools) or 'none'}"
            faults.append(error("RG829", None, f"attach: no single tool '{grip.to}'", help))
    if faults:
        raise DiagnosticError(faults)
    parts = {names.index(grip.part) for grip in world.cell.attach}
    known = {frozenset((pair.first, pair.second)) for pair in scene.pairs}
    more = []
    for part in sorted(parts):
        for other, body in enumerate(scene.bodies):
            pair = frozenset((part, other))
            named = frozenset((names[part], body.name))
            if other == part or pair in known or named in world.allowed:
                continue
            if body.role == "zone" and not _concerns(world, body, names[part]):
                continue
            known.add(pair)
            more.append(Pair(part, other, UNCHECKED))
    bodies = [
        replace(body, role="part") if number in parts else body
        for number, body in enumerate(scene.bodies)
    ]
    grips = {(names.index(g.part), tool) for g in world.cell.attach for tool in _tools(scene, g)}
    pairs = [
        replace(pair, clearance=UNCHECKED)
        if {(pair.first, pair.second), (pair.second, pair.first)} & grips
        else pair
        for pair in (*scene.pairs, *more)
    ]
    return replace(world, scene=Scene(scene.tree, bodies, pairs))


def _concerns(world: World, zone: Body, part: str) -> bool:
    keys = world.cell.zones.get(zone.name.removeprefix("zone "))
    return keys is not None and ("all" in keys.of or part in keys.of)


def _tools(scene: Scene, grip: AttachKeys) -> list[int]:
    """Return the tools that `to` names; one if the name is unambiguous."""
    return [
        number
        for number, body in enumerate(scene.bodies)
        if body.role == "tool" and grip.to in (body.name, body.name.rpartition("/")[2])
    ]


def grip_of(world: World, part: str, to: str = "") -> AttachKeys:
    """Return the entry of `attach` for a part, and for a tool if there are several (RG829)."""
    grips = [grip for grip in world.cell.attach if grip.part == part and to in ("", grip.to)]
    if not grips:
        known = [f"{grip.part} to {grip.to}" for grip in world.cell.attach]
        raise refusal(
            "RG829",
            None,
            f"`attach` of the cell file has no {part}" + (f" to {to}" if to else ""),
            "; ".join(known) or "attach: [{part: NAME, to: TOOL}] declares it",
        )
    return grips[0]


def gap(world: World, grip: AttachKeys, values: Array) -> float:
    """Return the distance in m of a part from its tool, at `values` (1, columns)."""
    scene = world.scene
    tool = scene.bodies[_tools(scene, grip)[0]].name
    for number in range(len(scene.pairs)):
        if set(scene.names(number)) == {grip.part, tool}:
            return float(scene.body_distances(values, [number])[0, 0])
    return inf


def attach(world: World, grip: AttachKeys, values: Array) -> World:
    """Return the world in which the tool of `grip` holds the part, at `values` (1, columns).

    Raises DiagnosticError RG830 if the part is out of the tool's reach.
    """
    far = gap(world, grip, values)
    if far > grip.reach / 1000:
        raise refusal(
            "RG830",
            None,
            f"{grip.part} is {1000 * far:.1f} mm from {grip.to}; its reach is {grip.reach:.1f} mm",
            "grip nearer to the part, correct its place under `things:`, or raise `reach:`",
        )
    scene = world.scene
    tool = scene.bodies[_tools(scene, grip)[0]]
    part = _index(scene, grip.part)
    body = _moved(scene, part, tool.node, values)
    body = replace(body, owner=tool.owner)
    held = {**world.held, grip.part: tool.name}
    present: dict[int, float] = {}
    numbers = [i for i, p in enumerate(scene.pairs) if part in (p.first, p.second)]
    distances = scene.body_distances(values, numbers)[0]
    for number, distance in zip(numbers, distances.tolist(), strict=True):
        present[number] = distance - _SETTLED
    return _with_part(replace(world, held=held), part, body, present)


def release(world: World, part: str, values: Array) -> World:
    """Return the world in which a part stays where it is at `values` (1, columns)."""
    scene = world.scene
    number = _index(scene, part)
    body = replace(_moved(scene, number, WORLD, values), owner="")
    held = {name: tool for name, tool in world.held.items() if name != part}
    return _with_part(replace(world, held=held), number, body, {})


def _index(scene: Scene, name: str) -> int:
    return next(i for i, body in enumerate(scene.bodies) if body.name == name)


def _moved(scene: Scene, number: int, node: int, values: Array) -> Body:
    """Return a body that hangs on another node, and stays where it is at `values`."""
    rotations, positions, _ = scene.tree.poses(values)
    old, new = (_pose(rotations[0, n], positions[0, n]) for n in (scene.bodies[number].node, node))
    change = frames.compose(frames.invert(new), old)
    body = scene.bodies[number]
    return replace(body, node=node, shapes=tuple(shape.placed(change) for shape in body.shapes))


def _pose(rotation: Array, position: Array) -> frames.Pose:
    rows = tuple((row[0], row[1], row[2]) for row in rotation.tolist())
    x, y, z = position.tolist()
    return (x, y, z), frames.from_matrix((rows[0], rows[1], rows[2]))


def _with_part(world: World, part: int, body: Body, present: Mapping[int, float]) -> World:
    """Return the world with another place of a part, and the clearances that belong to it.

    `present` has the distances of its pairs that a grip must not lessen, by pair.
    """
    scene = world.scene
    bodies = (*scene.bodies[:part], body, *scene.bodies[part + 1 :])
    pairs = list(scene.pairs)
    for number, clearance in _clearances(world, bodies, part):
        pair = pairs[number]
        clearance = min(clearance, present.get(number, inf))
        pairs[number] = replace(pair, clearance=clearance)
    return replace(world, scene=scene.with_body(part, body, pairs))


def _clearances(world: World, bodies: tuple[Body, ...], part: int) -> Iterator[tuple[int, float]]:
    """Yield the pairs of a part with their clearances; UNCHECKED if it cannot or may touch."""
    keys = world.cell.collision or CollisionKeys()
    own = bodies[part]
    tools = {
        number
        for grip in world.cell.attach
        if grip.part == own.name
        for number in _tools(world.scene, grip)
    }
    for number, pair in enumerate(world.scene.pairs):
        if part not in (pair.first, pair.second):
            continue
        index = pair.second if pair.first == part else pair.first
        other = bodies[index]
        if index in tools or other.node == own.node:
            yield number, UNCHECKED
        elif other.role == "zone":
            yield number, 0.0 if own.owner else UNCHECKED
        else:
            is_own = bool(own.owner) and own.owner == other.owner
            standard = (keys.self_clearance if is_own else keys.clearance) / 1000
            named = frozenset((own.name, other.name))
            yield number, world.special.get(named, standard)
