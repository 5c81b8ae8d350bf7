"""A long recording: speed of writing, opening, scrubbing and plots.

    python benchmarks/recording.py [--minutes 60] [--keep FILE.mcap]

Limits: an hour opens in 2 s. A moment takes the same time wherever it is.
"""

import argparse
import random
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from rapidgen.controller.controller import VirtualController
from rapidgen.viewer.recording.reader import RecordingFile
from rapidgen.viewer.recording.writer import record

PROGRAM = """MODULE m
  CONST jointtarget a := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget b := [[40,10,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ a, v200, fine, tool0;
    MoveAbsJ b, v200, fine, tool0;
  ENDPROC
ENDMODULE
"""


def _timed(function: Callable[[], object]) -> float:
    start = time.perf_counter()
    function()
    return time.perf_counter() - start


def _simulate(module: Path, minutes: float, path: Path | None) -> float:
    with VirtualController.from_files([module]) as controller:
        end = record(controller, path) if path is not None else lambda: None
        spent = _timed(lambda: controller.run_for(60 * minutes))
        return spent + _timed(end)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--keep", type=Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        module, path = Path(folder) / "m.mod", arguments.keep or Path(folder) / "run.mcap"
        module.write_text(PROGRAM)
        bare = _simulate(module, min(arguments.minutes, 5), None) / (60 * min(arguments.minutes, 5))
        with_it = _simulate(module, arguments.minutes, path) / (60 * arguments.minutes)
        print(f"a simulated second   {1000 * bare:8.1f} ms, recorded {1000 * with_it:8.1f} ms")
        size = path.stat().st_size
        print(f"{arguments.minutes:g} minutes           {size / 1e6:8.1f} MB")
        opening = min(_timed(lambda: RecordingFile(path).close()) for _ in range(5))
        print(f"opens in             {1000 * opening:8.1f} ms (limit 2000 for an hour)")
        chance = random.Random(1)
        with RecordingFile(path) as file:
            moments = [chance.uniform(file.begin, file.end) for _ in range(50)]
            costs = sorted(_timed(lambda at=at: file.at(at)) for at in moments)
            print(
                f"a moment             {1000 * costs[25]:8.1f} ms, worst {1000 * costs[-1]:.1f} ms"
            )
            near = [min(file.end, moments[0] + 0.05 * i) for i in range(50)]
            costs = sorted(_timed(lambda at=at: file.at(at)) for at in near)
            print(f"the next moment      {1000 * costs[25]:8.1f} ms")
            complete = _timed(lambda: file.joints("rob1", file.begin, file.end))
            print(f"a plot of all        {1000 * complete:8.1f} ms")
            ten = _timed(lambda: file.joints("rob1", 0, min(10, file.end)))
            print(f"a plot of 10 s       {1000 * ten:8.1f} ms")
    raise SystemExit(1 if opening > 2 else 0)


if __name__ == "__main__":
    main()
