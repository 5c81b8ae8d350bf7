"""Accelerations that are assumed where no source has them.

Measured times from standstill to full speed are 0.23, 0.32, 0.15 s (axes 1 to 3) and 0.08, 0.07,
0.08 s (axes 4 to 6) for an IRB 6640, and 0.11, 0.13, 0.08 s and 0.07, 0.05, 0.07 s for an IRB 1200
(tables of hehonglu123/Robot_Acceleration_Identification). Others are assumed to lie between.
"""

MEASURED_BAND, ESTIMATED_BAND, ESTIMATED_AT_FULL_SPEED = 0.03, 0.16, 0.26
"""Relative errors that 90 % of the simulated durations are within.

Measured: 69 logs of an IRB 6640 with its own accelerations, 2.7 % (benchmarks/motion_logs.py).
Estimated: the same robot with accelerations that only an IRB 1200 gives, 15.6 %, at vmax 25.6 %;
an IRB 1200 with those of an IRB 6640 stays within 8.9 % and 11.5 % (benchmarks/error_bands.py)."""
ERROR_BAND = (
    f"simulated durations may be {ESTIMATED_BAND * 100:.0f} % off, "
    f"{ESTIMATED_AT_FULL_SPEED * 100:.0f} % at full speed"
)
WRIST = 0.07
"""s of axes 4 to 6."""
_SMALL, _LARGE = (1.0, 0.1), (2.7, 0.25)
"""Length of an arm (m) and s of its axes 1 to 3."""
_WRIST = ("rax_4", "rax_5", "rax_6")


def usual_time(axis: str, length: float) -> float:
    """Return the s that an axis needs from standstill to full speed.

    `length` is that of the arm in m, 0 if it is not known.
    """
    if axis in _WRIST:
        return WRIST
    if axis.startswith("eax") or not length:
        return _LARGE[1]
    (short, least), (long, most) = _SMALL, _LARGE
    share = min(1.0, max(0.0, (length - short) / (long - short)))
    return least + (most - least) * share
