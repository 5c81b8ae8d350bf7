"""\\T: how fast a way must be gone for its whole time, ramps at rest included."""

from math import inf, sqrt

SHORTEST = 1e-4
"""s of nominal time that the shortest way takes."""


def timed(total: float, fastest: float, acceleration: float, ramps: float) -> float:
    """Nominal time of a way whose whole time is to be `total` s.

    `fastest` is the nominal time at the axes' full speed, `acceleration` the way's share per
    s^2, `ramps` half the number of ends at rest: total = 1/c + ramps c / acceleration for a
    speed of c ways per s. Where no speed does it, the best that the limits allow.
    """
    if ramps == 0.0 or acceleration == inf:
        return max(total, fastest, SHORTEST)
    square = total * total - 4 * ramps / acceleration
    if total <= 0.0 or square <= 0.0:
        return max(fastest, sqrt(ramps / acceleration), SHORTEST)
    speed = acceleration * (total - sqrt(square)) / (2 * ramps)
    return max(fastest, 1 / speed)
