"""Complete runs of programs in an inferred cell, as an operator would do them.

A program that stops after an inferred answer is started from main again and receives the next
answer; after a Stop instruction it continues.
"""

from pathlib import Path
from typing import Final, Literal

from rapidgen.controller.controller import VirtualController

_MOST: Final = 50
"""Maximum number of restarts."""
Ended = Literal["finished", "time", "statements", "deadlock", "paused"]


def run_past_stops(
    controller: VirtualController, *, max_time: float, max_statements: int | None = None
) -> Ended:
    """Run a program, and restart it while inferred answers stop it.

    A restart follows if a task stopped with an error after an answer since the last start;
    `controller.guessed.stopped` lists these places. In an inferred cell, a task at a Stop
    instruction is started again, too.

    `max_time` (s) limits the total, `max_statements` each start. The faults of the last start
    remain in the tasks.
    """
    until = controller.now + max_time
    guessed = controller.guessed
    for starts in range(_MOST + 1):
        answers = len(guessed.answered)
        left = until - controller.now
        finished = controller.run(max_time=left, max_statements=max_statements)
        if starts == _MOST:
            break
        frames = [t for t in controller.rapid_tasks.values() if t.state == "stopped"]
        if finished == "finished" and guessed.is_guess and frames and controller.now < until:
            for top in (task.stack()[-1] for task in frames if task.stack()):
                place = f"{Path(top.span.path).name}:{top.span.line}"
                guessed.answered.append((f"Stop at {place}", "start"))
            if not controller.start_program():
                break
            continue
        faults = [task.fault for task in controller.tasks.values() if task.fault is not None]
        if not faults or len(guessed.answered) == answers or controller.now >= until:
            break
        for fault in faults:
            at = fault.span or (fault.stack[-1].span if fault.stack else None)
            place = f"{Path(at.path).name}:{at.line}" if at is not None else ""
            guessed.stopped.append((place, ": ".join(filter(None, fault.arguments)) or str(fault)))
        controller.pp_to_main()
        if not controller.start_program():
            break
    return finished
