"""Lag that a client of EGM measures, against plants that it does not know.

    python benchmarks/egm_lag.py [--plants N] [--seed N]

Each plant has a random gain (5 to 20/s), low pass (10 to 100 Hz) and dead time (8 to 50 ms), and is
guided on the virtual clock for 6 s, along sines of random amplitude and frequency on each axis. The
true lag is the dead time and the cycle in which an answer counts. The residual is the p99 of the
distance between measured position and delayed reference, of all plants.
"""

import argparse
import math
import random
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.axes.mapping import JointMap
from rapidgen.client.egm.envelope import Envelope
from rapidgen.client.egm.exchange import PartnerExchange, Target
from rapidgen.client.egm.lag import LagMeter
from rapidgen.config import load_config
from rapidgen.motion.egm.exchange import Activate, Exchange, Inputs, StartRun
from rapidgen.motion.egm.guide import JOINT_NAMES, Activation, GuidedRobot, Run
from rapidgen.motion.egm.law import CYCLE, Profile
from rapidgen.motion.egm.sessions import PartnerLink

SECONDS = 6.0
GROUP = load_config("irb120").groups[0]
CLOSE = ((-0.01, 0.01),) * 6
START = (0.0, 0.0, 0.0, 0.0, 0.5, 0.0)


def plant(chance):
    """Return (measured lag, true lag, residual) of a random plant, s and degrees."""
    dead_time = chance.uniform(0.008, 0.050)
    gain, bandwidth = chance.uniform(5, 20), chance.uniform(10, 100)
    joint_map = JointMap.of(GROUP)
    lower = tuple(joint.lower for joint in GROUP.joints)
    upper = tuple(joint.upper for joint in GROUP.joints)
    robot = GuidedRobot(joint_map, None, lower, upper, dead_time)
    exchange = Exchange(robot, (7, 16), Profile(gain=gain, bandwidth=bandwidth), "PC")
    exchange.execute(Activate(Activation("Joint", bandwidth, max_speed=10.0, convergence=CLOSE)))
    exchange.execute(StartRun(Run(JOINT_NAMES[:6], gain, condition_time=600.0)))
    partner, meter = PartnerExchange(joint_map, Envelope.of(GROUP), 0.1), LagMeter()
    sines = [(chance.uniform(0.02, 0.2), chance.uniform(0.1, 0.4)) for _ in START]
    now = 0.0

    def answer(frame):
        message = partner.answer(frame, now)
        meter.add(partner.state())
        return message

    link = PartnerLink(answer)
    position = START
    for _ in range(round(SECONDS / CYCLE)):
        # A soft start, as of a careful caller: the amplitude grows over a second.
        part = min(1.0, now)
        target = [
            q + part * a * math.sin(math.tau * f * now)
            for q, (a, f) in zip(START, sines, strict=True)
        ]
        partner.execute(Target(now, tuple(target)))
        inputs = Inputs(position, position, motors_on=True, program_runs=True)
        position = exchange.cycle(link, inputs, now).position or position
        now += CYCLE
    lag = meter.lag()
    true = round(dead_time / CYCLE) * CYCLE + CYCLE
    return lag.seconds, true, math.degrees(lag.residual)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--plants", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    words = parser.parse_args()
    rows = [plant(random.Random(f"{words.seed} {i}")) for i in range(words.plants)]
    errors = sorted(abs(measured - true) for measured, true, _ in rows)
    residuals = sorted(residual for _, _, residual in rows)
    print(f"{len(rows)} plants: lag wrong by at most {errors[-1] * 1e3:.2f} ms")
    middle = residuals[int(0.99 * len(residuals))]
    print(f"residual p99 {middle:.3f} degrees, worst {residuals[-1]:.3f}")


if __name__ == "__main__":
    main()
