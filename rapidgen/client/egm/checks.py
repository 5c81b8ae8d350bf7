"""Checks of a set-up of externally guided motion, from the frames that have come.

Sources: the fields and their releases [manual 3HAC073318, 3.1.3 and revisions]; mixed units before
RobotWare 6.07 [code: ros-industrial/abb_libegm, egm_base_interface.cpp]; frames at 4.032 ms.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median
from typing import Literal

import numpy as np

from rapidgen.client.egm.envelope import Envelope
from rapidgen.client.egm.exchange import EgmState

Verdict = Literal["ok", "warn", "fail", "unknown"]
_FEWEST = 25
"""Frames for figures."""
_FAR = 0.05
"""rad or m between measured and planned joints that is more than a lag."""


@dataclass(frozen=True, slots=True)
class SetUpCheck:
    """One check, and the help if it is not ok."""

    area: str
    verdict: Verdict
    found: str
    help: str = ""


@dataclass(frozen=True, slots=True)
class Figures:
    """Figures of frames; times in s."""

    frames: int
    period: float
    """By the controller's clock, median."""
    arrival: float
    """p99 of the distance between two arrivals."""
    answer: float
    """From the arrival of a frame to its answer, median."""
    slowest: float
    """The same, p99."""
    missed: int
    utilization: float
    """Highest, per cent."""

    @property
    def rate(self) -> float:
        """Return the frames per second; 0: the controller's clock stands."""
        return 1 / self.period if self.period > 0 else 0.0


def figures(states: Sequence[EgmState]) -> Figures | None:
    """Return the figures of consecutive states; None: too few."""
    if len(states) < _FEWEST:
        return None
    clock = np.diff([state.controller_time for state in states])
    numbers = np.diff([state.sequence for state in states])
    # A state that the caller did not get is a gap, but no late frame.
    follows = numbers == 1
    arrivals = np.diff([state.time for state in states])[follows]
    periods = clock[follows]
    if not len(periods):
        return None
    answers = [state.answer_time for state in states]
    return Figures(
        frames=len(states),
        period=float(np.median(periods)),
        arrival=float(np.percentile(arrivals, 99)),
        answer=median(answers),
        slowest=float(np.percentile(answers, 99)),
        missed=states[-1].missed,
        utilization=max(state.utilization for state in states),
    )


def check_set_up(states: Sequence[EgmState], envelope: Envelope) -> tuple[SetUpCheck, ...]:
    """Return the checks of consecutive states, at least one."""
    last = states[-1]
    return (
        _release(last),
        _rate(figures(states)),
        _answers(figures(states)),
        _feedback(last, envelope),
        _planned(last),
        _state(last),
        _utilization(states),
    )


def _release(state: EgmState) -> SetUpCheck:
    major, minor = state.release
    if state.release == (0, 0):
        return SetUpCheck(
            "release",
            "fail",
            "frames without a time: RobotWare before 6.07 mixes rad and deg",
            "update the controller to RobotWare 6.07.01 or later",
        )
    return SetUpCheck("release", "ok", f"RobotWare {major}.{minor:02d} or later, by its fields")


def _rate(found: Figures | None) -> SetUpCheck:
    if found is None:
        return SetUpCheck(
            "rate", "unknown", "too few frames", "measure longer: --seconds, and EGMRun is executed"
        )
    text = (
        f"{found.rate:.0f} Hz, {found.period * 1000:.1f} ms "
        f"between frames; arrivals p99 {found.arrival * 1000:.1f} ms"
    )
    if found.period > 0.006:
        return SetUpCheck("rate", "warn", text, r"\SampleRate:=4 of EGMAct gives 250 Hz")
    if found.arrival > 2 * found.period:
        return SetUpCheck(
            "rate", "warn", text, "use a cable and no switch with other load; end busy programs"
        )
    return SetUpCheck("rate", "ok", text)


def _answers(found: Figures | None) -> SetUpCheck:
    if found is None:
        return SetUpCheck("answers", "unknown", "too few frames")
    text = (
        f"{found.answer * 1000:.2f} ms after the frame, p99 {found.slowest * 1000:.2f} ms; "
        f"{found.missed} missed"
    )
    if found.missed > found.frames // 100 or found.slowest > 0.002:
        return SetUpCheck("answers", "warn", text, "end busy programs on this computer")
    return SetUpCheck("answers", "ok", text)


def _feedback(state: EgmState, envelope: Envelope) -> SetUpCheck:
    for name, value, low, high in zip(
        envelope.names, state.joints, envelope.lower, envelope.upper, strict=True
    ):
        if not low <= value <= high:
            return SetUpCheck(
                "feedback",
                "fail",
                f"{name} = {value:.3f} is outside of {low:.3f} to {high:.3f}",
                "is this the configuration of this robot?",
            )
    pose = (
        "no pose"
        if state.pose is None
        else "TCP at {:.3f}, {:.3f}, {:.3f} m".format(*state.pose[0])
    )
    return SetUpCheck("feedback", "ok", f"{len(state.joints)} joints within their ranges; {pose}")


def _planned(state: EgmState) -> SetUpCheck:
    far = max(abs(a - b) for a, b in zip(state.joints, state.planned, strict=True))
    text = f"measured and planned joints differ by {far:.4f}"
    if far > _FAR:
        return SetUpCheck("planned", "warn", text, "the robot is moved by something else, or lags")
    return SetUpCheck("planned", "ok", text)


def _state(state: EgmState) -> SetUpCheck:
    text = ", ".join(
        (
            "motors on" if state.motors_on else "motors off",
            "program runs" if state.program_runs else "program stopped",
            "guidance active" if state.guided else "guidance not active",
        )
    )
    if state.guided:
        return SetUpCheck("state", "ok", text)
    return SetUpCheck("state", "warn", text, "the program executes EGMRunJoint or EGMRunPose")


def _utilization(states: Sequence[EgmState]) -> SetUpCheck:
    highest = max(state.utilization for state in states)
    text = f"utilization at most {highest:.0f} per cent"
    if highest > 100:
        return SetUpCheck(
            "utilization",
            "warn",
            text,
            "above 100 the controller shortens motions: send slower ones",
        )
    return SetUpCheck("utilization", "ok", text)
