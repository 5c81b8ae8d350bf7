"""A function in a process of its own, from the very state that this one is in.

A booted controller is copied by that in a few milliseconds; whatever is done to the copy ends
with it.
"""

import os
import pickle
import warnings
from collections.abc import Callable
from typing import TypeVar

from rapidgen.machine.files import remove_scratch_folders

R = TypeVar("R")


class ForkFailed(Exception):
    """The copy ended without a result: killed, or by a fault of the interpreter."""


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
