"""Parallel work on several controllers, ended by the first failure."""

import contextlib
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from dataclasses import dataclass
from typing import Literal, TypeVar

from rapidgen._reading import read_foreign
from rapidgen.deploy.target import Access, connect, parse_target
from rapidgen.deploy.transports.registry import Target
from rapidgen.deploy.transports.transport import Transport
from rapidgen.diagnostics import DiagnosticError, refusal

T = TypeVar("T")

_LARGEST_LIST = 1_000_000
"""Largest file of targets, bytes."""

Word = Literal["done", "same", "failed", "given up", "not begun"]


@dataclass(frozen=True, slots=True)
class TargetOutcome:
    """Result of one controller."""

    target: Target
    word: Word
    detail: str = ""
    error: DiagnosticError | None = None


def parse_targets(urls: Iterable[str]) -> tuple[Target, ...]:
    """Parse the targets of `--to`; `@FILE` is a list with one URL a line.

    Raises DiagnosticError RG509, RG510.
    """
    result: list[Target] = []
    for url in urls:
        for line in _lines(url[1:]) if url.startswith("@") else [url]:
            target = parse_target(line)
            if target in result:
                raise _bad(f"{target.shown} is named twice")
            result.append(target)
    if not result:
        raise _bad("no controller is named")
    return tuple(result)


class Interruption:
    """Ctrl-C during work: no other target is started.

    `say` is called for each. `begin` is for a thread or an exception, not for a signal's handler:
    it takes a lock.
    """

    def __init__(self, say: Callable[[str], None] = lambda _: None) -> None:
        self._event = threading.Event()
        self._say = say

    def __bool__(self) -> bool:
        return self._event.is_set()

    def begin(self) -> None:
        """Record that the user has interrupted the work."""
        self._event.set()
        self._say("interrupted: switching ends first, no other target is started")


def on_all(
    targets: Sequence[Target],
    work: Callable[[Target], T],
    *,
    parallel: int,
    giving_up: Interruption | None = None,
) -> list[T | DiagnosticError | None]:
    """Run `work` on each target, `parallel` at a time; None: not started.

    After the first DiagnosticError no further target is started; active ones end. The same holds if
    `giving_up` returns true, and for KeyboardInterrupt, which is raised then.
    """
    stop = threading.Event()
    given_up = Interruption() if giving_up is None else giving_up

    def guarded(target: Target) -> T | DiagnosticError | None:
        if stop.is_set() or given_up:
            return None
        try:
            return work(target)
        except DiagnosticError as fault:
            stop.set()
            return fault

    with ThreadPoolExecutor(max_workers=max(1, min(parallel, len(targets)))) as pool:
        try:
            futures = [pool.submit(guarded, target) for target in targets]
            wait(futures)
        except KeyboardInterrupt:
            # At any point: leaving the pool waits for active targets, and would start the others.
            given_up.begin()
            raise
    return [future.result() for future in futures]


@contextlib.contextmanager
def connected(target: Target, access: Access) -> Iterator[Transport]:
    """Yield a transport and close it at the end."""
    transport = connect(target, access)
    try:
        yield transport
    finally:
        transport.close()


def _lines(path: str) -> list[str]:
    try:
        text = read_foreign(path, _LARGEST_LIST).decode("utf-8-sig")
    except OSError as fault:
        raise _bad(f"{path}: {fault.strerror}") from fault
    except UnicodeDecodeError as fault:
        raise _bad(f"{path} is not text in UTF-8") from fault
    lines = (line.partition("#")[0].strip() for line in text.splitlines())
    return [line for line in lines if line]


def _bad(message: str) -> DiagnosticError:
    return refusal(
        "RG509",
        None,
        f"--to: {message}",
        "--to ftp://192.168.125.1/hd0a/SYSTEM/HOME, repeated or as @FILE",
    )
