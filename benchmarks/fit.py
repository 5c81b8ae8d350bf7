"""Curves as few moves on an IRB 6640-180/2.55: speed, moves, deviation, beside points by hand.

    python benchmarks/fit.py CURVE.csv ... [--in-place NAME ...]

Each CURVE has positions in mm and unit normals along the tool's z axis. Curves named with
--in-place stay in the robot's base frame; the place of the others is chosen. Tolerance 0.5 mm and 3
degrees, standard deviation of the speed at most 5 %, at most 60 moves.

The comparison is the fastest program of points at equal distances on the same placed curve, MoveL
with z10, or z1 if that is faster, within the same requirement and at most 60 moves (`--counts`
tries others), with the same leads before and after the curve. It has the place and the rotation
about the tool axis of the fit; `by hand` has tool x along the curve instead.

He et al. (arXiv 2301.02348) report more than 200 % improvement over their baseline on this robot
and curves 1 and 2.
"""

import argparse
import math
import time
from dataclasses import replace
from pathlib import Path

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Kinematics
from rapidgen.controller.mechanics import robots_named
from rapidgen.curves.curve import read_curve
from rapidgen.curves.fitting import Fit, Fitter, Requirement
from rapidgen.curves.placement import Placement, Placer

ROBOT = "IRB 6640-180/2.55"
TOOL = ((0.075, 0.0, 0.49330127019), frames.normalise((0.965925826, 0.0, 0.258819045, 0.0)))
WANTED = Requirement(0.0005, math.radians(3.0), 0.05, 60)
COUNTS = (20, 30, 40, 60)
ZONES = (0.01, 0.001)


def line(name: str, fit: Fit | None) -> str:
    """Return the figures of a program."""
    if fit is None or not fit.keeps(WANTED):
        return f"  {name:24} no program keeps the requirement"
    own = fit.prediction
    return (
        f"  {name:24} {1000 * own.mean_speed:7.1f} mm/s ± {100 * own.speed_deviation:3.1f} %, "
        f"{fit.moves:3} moves, {1000 * own.largest_deviation:.3f} mm, "
        f"{math.degrees(own.largest_angle):.2f} deg, {own.duration:.2f} s"
    )


def by_hand(placement: Placement, placer: Placer) -> Placement | None:
    """Return the same place with the tool's x axis along the curve at its start."""
    found = list(placer.candidates(placement.curve, 60, [(0.0, 0.0)]))
    if not found:
        return None
    speed, constant, rate, start = max(found, key=lambda candidate: candidate[0])
    return replace(placement, constant=constant, rate=rate, start=start, speed=speed)


def compare(path: Path, counts: tuple[int, ...], *, in_place: bool) -> None:
    """Print the fit of one curve and its comparisons."""
    group = robots_named(ROBOT)[0]
    kinematics = Kinematics.of(group)
    assert kinematics is not None
    placer = Placer(kinematics, TOOL)
    began = time.process_time()
    curve = read_curve(path)
    placement = placer.best(curve) if in_place else placer.place(curve)
    print(f"{path.stem}: {curve.length:.3f} m, {curve.points} points")
    if placement is None:
        print("  out of reach")
        return
    fitter = Fitter(group, TOOL, placement)
    fit = fitter.fit_fastest(WANTED)
    print(line("fit", fit), f"({time.process_time() - began:.0f} s of CPU)")
    spaced = best_spaced(fitter, counts)
    print(line("equally spaced", spaced))
    hand = by_hand(placement, placer)
    other = None if hand is None else best_spaced(Fitter(group, TOOL, hand), counts)
    print(line("equally spaced, by hand", other))
    for name, than in (("equally spaced", spaced), ("by hand", other)):
        if fit is not None and than is not None and than.keeps(WANTED):
            ratio = fit.prediction.mean_speed / than.prediction.mean_speed
            print(f"  {ratio:.2f} times the speed of {name}")


def best_spaced(fitter: Fitter, counts: tuple[int, ...]) -> Fit | None:
    """Return the fastest of the zones."""
    found = [fitter.fastest_equally_spaced(WANTED, counts, zone) for zone in ZONES]
    kept = [fit for fit in found if fit is not None and fit.keeps(WANTED)]
    return max(kept, key=lambda fit: fit.prediction.mean_speed, default=None)


def main() -> None:
    """Compare all given curves."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("curves", nargs="+", type=Path)
    parser.add_argument("--in-place", nargs="*", default=["blade"], metavar="NAME")
    parser.add_argument("--counts", nargs="*", type=int, default=list(COUNTS))
    given = parser.parse_args()
    for path in given.curves:
        compare(path, tuple(given.counts), in_place=path.stem in given.in_place)


if __name__ == "__main__":
    main()
