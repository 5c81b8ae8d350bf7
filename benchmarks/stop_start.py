"""Time from a shell's STOP to the wire, in starts of an empty Python.

    python benchmarks/stop_start.py [RUNS]

`whole way` is the command without its short cut: it imports everything first. Runs alternate,
medians are printed with their ratio to `python -c "import socket"`.
"""

import socket
import statistics
import subprocess
import sys
import time

WHOLE = "import sys; sys.argv[0] = 'rapidgen'; from rapidgen.cli.app import run; run(sys.argv[1:])"
HEADER = 20


def until_stop(words, *, config=()):
    """Return s from the start of a process until its STOP arrives.

    It arrives at a motion port; `config` are words before the address.
    """
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(60)
        begin = time.perf_counter()
        process = subprocess.Popen(
            [sys.executable, *words, "stop", *config, f"127.0.0.1:{server.getsockname()[1]}"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            link, _ = server.accept()
            with link:
                link.settimeout(60)
                assert link.recv(HEADER)
                return time.perf_counter() - begin
        finally:
            process.kill()
            process.wait()


def until_end(words):
    """Return the s of a process."""
    begin = time.perf_counter()
    subprocess.run([sys.executable, *words], check=True)
    return time.perf_counter() - begin


def main():
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    measured = {
        "import socket": lambda: until_end(["-c", "import socket"]),
        "rapidgen stop": lambda: until_stop(["-m", "rapidgen.cli"]),
        "with a model": lambda: until_stop(["-m", "rapidgen.cli"], config=["irb14000", "--to"]),
        "whole way": lambda: until_stop(["-c", WHOLE]),
    }
    times = {name: [] for name in measured}
    for _ in range(runs):
        for name, measure in measured.items():
            times[name].append(measure())
    least = statistics.median(times["import socket"])
    for name, in_use in times.items():
        middle = statistics.median(in_use)
        print(f"{name:<14} {middle * 1000:7.1f} ms  {middle / least:5.1f} x")


if __name__ == "__main__":
    main()
