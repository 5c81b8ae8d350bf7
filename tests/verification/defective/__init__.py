"""A small driver for trials, sound or with one of the defects that drivers in use have.

The names are those of the list of what is known of ros-industrial/abb_driver:

- R1: points beyond the capacity are dropped, what is left is executed;
- R5: two tasks stop the robot and clear its path at the same time;
- R7a: a lock stays taken when its holder is stopped and begins again from main;
- R7b: a lock stays taken when an interrupt ends the cycle of its holder;
- R12: a peer that is silent for ever keeps the only connection.
"""

from pathlib import Path

from rapidgen.system.model import EventRoutine, ModuleFile, System, TaskSpec

FOLDER = Path(__file__).parent
DEFECTS = ("R1", "R5", "R7a", "R7b", "R12")
CAPACITY = 40


def small_driver(defect: str = "") -> System:
    """Return the driver for one robot of six axes on port 11000.

    It is correct without a defect.
    """

    def module(name: str) -> ModuleFile:
        text = (FOLDER / name).read_text(encoding="ascii")
        return ModuleFile(Path(name).stem, name, with_defect(text, defect).encode(), "HOME:")

    shared = module("shared.sys")
    mover = TaskSpec(
        "T_ROB1",
        motion=True,
        mechanical_unit_group="rob1",
        modules=(shared, module("mover.mod")),
    )
    receiver = TaskSpec(
        "T_RECV",
        "SEMISTATIC",
        trust="SysStop",
        mechanical_unit_group="rob1",
        modules=(shared, module("receiver.mod")),
    )
    hooks = {
        "STOP": "on_interruption",
        "QSTOP": "on_interruption",
        "RESTART": "on_interruption",
        "START": "on_start",
    }
    events = tuple(EventRoutine(routine, event, "T_ROB1") for event, routine in hooks.items())
    return System(f"small {defect}".strip(), (mover, receiver), events=events)


def with_defect(text: str, defect: str) -> str:
    """The text with the lines of a defect put in and left out."""
    lines = []
    for line in text.splitlines():
        if defect and line.rstrip().endswith(f"!-{defect}"):
            continue
        bare = line.lstrip()
        if defect and bare.startswith(f"!+{defect} "):
            line = line[: -len(bare)] + bare.removeprefix(f"!+{defect} ")
        lines.append(line)
    return "\n".join(lines) + "\n"
