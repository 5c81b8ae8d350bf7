"""Error of a duration where a robot's accelerations are estimated from its size.

    python benchmarks/error_bands.py FOLDER [--part N]

Two models have measured accelerations, the IRB 6640-180/2.55 and the IRB 1200. Each in turn is
planned with what the other one alone would give it: the mean time of its axes 1 to 3 from
standstill to full speed, in proportion to the length of the arm, and the mean time of its wrist
axes. The IRB 6640 is judged on logs (those of benchmarks/motion_logs.py in FOLDER, every N-th
program), the IRB 1200 on random paths that are planned with its measured accelerations.

`ESTIMATED_BAND` in rapidgen/config/accelerations.py is the larger 90th percentile of both.
"""

import argparse
import random
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from motion_logs import CIRCLES, SETTLING, Case, cases, run, spread, trimmed

from rapidgen.config import load_config
from rapidgen.config.model import GroupConfig
from rapidgen.config.plausibility import length_of
from rapidgen.controller.controller import VirtualController

MEASURED = ("irb6640_180_255", "irb1200")
WRIST = ("rax_4", "rax_5", "rax_6")
SPEEDS = ("v100", "v300", "v500", "v1000", "v2500", "v7000")
ZONES = ("fine", "z1", "z10", "z50")
PATHS = 120


def estimated_from(other: str, group: GroupConfig) -> GroupConfig:
    """Return a group with the accelerations that only one other model would give it."""
    (known,) = load_config(other).groups

    def mean(*, wrist: bool) -> float:
        times = [j.speed / j.acceleration for j in known.joints if (j.axis in WRIST) is wrist]
        return sum(times) / len(times)

    main = mean(wrist=False) * length_of(group.chain) / length_of(known.chain)
    times = [mean(wrist=True) if j.axis in WRIST else main for j in group.joints]
    joints = tuple(
        replace(j, acceleration=j.speed / time) for j, time in zip(group.joints, times, strict=True)
    )
    return replace(group, joints=joints, inertias=(), acceleration_source="")


def against_logs(case: Case) -> list[tuple[str, float]]:
    """Relative errors of the total time of one program of the IRB 6640, with its speed."""
    rows = []
    for source, seconds in case.seconds.items():
        change = partial(estimated_from, "irb1200")
        time, joints, _failures = run(case, CIRCLES[source], change)
        begin, end = trimmed(time, joints)[0][-2:]
        total = end - begin + (SETTLING if source == "robot" else 0.0)
        rows.append((case.speed, total / seconds - 1.0))
    return rows


def program(rng: random.Random) -> tuple[str, str]:
    """Return a random path of an IRB 1200 in RAPID, and its speed."""
    speed, zone = rng.choice(SPEEDS), rng.choice(ZONES)
    size = rng.choice((20.0, 80.0, 250.0))
    lines = ["MODULE m", "PROC main()", "VAR robtarget p;"]
    lines.append("MoveAbsJ [[0,10,10,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vmax,fine,tool0;")
    lines.append("p := CRobT(\\Tool:=tool0 \\WObj:=wobj0); ClkReset k; ClkStart k;")
    count = rng.randint(1, 6)
    for k in range(count):
        offset = ",".join(f"{rng.uniform(-size, size):.1f}" for _ in range(3))
        move = rng.choice(("MoveL", "MoveL", "MoveJ"))
        end = zone if k < count - 1 else "fine"
        lines.append(f"{move} Offs(p,{offset}),{speed},{end},tool0;")
    lines += ["ClkStop k; seconds := ClkRead(k);", "ENDPROC"]
    lines.insert(1, "VAR clock k; PERS num seconds := 0;")
    return "\n".join([*lines, "ENDMODULE"]), speed


def seconds(text: str, group: GroupConfig) -> float | None:
    """Duration of a program; None: it does not end."""
    with TemporaryDirectory() as folder:
        path = Path(folder, "m.mod")
        path.write_text(text, encoding="ascii")
        controller = VirtualController.from_files({"T_ROB1": [path]}, robots=[group], cycle="once")
        outcome = controller.run(max_time=200.0)
        value = controller.tasks["T_ROB1"]["seconds"] if outcome == "finished" else None
        controller.close()
    return None if value is None else float(value)


def against_model(seed: int) -> tuple[str, float] | None:
    """Relative error of the duration of a random path of the IRB 1200, with its speed."""
    (group,) = load_config("irb1200").groups
    text, speed = program(random.Random(seed))
    times = [seconds(text, g) for g in (group, estimated_from("irb6640_180_255", group))]
    if not times[0] or not times[1]:
        return None  # out of reach
    return speed, times[1] / times[0] - 1.0


def report(title: str, rows: Sequence[tuple[str, float]]) -> None:
    """Print median, 90th percentile and worst: all, and by speed."""
    print(f"{title}: {spread((e for _, e in rows), 100, ' %')}")
    for speed in dict.fromkeys(s for s, _ in rows):
        own = [e for s, e in rows if s == speed]
        print(f"  {speed}: {spread(own, 100, ' %')}, mean {np.mean(own) * 100:+.1f} %")


def main() -> None:
    """Print the bands."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--part", type=int, default=1)
    given = parser.parse_args()
    chosen = cases(given.folder)[:: given.part]
    with ProcessPoolExecutor() as pool:
        logs = [row for rows in pool.map(against_logs, chosen, chunksize=4) for row in rows]
        made = pool.map(against_model, range(PATHS), chunksize=8)
        paths = [row for row in made if row is not None]
    report("IRB 6640-180/2.55 estimated from the IRB 1200, against logs", logs)
    report("IRB 1200 estimated from the IRB 6640-180/2.55, against its measured model", paths)


if __name__ == "__main__":
    main()
