"""Start time of a foreign server, against `import jinja2, pydantic`.

    python benchmarks/ready.py [TIMES [MODULE...]]

Wall seconds from the start of `rapidgen sim server.mod` to its line `ready`: the program serves a
socket as soon as it runs. The two take turns, medians are compared; the first turn does not count.
MODULE replaces the server by modules in an inferred cell.
"""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SERVER = """MODULE server
  VAR socketdev listening;
  VAR socketdev client;

  PROC main()
    SocketCreate listening;
    SocketBind listening, "127.0.0.1", 5000;
    SocketListen listening;
    SocketAccept listening, client \\Time:=WAIT_MAX;
  ENDPROC
ENDMODULE
"""
OWN: list[Path] = []
ENVIRONMENT = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}


def ready(*paths: Path | str) -> float:
    """Return seconds to the line."""
    began = time.perf_counter()
    words = [sys.executable, "-m", "rapidgen.cli", "sim", *map(str, paths), "--ports", "auto"]
    words += [] if paths[0] in OWN else ["--cell", "infer"]
    with subprocess.Popen(
        words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env=ENVIRONMENT
    ) as sim:
        assert sim.stdout is not None
        line = sim.stdout.readline()
        took = time.perf_counter() - began
        sim.terminate()
    assert line.startswith("ready "), line
    return took


def imports() -> float:
    """Return seconds of a process that imports two packages and ends."""
    began = time.perf_counter()
    subprocess.run([sys.executable, "-c", "import jinja2, pydantic"], check=True, env=ENVIRONMENT)
    return time.perf_counter() - began


def main(times: int, modules: list[str]) -> None:
    """Print both medians and the ratio."""
    if modules:
        result = [ready(*modules) for _ in range(times + 1)][1:]
        print(f"ready {statistics.median(result):.3f} s")
        return
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "server.mod"
        path.write_text(SERVER, encoding="utf-8")
        OWN.append(path)
        pairs = [(ready(path), imports()) for _ in range(times + 1)][1:]
    servers, others = (statistics.median(column) for column in zip(*pairs, strict=True))
    print(f"ready {servers:.3f} s, imports {others:.3f} s, ratio {servers / others:.2f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 15, sys.argv[2:])
