"""Motion against logs: durations, paths, speeds and corners of an IRB 6640-180/2.55.

    python benchmarks/motion_logs.py FOLDER [--program NAME ...] [--half even|odd] [--json FILE]
    python benchmarks/motion_logs.py FOLDER --fit N

FOLDER holds `PROGRAM/SPEED_ZONE.mod` with `.robotstudio.csv.gz` and `.robot.csv.gz` (t in s,
joints in deg) and `durations.csv`. The data are those of hehonglu123/ABB_Primitive_Study. They
are not part of this repository. Every program runs on the virtual controller without sockets.

Figures of one log: total time, distance of the joint path to the nearest point of the logged one,
TCP speed at equal path length, joints at equal times, distance of the TCP from the programmed
corners, and corners in which one of both stops. The feedback of the real robot ends 35 ms after
the command (servo settling), so that its total times are compared with 35 ms more.

TCP speeds are means over 16 ms, and over 40 ms: the robot's samples are 8 ms apart, by a clock that
is up to 1.5 ms early or late. RobotStudio itself differs from the robot by 5.8 and 3.1 %.

`--fit N` chooses three constants on one of N logs (drawn) of every other program, each from three
values, and judges them on the programs between: the factor on the published accelerations, the
time of smoothing and the size of corners.
"""

import argparse
import csv
import gzip
import json
import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Executor, ProcessPoolExecutor
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from random import Random

import numpy as np
import numpy.typing as npt

from rapidgen.axes import frames
from rapidgen.axes.path_shapes import CircleMode
from rapidgen.config.model import GroupConfig
from rapidgen.controller.controller import VirtualController
from rapidgen.controller.mechanics import robots_named

Array = npt.NDArray[np.float64]
ROBOT = "IRB 6640-180/2.55"
PERIOD = 0.004
MOVED = 0.02
"""deg of an axis that count as movement, as in durations.csv."""
SETTLING = 0.035
"""s by which the feedback of the real robot ends after the command."""
CIRCLES = {"robotstudio": CircleMode.OBJECT, "robot": CircleMode.PATH}
"""How the orientation turns along circles in each source: the joint paths of all circular
programs agree within 0.02 deg so, and differ by 3 deg otherwise."""
WINDOWS = (2, 5)
"""Half of the periods over which a TCP speed is the mean."""
FITTED = {
    "factor": (1.0, 1.1, 1.2),
    "ramp_time": (0.07, 0.09, 0.11),
    "corner_size": (0.8, 0.87, 0.94),
}
"""Values to choose from of each constant; those in the middle are in use."""
STANDING = 0.03
"""Share of the log's top speed below which the TCP counts as standing."""
AROUND = 0.03
"""m of path around a corner in which a stop is looked for."""
_TOOL = re.compile(r"tooldata t:=\[TRUE,\[\[([^\]]*)\],\[([^\]]*)\]\]")
_POSE = re.compile(r"\[\[(-?\d+\.\d+),(-?\d+\.\d+),(-?\d+\.\d+)\],\[-?\d\.\d+,")


@dataclass(frozen=True, slots=True)
class Case:
    """One program with its logs."""

    name: str
    speed: str
    zone: str
    path: Path
    seconds: dict[str, float]
    start: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Figures:
    """What one log shows; angles in deg, lengths in mm."""

    case: str
    program: str
    speed: str
    zone: str
    source: str
    time: float
    """Relative error of the total time."""
    path: float
    tcp_speed: float
    tcp_speed_40: float
    """The same over 40 ms."""
    joints: float
    corners: tuple[float, ...]
    """Difference of the deviation from each programmed corner."""
    stops: int
    """Corners in which only the model stops."""
    passes: int
    """Corners in which only the log stops."""


def cases(folder: Path) -> list[Case]:
    """All programs of the folder."""
    rows: dict[tuple[str, str, str], dict[str, float]] = defaultdict(dict)
    starts = {}
    with (folder / "durations.csv").open(newline="", encoding="ascii") as file:
        for row in csv.DictReader(file):
            key = row["program"], row["speed"], row["zone"]
            rows[key][row["source"]] = float(row["seconds"])
            starts[key] = tuple(float(v) for v in row["start_deg"].split())
    return [
        Case(*key, folder / key[0] / f"{key[1]}_{key[2]}.mod", seconds, starts[key])
        for key, seconds in rows.items()
    ]


def read_log(path: Path) -> tuple[Array, Array]:
    """Times (s) and joints (deg) of a log."""
    with gzip.open(path, "rt", encoding="ascii") as file:
        values = np.loadtxt(file, delimiter=",", skiprows=1)
    return values[:, 0], values[:, 1:]


class Forward:
    """Forward kinematics of many postures: the TCP in m."""

    def __init__(self, group: GroupConfig, tool: frames.Vector) -> None:
        self._links = group.chain
        self._tool = np.array(tool)

    def __call__(self, joints: Array) -> Array:
        q = np.radians(joints)
        turn = np.broadcast_to(np.eye(3), (len(q), 3, 3))
        place = np.zeros((len(q), 3))
        axis = 0
        for link in self._links:
            place = place + turn @ np.array(link.xyz)
            turn = turn @ _fixed(*link.rpy)
            if link.joint:
                turn = turn @ _about(np.array(link.axis), q[:, axis])
                axis += 1
        result: Array = place + turn @ self._tool
        return result


def _fixed(roll: float, pitch: float, yaw: float) -> Array:
    result: Array = (
        _about(np.array([0.0, 0.0, 1.0]), np.array([yaw]))[0]
        @ _about(np.array([0.0, 1.0, 0.0]), np.array([pitch]))[0]
        @ _about(np.array([1.0, 0.0, 0.0]), np.array([roll]))[0]
    )
    return result


def _about(axis: Array, angles: Array) -> Array:
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    s, c = np.sin(angles)[:, None, None], np.cos(angles)[:, None, None]
    result: Array = np.eye(3) + s * cross + (1 - c) * (cross @ cross)
    return result


def run(
    case: Case,
    circle: CircleMode,
    change: Callable[[GroupConfig], GroupConfig] | None = None,
    **settings: float,
) -> tuple[Array, Array, int]:
    """Times, joints (deg) and number of corner path failures of a program on the controller."""
    (config,) = robots_named(ROBOT)
    if change is not None:
        config = change(config)
    controller = VirtualController.from_files(
        {"T_ROB1": [case.path]}, robots=[config], cycle="once"
    )
    if settings:
        controller.motion.settings = replace(controller.motion.settings, **settings)
    group = controller.motion.group(config.name)

    def turn() -> None:
        group.modal.circle = circle

    group.on_reset.append(turn)
    group.jump(tuple(np.radians(case.start).tolist()))
    recorder = controller.record()[config.name]
    outcome = controller.run(max_time=200.0)
    recording = recorder.recording(PERIOD)
    controller.close()
    if outcome != "finished":
        raise RuntimeError(f"{case.path}: {outcome}\n" + "\n".join(map(str, controller.log)))
    failures = sum(entry.code == 50_024 for entry in controller.log)
    return recording.time, np.degrees(recording.commanded), failures


def trimmed(time: Array, joints: Array) -> tuple[Array, Array]:
    """From the last sample before the first movement to the first one after the last movement."""
    away = np.max(np.abs(joints - joints[0]), axis=1) > MOVED
    left = np.max(np.abs(joints - joints[-1]), axis=1) > MOVED
    first, last = int(np.argmax(away)), len(left) - 1 - int(np.argmax(left[::-1]))
    begin = _crossing(time, joints, joints[0], first - 1)
    end = _crossing(time, joints, joints[-1], last)
    inside = slice(max(0, first - 1), last + 2)
    return np.append(time[inside], [begin, end]), joints[inside]


def _crossing(time: Array, joints: Array, rest: Array, before: int) -> float:
    """When the largest distance from a posture crosses the threshold after a sample."""
    a, b = (float(np.max(np.abs(joints[k] - rest))) for k in (before, before + 1))
    part = (MOVED - a) / (b - a) if a != b else 0.0
    return float(time[before] + part * (time[before + 1] - time[before]))


def nearest(points: Array, line: Array) -> Array:
    """Distance of points to a polyline."""
    a, d = line[:-1], np.diff(line, axis=0)
    square = np.maximum(np.sum(d * d, axis=1), 1e-18)
    along = np.sum(a * d, axis=1)
    own = np.sum(a * a, axis=1)
    result = np.empty(len(points))
    for first in range(0, len(points), 64):
        part = points[first : first + 64]
        projected = part @ d.T - along
        offset = np.sum(part * part, axis=1)[:, None] - 2 * part @ a.T + own
        share = np.clip(projected / square, 0.0, 1.0)
        rest = offset - share * (2 * projected - share * square)
        result[first : first + 64] = np.sqrt(np.maximum(0.0, np.min(rest, axis=1)))
    return result


def speeds(time: Array, tcp: Array, half: int) -> tuple[Array, Array, Array]:
    """Path length, place and mean speed of a TCP over twice `half` periods, m and s."""
    even = np.arange(time[0], time[-1], PERIOD)
    place = np.stack([np.interp(even, time, tcp[:, k]) for k in range(3)], axis=1)
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(place, axis=0), axis=1))])
    speed = np.linalg.norm(place[2 * half :] - place[: -2 * half], axis=1) / (2 * half * PERIOD)
    return length[half:-half], place[half:-half], speed


def corner_points(case: Case, text: str) -> Array:
    """Ends of the moves between the first and the last, m."""
    points = []
    for line in text.splitlines():
        if line.startswith(("MoveL", "MoveC")):
            points.append([float(v) / 1000 for v in _POSE.findall(line)[-1]])
    return np.array(points[:-1]).reshape(-1, 3)


def compare(case: Case, source: str, result: tuple[Array, Array, int], tcp: Forward) -> Figures:
    """The figures of one log."""
    time, joints, _failures = result
    log_time, log = read_log(case.path.with_suffix(f".{source}.csv.gz"))
    own_ends, own = trimmed(time, joints)
    ends, logged = trimmed(log_time, log)
    own_begin, own_end = own_ends[-2:]
    begin, end = ends[-2:]
    own_time, log_time = own_ends[:-2], ends[:-2]
    total = own_end - own_begin + (SETTLING if source == "robot" else 0.0)
    # joints at equal times from the first movement on
    grid = np.arange(0.0, min(end - begin, own_end - own_begin), PERIOD)
    differences = np.stack(
        [
            np.interp(grid + own_begin, own_time, own[:, k])
            - np.interp(grid + begin, log_time, logged[:, k])
            for k in range(own.shape[1])
        ]
    )
    # TCP speed at equal path length
    points, log_points = tcp(own), tcp(logged)
    differences_of_speed = []
    for half in reversed(WINDOWS):
        s, place, v = speeds(own_time, points, half)
        t, log_place, w = speeds(log_time, log_points, half)
        share = np.linspace(0.0, 1.0, 500)
        mine, theirs = np.interp(share, s / s[-1], v), np.interp(share, t / t[-1], w)
        error = np.sqrt(np.mean((mine - theirs) ** 2)) / np.sqrt(np.mean(theirs**2))
        differences_of_speed.append(float(error))
    over_40, over_16 = differences_of_speed
    corners, stops, passes = [], 0, 0
    if case.zone != "fine":
        for point in corner_points(case, case.path.read_text(encoding="ascii")):
            own_near, own_stop = _at_corner(point, place, s, v)
            log_near, log_stop = _at_corner(point, log_place, t, w)
            corners.append((own_near - log_near) * 1000)
            stops += own_stop and not log_stop
            passes += log_stop and not own_stop
    return Figures(
        f"{case.name}/{case.speed}_{case.zone}",
        case.name,
        case.speed,
        case.zone,
        source,
        total / case.seconds[source] - 1.0,
        float(np.percentile(nearest(own, logged), 95)),
        over_16,
        over_40,
        float(np.percentile(np.max(np.abs(differences), axis=0), 95)),
        tuple(corners),
        stops,
        passes,
    )


def _at_corner(point: Array, place: Array, length: Array, speed: Array) -> tuple[float, bool]:
    """Distance of a TCP path from a point, and whether the TCP stops near it."""
    closest = int(np.argmin(np.linalg.norm(place - point, axis=1)))
    around = np.abs(length - length[closest]) < AROUND
    stands = float(np.min(speed[around])) < STANDING * float(np.max(speed))
    near = float(nearest(point[None, :], place)[0])
    return near, stands


def with_factor(factor: float, config: GroupConfig) -> GroupConfig:
    """The robot with another factor on the published accelerations."""
    (_least, used, _most) = FITTED["factor"]
    more = factor / used
    joints = tuple(replace(j, acceleration=j.acceleration * more) for j in config.joints)
    inertias = tuple(
        replace(
            inertia,
            most=inertia.most * more,
            constant=inertia.constant / more,
            elbow=inertia.elbow / more,
            wrist=inertia.wrist / more,
            cosine=inertia.cosine / more,
            sine=inertia.sine / more,
        )
        for inertia in config.inertias
    )
    return replace(config, joints=joints, inertias=inertias)


def judge(case: Case, constants: Mapping[str, float] | None = None) -> list[Figures] | str:
    """The figures of all logs of a program, or why it did not run."""
    settings = dict(constants or {})
    factor = settings.pop("factor", None)
    change = None if factor is None else partial(with_factor, factor)
    text = case.path.read_text(encoding="ascii")
    try:
        results = {}
        for source in case.seconds:
            same = "MoveC" not in text and results
            results[source] = (
                results["robotstudio"] if same else run(case, CIRCLES[source], change, **settings)
            )
    except RuntimeError as fault:
        return str(fault).replace("\n", " ")
    (config,) = robots_named(ROBOT)
    match = _TOOL.search(text)
    assert match is not None
    x, y, z = (float(v) / 1000 for v in match[1].split(","))
    tcp = Forward(config, (x, y, z))
    return [compare(case, source, result, tcp) for source, result in results.items()]


def spread(values: Iterable[float], factor: float = 1.0, unit: str = "") -> str:
    """Median, 90th percentile and largest of magnitudes."""
    sizes = np.abs(np.array(list(values))) * factor
    if not len(sizes):
        return "none"
    middle, most, worst = np.percentile(sizes, 50), np.percentile(sizes, 90), np.max(sizes)
    return f"{middle:.2f} / {most:.2f} / {worst:.2f}{unit} ({len(sizes)})"


def report(rows: list[Figures]) -> Iterable[str]:
    """The figures as text: median / 90th percentile / worst (count)."""
    for source in ("robotstudio", "robot"):
        own = [row for row in rows if row.source == source]
        yield f"{source}: total time {spread((r.time for r in own), 100, ' %')}"
        for speed in ("v50", "v300", "v500", "v1000", "v1500", "vmax"):
            times = [row.time for row in own if row.speed == speed]
            mean = np.mean(times) * 100 if times else 0.0
            yield f"  {speed}: {spread(times, 100, ' %')}, mean {mean:+.2f} %"
        for zone in ("fine", "z1", "z10", "z20", "z50", "z100", "z200", "z500"):
            times = [row.time for row in own if row.zone == zone]
            if times:
                yield f"  {zone}: {spread(times, 100, ' %')}, mean {np.mean(times) * 100:+.2f} %"
        for name in dict.fromkeys(row.program for row in own):
            times = [row.time for row in own if row.program == name]
            yield f"  {name}: {spread(times, 100, ' %')}, mean {np.mean(times) * 100:+.2f} %"
        yield f"  joint path, nearest point, p95: {spread((r.path for r in own), 1, ' deg')}"
        yield f"  TCP speed at equal length, RMS: {spread((r.tcp_speed for r in own), 100, ' %')}"
        yield f"  the same over 40 ms: {spread((r.tcp_speed_40 for r in own), 100, ' %')}"
        yield f"  joints at equal times, p95: {spread((r.joints for r in own), 1, ' deg')}"
        yield f"  corner deviation: {spread((c for r in own for c in r.corners), 1, ' mm')}"
        stops, passes = sum(r.stops for r in own), sum(r.passes for r in own)
        yield f"  corners where only the model stops {stops}, passes {passes}"


def fit(pool: Executor, chosen: list[Case]) -> dict[str, float]:
    """Choose each constant in turn: by the total times, for the corners by their deviation."""
    constants = {name: values[1] for name, values in FITTED.items()}
    for name, values in FITTED.items():
        errors = {}
        for value in values:
            tried = {**constants, name: value}
            rows = figures(pool, chosen, tried)
            if name == "corner_size":
                errors[value] = float(np.mean([abs(c) for row in rows for c in row.corners]))
            else:
                errors[value] = float(np.mean([abs(row.time) for row in rows]))
            print(f"{name} {value}: {errors[value]:.4f} ({len(rows)} logs)", flush=True)
        constants[name] = min(errors, key=errors.__getitem__)
    return constants


def figures(
    pool: Executor, chosen: list[Case], constants: Mapping[str, float] | None = None
) -> list[Figures]:
    """The figures of all logs of some programs; those that do not run are printed."""
    results = list(pool.map(partial(judge, constants=constants), chosen, chunksize=4))
    for case, result in zip(chosen, results, strict=True):
        if isinstance(result, str):
            print(f"{case.name}/{case.speed}_{case.zone} did not run: {result}")
    return [row for result in results if not isinstance(result, str) for row in result]


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--program", action="append", default=[])
    parser.add_argument("--half", choices=("even", "odd"))
    parser.add_argument("--json", type=Path)
    parser.add_argument("--fit", type=int, metavar="N")
    given = parser.parse_args()
    chosen = cases(given.folder)
    names = sorted({case.name for case in chosen})
    if given.half:
        names = names[given.half == "odd" :: 2]
    names = [name for name in names if not given.program or name in given.program]
    chosen = [case for case in chosen if case.name in names]
    with ProcessPoolExecutor() as pool:
        constants = None
        if given.fit:
            fitted = [case for case in chosen if case.name in names[::2]]
            constants = fit(pool, Random(0).sample(fitted, len(fitted) // given.fit))
            print(f"chosen on {', '.join(names[::2])}: {constants}; judged on the others:")
            chosen = [case for case in chosen if case.name in names[1::2]]
        rows = figures(pool, chosen, constants)
    print("\n".join(report(rows)))
    if given.json:
        given.json.write_text(json.dumps([asdict(row) for row in rows]), encoding="utf-8")


if __name__ == "__main__":
    main()
