"""Work on several processes of this machine, and a function in a copy of this one.

A booted controller is copied by a fork in a few milliseconds; whatever is done to the copy ends
with it.
"""

import os
import pickle
import signal
import warnings
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import TypeVar

from rapidgen.machine.files import remove_scratch_folders

R = TypeVar("R")


class ForkFailed(Exception):
    """The copy ended without a result: killed, or by a fault of the interpreter."""


def each(
    work: Sequence[object],
    function: Callable[..., R],
    jobs: int | None,
    what: str = "",
    progress: Callable[[str, int, int], None] | None = None,
    results: list[R] | None = None,
) -> list[R]:
    """Results of a module's function for each piece of work, in order, on several processes.

    They are put into `results` as they come: there they are, too, when the work is broken off.
    """
    count = jobs or os.cpu_count() or 1
    results = [] if results is None else results
    if count == 1:
        for done, item in enumerate(work, 1):
            results.append(function(item))
            if progress is not None:
                progress(what, done, len(work))
        return results
    # A few pieces at a time, as long as there are enough for all.
    chunk = max(1, min(4, len(work) // (4 * count)))
    # An interruption is this process's own: the others end what they are at.
    with ProcessPoolExecutor(
        count,
        mp_context=get_context("fork"),
        initializer=signal.signal,
        initargs=(signal.SIGINT, signal.SIG_IGN),
    ) as pool:
        try:
            for done, result in enumerate(pool.map(function, work, chunksize=chunk), 1):
                results.append(result)
                if progress is not None:
                    progress(what, done, len(work))
        except KeyboardInterrupt:
            pool.shutdown(cancel_futures=True)
            raise
    return results


def in_a_fork(function: Callable[[], R]) -> R:
    """The result of `function`, or what it raised. Raises ForkFailed when there is neither."""
    reading, writing = os.pipe()
    with warnings.catch_warnings():
        # Threads of a test runner do not matter: the copy uses none of their locks.
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if child == 0:
        os.close(reading)
        _answer(function, writing)
    os.close(writing)
    with os.fdopen(reading, "rb") as stream:
        data = stream.read()
    _, status = os.waitpid(child, 0)
    if not data:
        raise ForkFailed(f"status {status}")
    good, result = pickle.loads(data)
    if not good:
        raise result
    answer: R = result
    return answer


def _answer(function: Callable[[], object], writing: int) -> None:
    try:
        try:
            answer = (True, function())
        except Exception as error:  # noqa: BLE001 - handed to the parent, which raises it
            answer = (False, error)
        with os.fdopen(writing, "wb") as stream:
            pickle.dump(answer, stream)
    finally:
        remove_scratch_folders()
        os._exit(0)
