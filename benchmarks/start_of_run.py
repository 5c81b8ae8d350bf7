"""CPU time of `rapidgen run hello.mod` against importing two packages.

    python benchmarks/start_of_run.py [TIMES]

The packages are jinja2 and pydantic; the figure is a ratio in one run of CPU seconds, which a busy
machine changes least. The two commands take turns and the medians are compared. The first turn,
which may have to compile files, does not count.
"""

import os
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

_ENVIRONMENT = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
"""As after an installation: files are compiled."""
HELLO = 'MODULE hello\n PROC main()\n  TPWrite "hello";\n ENDPROC\nENDMODULE\n'


def seconds(words: list[str]) -> float:
    """Return the CPU time of a process."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL, env=_ENVIRONMENT)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def main(times: int) -> None:
    """Print both medians and the ratio."""
    with tempfile.TemporaryDirectory() as folder:
        hello = Path(folder) / "hello.mod"
        hello.write_text(HELLO, encoding="utf-8")
        run = [sys.executable, "-m", "rapidgen.cli", "run", str(hello)]
        imports = [sys.executable, "-c", "import jinja2, pydantic"]
        pairs = [(seconds(run), seconds(imports)) for _ in range(times + 1)][1:]
    runs, others = (statistics.median(column) for column in zip(*pairs, strict=True))
    print(f"run {runs:.3f} s, imports {others:.3f} s, ratio {runs / others:.2f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 15)
