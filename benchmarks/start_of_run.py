"""CPU time of `rapidgen run` to the first statement: a small module, and one of 35,000 lines.

    python benchmarks/start_of_run.py [TIMES]

The packages are jinja2 and pydantic; the figure is a ratio in one run of CPU seconds, which a busy
machine changes least. The two commands take turns and the medians are compared. The first turn,
which may have to compile files, does not count.

The large module declares 35,000 targets. Its run, without and with an inferred cell, is compared
with a process that parses it once; both include their imports. A server's boot is that of a module
with a socket in an inferred cell, up to the first message that it waits for.
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
LINES = 35_000
AXES = "[9E9,9E9,9E9,9E9,9E9,9E9]"
TARGET = "  CONST robtarget p{k} := [[{x},{y},500.5],[0,0,1,0],[0,0,0,0],{axes}];\n"
PARSE = "import sys; from rapidgen.rapid import parse; parse(open(sys.argv[1], 'rb').read())"
SERVER = """MODULE server
  VAR socketdev listening;
  VAR socketdev client;
  VAR string text;
  PROC main()
    SocketCreate listening;
    SocketBind listening, "127.0.0.1", port;
    SocketListen listening;
    SocketAccept listening, client \\Time:=WAIT_MAX;
    SocketReceive client \\Str:=text \\Time:=WAIT_MAX;
    EXIT;
  ENDPROC
ENDMODULE
"""
HELLO = 'MODULE hello\n PROC main()\n  TPWrite "hello";\n ENDPROC\nENDMODULE\n'


def seconds(words: list[str]) -> float:
    """Return the CPU time of a process."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    silent = subprocess.DEVNULL
    subprocess.run(words, check=True, stdout=silent, stderr=silent, env=_ENVIRONMENT)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def large() -> str:
    """Return a module with many targets."""
    rows = (TARGET.format(k=k, x=300 + k % 200, y=k % 97 - 40, axes=AXES) for k in range(LINES))
    main = '  PROC main()\n  TPWrite "first";\n  ENDPROC\n'
    return f"MODULE large\n{''.join(rows)}{main}ENDMODULE\n"


def large_module(folder: Path, times: int) -> None:
    """Print the time of a large module's run, and of a server's boot."""
    module, server = folder / "large.mod", folder / "server.mod"
    module.write_text(large(), encoding="utf-8")
    server.write_text(SERVER, encoding="utf-8")
    run = [sys.executable, "-m", "rapidgen.cli", "run"]
    commands = {
        "parse": [sys.executable, "-c", PARSE, str(module)],
        "first statement": [*run, str(module)],
        "first statement, inferred cell": [*run, str(module), "--cell", "infer"],
        "server, inferred cell": [*run, str(server), "--cell", "infer"],
    }
    columns = {name: [seconds(words) for _ in range(times)] for name, words in commands.items()}
    parsing = statistics.median(columns["parse"])
    for name, column in columns.items():
        took = statistics.median(column)
        print(f"{name}: {took:.2f} s of CPU, {took / parsing:.2f} x the parse")


def main(times: int) -> None:
    """Print both medians and the ratio."""
    with tempfile.TemporaryDirectory() as folder:
        hello = Path(folder) / "hello.mod"
        hello.write_text(HELLO, encoding="utf-8")
        run = [sys.executable, "-m", "rapidgen.cli", "run", str(hello)]
        imports = [sys.executable, "-c", "import jinja2, pydantic"]
        pairs = [(seconds(run), seconds(imports)) for _ in range(times + 1)][1:]
        large_module(Path(folder), max(1, times // 5))
    runs, others = (statistics.median(column) for column in zip(*pairs, strict=True))
    print(f"run {runs:.3f} s, imports {others:.3f} s, ratio {runs / others:.2f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 15)
