"""Whole-process CPU times against `python -c "import jinja2, pydantic"`.

python benchmarks/startup.py [ROUNDS]

Interleaved runs, medians.
"""

import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

PYTHON = [sys.executable]
URDF = Path(__file__).resolve().parents[1] / "robots" / "urdf" / "irb120.urdf"


HELLO = 'MODULE hello\n PROC main()\n TPWrite "hello";\n ENDPROC\nENDMODULE\n'


def used(words, folder):
    """Return CPU seconds and peak megabytes of a process.

    Its modules are compiled as installed ones.
    """
    where = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    where["PYTHONPYCACHEPREFIX"] = f"{folder}/bytecode"
    process = subprocess.Popen(
        words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=where
    )
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        raise SystemExit(f"{words} failed")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


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
        config = Path(folder) / "x.yaml"
        config.write_text("model: irb120\ncontroller: {type: irc5_compact, robotware: 6.15}\n")
        hello = Path(folder) / "hello.mod"
        hello.write_text(HELLO)
        cases = {
            "import jinja2, pydantic": [*PYTHON, "-c", "import jinja2, pydantic"],
            "rapidgen --help": [*rapidgen, "--help"],
            "rapidgen robots": [*rapidgen, "robots"],
            "rapidgen new": [*rapidgen, "new", "new.yaml", "--robot", "irb120", "--force"],
            "rapidgen check x.yaml": [*rapidgen, "check", str(config)],
            "rapidgen run hello.mod": [*rapidgen, "run", str(hello)],
            "rapidgen build irb120": [*rapidgen, "build", "irb120", "-o", f"{folder}/out"],
            "rapidgen build (URDF)": [*rapidgen, "build", str(from_urdf), "-o", f"{folder}/urdf"],
        }
        result = {name: [] for name in cases}
        for turn in range(rounds + 1):
            for name, words in cases.items():
                one = used(words, folder)
                if turn:  # the first run compiles
                    result[name].append(one)
        times = {name: [seconds for seconds, _ in ones] for name, ones in result.items()}
        base = statistics.median(times["import jinja2, pydantic"])
        for name, seconds in times.items():
            median = statistics.median(seconds)
            print(f"{name:28} {median * 1000:7.1f} ms  {median / base:5.2f} x")
        for name in ("rapidgen build irb120", "rapidgen build (URDF)"):
            print(f"{name:28} peak {max(peak for _, peak in result[name]):.1f} MB")


if __name__ == "__main__":
    main()
