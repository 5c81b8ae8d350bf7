"""Run the driver's test cases on robots with other accelerations than it was built for.

    python -m tools.other_accelerations [FACTOR ...] [--robot NAME] [--set KEY=VALUE ...]

The driver is built from a configuration; the controller moves a robot whose axes have FACTOR times
its accelerations (0.5, 1 and 2 by default). Durations with \\T, ceilings, prefixes and stops have
to hold all the same. Cases that compute zones from the accelerations themselves do not count.
"""

import argparse
import sys
from dataclasses import replace

from rapidgen.config import load_config
from rapidgen.config.model import AxisInertia, RobotConfig
from rapidgen.controller.cell import in_its_cell
from rapidgen.generate import build, make_system
from rapidgen.verification.settings import Setting
from rapidgen.verification.suite import CASES
from rapidgen.verification.suite_runner import Starter

OF_ACCELERATIONS = {
    "corners",
    "corners-slowed",
    "largest-corner",
    "resting-corner",
}
"""Cases that compute each zone from the accelerations."""


def with_accelerations(config: RobotConfig, factor: float) -> RobotConfig:
    """Return a configuration whose axes have `factor` times their accelerations."""
    groups = tuple(
        replace(
            group,
            joints=tuple(replace(j, acceleration=j.acceleration * factor) for j in group.joints),
            inertias=tuple(_scaled(inertia, factor) for inertia in group.inertias),
        )
        for group in config.groups
    )
    return replace(config, groups=groups)


def _scaled(inertia: AxisInertia, factor: float) -> AxisInertia:
    """An acceleration is the inverse of a sum of inertias."""
    return replace(
        inertia,
        most=inertia.most * factor,
        constant=inertia.constant / factor,
        elbow=inertia.elbow / factor,
        wrist=inertia.wrist / factor,
        cosine=inertia.cosine / factor,
        sine=inertia.sine / factor,
    )


def main() -> None:
    """Print the cases that fail at each factor."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("factors", nargs="*", type=float, default=[0.5, 1.0, 2.0])
    parser.add_argument("--robot", default="irb120")
    parser.add_argument("--set", action="append", default=[])
    given = parser.parse_args()
    config = load_config(given.robot, overrides=tuple(given.set))
    system = in_its_cell(make_system(config, build(config), open_words=True), config)
    failed = False
    for factor in given.factors:
        starter = Starter(with_accelerations(config, factor), system, Setting())
        count = 0
        for case in CASES:
            verdict = starter.attempt(case)
            count += not verdict.untried
            if not (verdict.passed or verdict.untried or case.name in OF_ACCELERATIONS):
                failed = True
                print(f"accelerations x {factor:g}: {case.name}: {verdict.detail}", flush=True)
        starter.close()
        print(f"accelerations x {factor:g}: {count} cases", flush=True)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
