"""Read, link and start a large ABB backup on the virtual controller.

    python benchmarks/backup.py [--modules N] [--routines N] [--keep FOLDER]

The script generates the backup with the texts of parsing.py: three tasks, modules in PROGMOD,
SYSMOD, HOME, signals and event routines. Each stage is a process of its own, so that no cache is
warm; CPU time, best of several. Limit: 200 modules loaded within 5 s.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

from parsing import module

LIMIT = 5.0
TASKS = {"T_ROB1": 0.8, "T_BACK": 0.15, "T_LOG": 0.05}
"""Share of the modules in each task."""
MAIN = """MODULE Main{number}
    PROC main()
        TPWrite "{task} runs";
    ENDPROC
    PROC onStart()
        TPWrite "{task} starts";
    ENDPROC
ENDMODULE
"""
HEAD = (
    "import time\nfrom rapidgen.controller import VirtualController\nstart = time.process_time()\n"
)
TAIL = "\nprint(time.process_time() - start)"
STAGES = {
    "read": "from rapidgen.system import read_backup\nread_backup({folder!r})",
    "load": "VirtualController.from_folder({folder!r}, autostart=False)",
    "load and run": "VirtualController.from_folder({folder!r}, cycle='once').run(max_time=10)",
    "check": "from rapidgen.rapid import check\nfrom rapidgen.system import read_backup\n"
    "check(read_backup({folder!r}), gaps=True)",
}


def put(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text.replace("\n", "\r\n").encode("latin-1"))


def write_backup(folder, modules, routines):
    """Write the backup; return the number of its modules' lines."""
    tasks, loaded, lines, made = [], [], 0, 1
    for number, (task, share) in enumerate(TASKS.items(), 1):
        kind = '-Type "NORMAL" -MotionTask' if number == 1 else '-TrustLevel "SysStop"'
        tasks.append(f'      -Name "{task}" {kind} -Entry "main"\n')
        root = folder / f"RAPID/TASK{number}"
        put(root / f"PROGMOD/Main{number}.mod", MAIN.format(number=number, task=task))
        for k in range(round(modules * share)):
            text = module(made, routines)
            lines += text.count("\n")
            made += 1
            if k % 10 == 9:
                put(folder / f"HOME/part_{made}.sys", text)
                loaded.append(f'      -File "HOME:/part_{made}.sys" -Task "{task}"\n')
            else:
                put(root / ("SYSMOD" if k % 10 == 8 else "PROGMOD") / f"part_{made}.mod", text)
    hooks = [f'      -Routine "onStart" -Shelf "START" -Task "{task}"\n' for task in TASKS]
    sections = {"CAB_TASKS": tasks, "CAB_TASK_MODULES": loaded, "CAB_EXEC_HOOKS": hooks}
    put(
        folder / "SYSPAR/SYS.cfg",
        "SYS:CFG_1.0:6:0::\n"
        + "".join(f"#\n{name}:\n\n" + "\n".join(rows) for name, rows in sections.items()),
    )
    signals = (f'      -Name "do_{i}" -SignalType "DO"\n' for i in range(500))
    put(folder / "SYSPAR/EIO.cfg", "EIO:CFG_1.0:6:1::\n#\nEIO_SIGNAL:\n\n" + "\n".join(signals))
    put(folder / "BACKINFO/backinfo.txt", "RobotWare Version: 6.08\n")
    return lines


def measure(code, rounds=3):
    """Return CPU seconds of Python code in a fresh process.

    Imports are left out; best of several.
    """
    times = []
    for _ in range(rounds):
        done = subprocess.run(
            [sys.executable, "-c", HEAD + code + TAIL], capture_output=True, text=True, check=True
        )
        times.append(float(done.stdout.split()[-1]))
    return min(times)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--modules", type=int, default=200)
    parser.add_argument("--routines", type=int, default=13)
    parser.add_argument("--keep", type=Path, help="write the backup here, too")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.keep or Path(scratch) / "backup"
        lines = write_backup(folder, options.modules, options.routines)
        print(f"{options.modules} modules, {lines:,} lines")
        times = {name: measure(code.format(folder=str(folder))) for name, code in STAGES.items()}
    for name, seconds in times.items():
        print(f"{name:14} {seconds:6.2f} s")
    raise SystemExit(1 if times["load"] > LIMIT else 0)


if __name__ == "__main__":
    main()
