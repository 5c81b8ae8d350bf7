"""Duration of collision proofs, CPU time.

    python benchmarks/collision.py

- A trajectory of 10 s with 10 legs of an IRB 120, one capsule a link and a tool box, against 20
  and 200 random boxes with a clearance of 5 mm: median of 8 free paths. Without self pairs, since
  single capsules of neighbouring links always touch.
- The same with convex hulls of 300 vertices (coal).
- Postures of a proof for a path that glides 0.5 mm above the clearance: a turn of axis 1 above a
  floor, and a straight move of the TCP over a tilted table.
- `rapidgen run --cell` with the check, beyond the run without it: 10,000 moves of 0.5 mm around a
  circle and 1,000 of 200 mm, at 500 mm/s, with a floor, a table 25 mm below the tool, and a post.
"""

import contextlib
import io
import math
import statistics
import tempfile
import time
from pathlib import Path as FilePath

import numpy as np

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Kinematics
from rapidgen.cli.app import main as rapidgen
from rapidgen.collision import shapes
from rapidgen.collision.path import Path
from rapidgen.collision.proof import prove
from rapidgen.collision.robot import frames_of_chain
from rapidgen.collision.scene import Body, Pair, Scene
from rapidgen.collision.tree import WORLD, Tree
from rapidgen.config.load import load_config

GROUP = load_config("irb120").groups[0]
ROBOT = frames_of_chain(GROUP, frames.IDENTITY, 0, 0)
TREE = Tree(ROBOT.nodes, len(GROUP.joints))
LOW = np.array([joint.lower for joint in GROUP.joints])
HIGH = np.array([joint.upper for joint in GROUP.joints])
URDF = FilePath(__file__).resolve().parents[1] / "robots" / "urdf" / "irb120.urdf"
CELL = """robots:
  T_ROB1: {model: robot.yaml}
tools:
  tGrip:
    frame: {position: [0, 0, 120]}
    load: {mass: 0.5}
    shapes: [{box: [60, 60, 100], frame: {position: [0, 0, 60]}}]
things:
  floor: {half_space: [0, 0, 1], frame: {position: [0, 0, -5]}}
  table: {box: [400, 600, 100], frame: {position: [400, 0, 140]}}
  post: {box: [80, 80, 900], frame: {position: [-400, 250, 450]}}
collision:
  clearance: 10
  pairs:
    base_link - link_2: {allowed: bars meet in the shoulder}
    link_3 - link_5: {allowed: bars meet in the wrist}
    link_3 - link_6: {allowed: bars meet in the wrist}
    link_4 - link_6: {allowed: bars meet in the wrist}
    tGrip - link_4: {allowed: bars meet in the wrist}
    tGrip - link_5: {allowed: bars meet in the wrist}
"""


def links(kind: str, rng: np.random.Generator) -> list[Body]:
    """Return a capsule or a hull from each axis to the next, and a box as a tool."""
    places = TREE.poses(np.zeros((1, TREE.columns)))[1][0]
    bodies = []
    for index in range(len(ROBOT.nodes)):
        if index + 1 < len(ROBOT.nodes):
            end = places[index + 1] - places[index]
        else:
            end = np.array([0.01, 0.0, 0.0])
        length = max(float(np.linalg.norm(end)), 0.01)
        z = np.array([0.0, 0.0, 1.0])
        axis = np.cross(z, end / length)
        size = float(np.linalg.norm(axis))
        turn = (
            frames.about(tuple((axis / size).tolist()), math.acos(end[2] / length))
            if size
            else frames.UNIT
        )
        x, y, w = (end / 2).tolist()
        radius = (0.09, 0.08, 0.07, 0.06, 0.045, 0.03)[index]
        shape = shapes.capsule(radius, length, ((x, y, w), turn))
        if kind == "hull":
            ball = rng.normal(size=(300, 3))
            ball *= radius / np.linalg.norm(ball, axis=1)[:, None]
            ball[:, 2] += np.sign(ball[:, 2]) * length / 2
            shape = shapes.hull(ball, shape.pose)
        bodies.append(Body(f"link_{index + 1}", index, (shape,), "robot", "link"))
    node, flange = ROBOT.flange
    tool = shapes.box(0.06, 0.06, 0.12, frames.compose(flange, ((0.0, 0.0, 0.06), frames.UNIT)))
    return [*bodies, Body("tool", node, (tool,), "robot", "tool")]


def scene_of(kind: str, objects: int, rng: np.random.Generator) -> Scene:
    """Return a robot among random boxes between 0.35 and 0.9 m from its axis."""
    bodies = links(kind, rng)
    count = len(bodies)
    for index in range(objects):
        angle, far = rng.uniform(-math.pi, math.pi), rng.uniform(0.35, 0.9)
        turn = rng.normal(size=4)
        q1, q2, q3, q4 = (turn / np.linalg.norm(turn)).tolist()
        centre = (far * math.cos(angle), far * math.sin(angle), float(rng.uniform(-0.2, 0.9)))
        x, y, z = rng.uniform(0.03, 0.15, 3).tolist()
        bodies.append(
            Body(f"box_{index}", WORLD, (shapes.box(x, y, z, (centre, (q1, q2, q3, q4))),))
        )
    pairs = [Pair(a, b, 0.005) for a in range(count) for b in range(count, len(bodies))]
    return Scene(TREE, bodies, pairs)


def random_path(rng: np.random.Generator) -> Path:
    """Return 10 legs of about 1 rad, 1 s each."""
    postures = [rng.uniform(LOW, HIGH) * 0.5]
    while len(postures) < 11:
        way = rng.normal(size=len(LOW))
        postures.append(np.clip(postures[-1] + way / np.linalg.norm(way), LOW, HIGH))
    return Path.linear(np.arange(11.0), np.array(postures))


def trajectories(kind: str, objects: int) -> None:
    """Print the median CPU time of proofs of 8 free paths."""
    rng = np.random.default_rng(1)
    times, postures, queries = [], [], []
    tried = 0
    while len(times) < 8 and tried < 4000:
        tried += 1
        scene, path = scene_of(kind, objects, rng), random_path(rng)
        began = time.process_time()
        proof = prove(path, scene)
        if proof.is_free:
            times.append(time.process_time() - began)
            postures.append(proof.postures)
            queries.append(proof.queries)
    print(
        f"10 s, {objects} objects, {kind}: median {1000 * statistics.median(times):.0f} ms, "
        f"at most {1000 * max(times):.0f} ms; {statistics.median(postures):.0f} postures, "
        f"{statistics.median(queries):.0f} distances ({len(times)} paths of {tried})"
    )


def gliding() -> None:
    """Print the postures of proofs 0.5 mm above a clearance of 5 mm."""
    node, flange = ROBOT.flange
    tool = shapes.box(0.06, 0.06, 0.12, frames.compose(flange, ((0.0, 0.0, 0.06), frames.UNIT)))
    kinematics = Kinematics.of(GROUP)
    assert kinematics is not None
    start = (0.0, 0.3, 0.1, 0.0, 1.0, 0.0)
    turn = Path.linear(np.array([0.0, 1.0]), np.array([(-1.5, *start[1:]), (1.5, *start[1:])]))
    report("one axis over a floor", turn, tool, (0.0, 0.0, 1.0), node)
    # A straight move of 300 mm along a table that is tilted by 20 degrees, at 100 mm/s.
    normal = (0.0, math.sin(0.35), math.cos(0.35))
    tilted = frames.about((1.0, 0.0, 0.0), -0.35)
    down = frames.multiply(tilted, (0.0, 0.0, 1.0, 0.0))
    along = frames.rotate(tilted, (0.0, 1.0, 0.0))
    times = np.arange(0, 3.0, 0.004)
    postures = []
    posture = (0.0, 0.0, 0.0, 0.0, 0.5, 0.0)
    for moved in (times * 0.1 - 0.15).tolist():
        place = frames.add((0.35, 0.0, 0.35), frames.scale(along, moved))
        found = (
            kinematics.follow((place, down), posture)
            if postures
            else kinematics.solutions((place, down), posture)[0]
        )
        assert found is not None
        posture = found
        postures.append(posture)
    report("MoveL over a tilted table", Path.sampled(times, np.array(postures)), tool, normal, node)


def report(title: str, path: Path, tool: shapes.Shape, normal: frames.Vector, node: int) -> None:
    """Prove a path above a plane that is 5.5 mm below its lowest point."""
    bodies = [Body("tool", node, (tool,)), Body("plane", WORLD, (shapes.half_space(normal),))]
    scene = Scene(TREE, bodies, [Pair(0, 1, 0.005)])
    samples = path.at(np.linspace(0, path.last, 2001))
    least = float(scene.body_distances(samples).min())
    moved = shapes.half_space(normal, frames.scale(normal, least - 0.0055))
    raised = Scene(TREE, [bodies[0], Body("plane", WORLD, (moved,))], [Pair(0, 1, 0.005)])
    proof = prove(path, raised)
    print(f"0.5 mm above the clearance, {title}: {proof.postures} postures, free: {proof.is_free}")


def write_cell(folder: FilePath) -> FilePath:
    """Write a cell with an IRB 120 whose drawing serves as `<collision>`."""
    text = URDF.read_text(encoding="utf-8")
    text = text.replace("<visual>", "<collision>").replace("</visual>", "</collision>")
    (folder / "arm.urdf").write_text(text, encoding="utf-8")
    robot = "model: irb120\nurdf: {file: arm.urdf}\ncontroller: {robotware: 6.15}\n"
    (folder / "robot.yaml").write_text(robot, encoding="utf-8")
    path = folder / "cell.yaml"
    path.write_text(CELL, encoding="utf-8")
    return path


def circle(count: int) -> list[frames.Vector]:
    """Return points (mm) of a circle of 80 mm, 0.5 mm apart."""
    angles = [0.5 * i / 80 for i in range(count + 1)]
    return [(380 + 80 * math.cos(a), 80 * math.sin(a), 205.0) for a in angles]


def walk(count: int) -> list[frames.Vector]:
    """Return random points (mm) of a box in reach, each 200 mm from the one before."""
    rng = np.random.default_rng(1)
    points: list[frames.Vector] = [(380.0, 0.0, 250.0)]
    while len(points) <= count:
        way = rng.normal(size=3)
        x, y, z = (np.array(points[-1]) + 200 * way / np.linalg.norm(way)).tolist()
        if 280 <= x <= 430 and abs(y) <= 150 and 205 <= z <= 400:
            points.append((x, y, z))
    return points


def write_program(path: FilePath, points: list[frames.Vector]) -> None:
    """Write a program that moves the TCP through points (mm)."""
    lines = ["MODULE bench", "  PROC main()", "    ConfL \\Off;", "    ConfJ \\Off;"]
    for index, (x, y, z) in enumerate(points):
        move = "MoveL" if index else "MoveJ"
        zone = "z1" if 0 < index < len(points) - 1 else "fine"
        target = f"[[{x:.3f},{y:.3f},{z:.3f}],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
        lines.append(f"    {move} {target}, v500, {zone}, tGrip;")
    lines += ["  ENDPROC", "ENDMODULE", ""]
    path.write_text("\n".join(lines), encoding="utf-8")


def seconds_of_run(program: FilePath, cell: FilePath, mode: str) -> float:
    """Return the CPU time of `rapidgen run` with or without the check."""
    words = ["run", str(program), "--cell", str(cell), "--collisions", mode, "--max-time", "3600"]
    said = io.StringIO()
    began = time.process_time()
    with contextlib.redirect_stderr(said):
        code = rapidgen(words)
    took = time.process_time() - began
    assert code == 0, said.getvalue()
    assert ("collisions:" in said.getvalue()) == (mode == "error")
    return took


def runs() -> None:
    """Print the CPU time that the check adds to runs of long programs."""
    with tempfile.TemporaryDirectory() as name:
        folder = FilePath(name)
        cell, program = write_cell(folder), folder / "bench.mod"
        write_program(program, circle(10))
        for mode in ("off", "error"):  # imports
            seconds_of_run(program, cell, mode)
        for title, points in (
            ("10,000 moves of 0.5 mm", circle(10_000)),
            ("1,000 moves of 200 mm", walk(1_000)),
        ):
            write_program(program, points)
            off, on = (seconds_of_run(program, cell, mode) for mode in ("off", "error"))
            print(f"run --cell, {title}: {on - off:.1f} s beyond {off:.1f} s, {on / off:.2f} times")


def main() -> None:
    """Run all cases."""
    trajectories("capsule", 20)
    trajectories("capsule", 200)
    trajectories("hull", 20)
    gliding()
    runs()


if __name__ == "__main__":
    main()
