"""Whole-process times against `python -c "import jinja2, pydantic"`, interleaved, medians.

python benchmarks/startup.py [ROUNDS]
"""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PYTHON = [sys.executable]
URDF = Path(__file__).resolve().parents[1] / "robots" / "urdf" / "irb120.urdf"


def seconds(words, folder):
    started = time.perf_counter()
    subprocess.run(words, check=True, cwd=folder, stdout=subprocess.DEVNULL)
    return time.perf_counter() - started


def peak_megabytes(words):
    pid = os.posix_spawn(
        words[0],
        words,
        dict(os.environ),
        file_actions=[(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)],
    )
    _, status, usage = os.wait4(pid, 0)
    if status:
        raise SystemExit(f"{words} failed")
    return usage.ru_maxrss / 1024


def main():
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 15
    rapidgen = [*PYTHON, "-m", "rapidgen.cli"]
    with tempfile.TemporaryDirectory() as folder:
        from_urdf = Path(folder) / "cell.yaml"
        subprocess.run(
            [*rapidgen, "new", str(from_urdf), "--urdf", str(URDF)],
            check=True,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        cases = {
            "import jinja2, pydantic": [*PYTHON, "-c", "import jinja2, pydantic"],
            "rapidgen --help": [*rapidgen, "--help"],
            "rapidgen build irb120": [*rapidgen, "build", "irb120", "-o", f"{folder}/out"],
            "rapidgen build (URDF)": [*rapidgen, "build", str(from_urdf), "-o", f"{folder}/urdf"],
        }
        times = {name: [] for name in cases}
        for _ in range(rounds):
            for name, words in cases.items():
                times[name].append(seconds(words, folder))
        base = statistics.median(times["import jinja2, pydantic"])
        for name, found in times.items():
            median = statistics.median(found)
            print(f"{name:28} {median * 1000:7.1f} ms  {median / base:5.2f} x")
        for name in ("rapidgen build irb120", "rapidgen build (URDF)"):
            print(f"{name:28} peak {peak_megabytes(cases[name]):.1f} MB")


if __name__ == "__main__":
    main()
