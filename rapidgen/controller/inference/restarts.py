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
        faults = [task.fault for task in controller.tasks.values() if task.fault is not None]
        places = [] if faults or finished != "finished" else _stop_places(controller)
        if places and guessed.is_guess and controller.now < until:
            guessed.answered.extend((f"Stop at {place}", "start") for place in places)
            if not controller.start_program():
                break
            continue
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


def _stop_places(controller: VirtualController) -> list[str]:
    """Return the places of tasks that a Stop instruction stopped."""
    stacks = [t.stack() for t in controller.rapid_tasks.values() if t.state == "stopped"]
    tops = [stack[-1].span for stack in stacks if stack]
    return [f"{Path(span.path).name}:{span.line}" for span in tops]
