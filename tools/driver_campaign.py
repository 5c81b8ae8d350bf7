"""Long runs of the driver: malformed frames, and days of virtual time.

    python tools/driver_campaign.py frames [--count N] [--boundary SHARE] [--jobs N]
                                           [--results FILE] [ROBOT]
    python tools/driver_campaign.py days [--hours N] [--watched SHARE] [ROBOT]

`frames`: N (default 200,000) hostile first messages on all ports, under the strictest assumptions
together. In SHARE of them (default half) half of the fields have boundary values. The driver must
serve a well-behaved client after each; no message may move the robot or end a task. FILE (JSON
lines) stores the results: the next call continues. `days`: N simulated hours (default 24) with a
trajectory every ten minutes; a client reads the state for SHARE of the time (default all of it),
and each STATUS must arrive within one period of its schedule. Memory is checked every hour.
"""

import argparse
import gc
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.rapid.switches import parse_switches
from rapidgen.verification.messages import STATUS
from rapidgen.verification.settings import Setting
from rapidgen.verification.suite.hostile_clients import campaign
from rapidgen.verification.testbench import FAILURES, Bench
from tools.campaigns import outcomes

CHUNK = 500
"""First messages for one controller."""
STRICT = parse_switches(
    "unpack_ulint=error,argument_error=fatal,pack_beyond=error,negative_mod=error"
)
"""Besides the default, under which an unhandled error ends its task."""
ROUND = 600.0
"""Simulated s between trajectories."""


def frames_of(_, seed):
    """Return the failure of one controller's share; empty: none."""
    bench = Bench(CONFIG, SYSTEM, Setting(seed=seed, dialect=STRICT))
    try:
        campaign(bench, CHUNK, boundary=GIVEN.boundary)
        bench.assert_healthy()
    except FAILURES as error:
        return f"seed {seed}: {error}"
    finally:
        bench.close()
    return ""


def frames():
    chunks = -(-GIVEN.count // CHUNK)
    started, failed = time.monotonic(), 0
    of = f"{GIVEN.robot} {SYSTEM.build_id} frames, boundary {GIVEN.boundary}"
    pieces = {str(seed): seed for seed in range(chunks)}
    for key, fault in outcomes(frames_of, pieces, of, jobs=GIVEN.jobs, path=GIVEN.results):
        if fault:
            failed += 1
            print(fault, flush=True)
        if (int(key) + 1) % 20 == 0:
            seconds = time.monotonic() - started
            print(f"{(int(key) + 1) * CHUNK} after {seconds:.0f} s", flush=True)
    print(
        f"{chunks * CHUNK} hostile openings on all ports, each followed by a good client: "
        f"{failed} controllers of {chunks} failed; {time.monotonic() - started:.0f} s"
    )
    return bool(failed)


def resident():
    """Return the MB of this process."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * 4096 / 1e6


def days(hours, share):
    bench = Bench(CONFIG, SYSTEM)
    period = CONFIG.state_period
    started, worst, moved = time.monotonic(), 0.0, 0
    sizes = []
    state = bench.state() if share >= 1 else None
    bench.run(1)
    first = None
    while bench.now < hours * 3600:
        round_start = bench.now
        link = bench.motion()
        bench.assert_moves_through(link, bench.wave(4))
        link.close()
        moved += 1
        reader = state if state is not None else bench.state()
        until = round_start + ROUND * share
        while until - bench.now > 1e-3:
            bench.run(min(60.0, until - bench.now))
            stamps = [when for when, f in reader.frames if f.number == STATUS]
            for when in stamps:
                if first is None:
                    first, turn = when, 0
                worst = max(worst, abs(when - first - turn * period))
                turn += 1
            reader.forget()
        if state is None:
            reader.close()
            first = None
        bench.run(max(0.0, round_start + ROUND - bench.now))
        bench.forget()
        bench.controller.log.clear()
        if moved % 6 == 0:
            sizes.append(resident())
            if moved % 144 == 0:
                print(
                    f"{bench.now / 3600:.0f} h: {sizes[-1]:.1f} MB, worst {worst * 1000:.1f} ms "
                    f"off, {time.monotonic() - started:.0f} s",
                    flush=True,
                )
    bench.assert_healthy()
    bench.close()
    # Caches and logs fill in the first hour.
    later = sizes[1:] or sizes
    spread = max(later) - min(later)
    in_use = time.monotonic() - started
    print(
        f"{hours} simulated hours, {moved} trajectories, state read for {share:.0%} of the time: "
        f"worst STATUS {worst * 1000:.1f} ms off its turn (period {period * 1000:.0f} ms), memory "
        f"{sizes[-1]:.1f} MB within {spread:.1f} MB; {in_use:.0f} s, "
        f"{hours * 3600 / in_use:.0f} x real time"
    )
    return worst > period or spread > 10


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=("frames", "days"))
    parser.add_argument("robot", nargs="?", default="irb120")
    parser.add_argument("--count", type=int, default=200_000)
    parser.add_argument("--boundary", type=float, default=0.5, metavar="SHARE")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--results", type=Path)
    parser.add_argument("--hours", type=int, default=24)
    parser.add_argument("--watched", type=float, default=1.0)
    GIVEN = parser.parse_args()
    CONFIG = load_config(GIVEN.robot)
    SYSTEM = make_system(CONFIG, build(CONFIG))
    if GIVEN.what == "frames":
        sys.exit(frames())
    sys.exit(days(GIVEN.hours, GIVEN.watched))
