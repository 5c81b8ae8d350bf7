"""Random programs beside the same ones written in RAPID: `python benchmarks/program_campaign.py`.

    python benchmarks/program_campaign.py [--count N] [--seed N] [ROBOT ...]

The path is the same within 0.01 mm, the time within 2 %, on one virtual controller each; the short
form is the case `program-like-rapid` of `rapidgen test`.
"""

import argparse
import random
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.config import load_config
from rapidgen.controller.cell import in_its_cell
from rapidgen.generate import build, make_system
from rapidgen.proving.bench import Bench
from rapidgen.proving.model import Broken
from rapidgen.proving.suite.programs import like_rapid


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("robots", nargs="*", default=["irb120", "irb2400", "irb460", "irb910sc"])
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    failed = 0
    for name in arguments.robots:
        config = load_config(name)
        began = time.process_time()
        with Bench(config, in_its_cell(make_system(config, build(config)), config)) as bench:
            try:
                like_rapid(bench, arguments.count, random.Random(arguments.seed))
                told = "held"
            except Broken as broken:
                failed += 1
                told = str(broken)
        print(f"{name:12} {arguments.count} programs, {time.process_time() - began:.0f} s: {told}")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
