"""Work that goes on for hours: kept as it comes, within limits, with what is known left out."""

import math
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Generic, TypeAlias, TypeVar, cast

from pydantic import TypeAdapter

from rapidgen.verification.result_file import Results
from rapidgen.verification.worker_pool import CachedResult, Call, WorkerPool, in_order

T = TypeVar("T")
R = TypeVar("R")
MEASURED = {"elapsed"}
"""What of a result is not the same when it is found again; it is not kept."""
Progress: TypeAlias = Callable[[str, int, int], None]
"""Called with what is done, how many of it are, and of how many."""


@dataclass(frozen=True, slots=True)
class Limits:
    """When a campaign ends before its end."""

    budget: float = math.inf
    """s after which nothing more is begun."""
    stop_on_failure: bool = False


@dataclass(frozen=True)
class Workload(Generic[T, R]):
    """Pieces of one kind.

    `item(number)` is asked for in order, once the first `needs(number)` results have been taken.
    """

    what: str
    count: int
    function: Callable[..., R]
    item: Callable[[int], T]
    key: Callable[[T], str]
    """The same for the same item; results are kept under it."""
    kept_as: TypeAdapter[R]
    failed: Callable[[R], bool]
    needs: Callable[[int], int] = lambda number: 0
    take: Callable[[R], R] = lambda result: result
    """Hears each result in its order, and returns what is kept of it."""


class Campaign:
    """Results of work, in its order, whoever does it and however often it is broken off."""

    def __init__(
        self, workers: WorkerPool, results: Results, limits: Limits, progress: Progress | None
    ) -> None:
        self.workers = workers
        self.left = 0
        """Pieces that were not done, for the limits."""
        self._results = results
        self._limits = limits
        self._progress = progress
        self._started = time.monotonic()
        self._failed = False

    def _over(self) -> bool:
        return self._failed or time.monotonic() - self._started > self._limits.budget

    def run(self, work: Workload[T, R]) -> Iterator[R]:
        """The results that come within the limits."""
        keys: list[str] = []

        def make(number: int) -> Call | CachedResult:
            item = work.item(number)
            keys.append(work.key(item))
            known = self._results.known(keys[-1])
            if known is not None:
                return CachedResult(work.kept_as.validate_python(known, strict=False))
            return Call(number, work.function, item)

        done = 0
        for found in in_order(self.workers, work.count, make, work.needs, self._over):
            result = work.take(cast(R, found))
            saved = work.kept_as.dump_python(result, mode="json", exclude=MEASURED)
            self._results.add(keys[done], saved)
            done += 1
            yield result
            if self._progress is not None:
                self._progress(work.what, done, work.count)
            if self._limits.stop_on_failure and work.failed(result):
                self._failed = True
                break
        self.left += work.count - done
