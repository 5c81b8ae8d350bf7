"""Long-running work: results are saved as they arrive, within limits.

Items with a known result are skipped.
"""

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
"""Fields of a result that differ between runs; they are not saved."""
Progress: TypeAlias = Callable[[str, int, int], None]
"""Arguments: kind of work, number done, total."""


@dataclass(frozen=True, slots=True)
class Limits:
    """Limits at which a campaign stops early."""

    budget: float = math.inf
    """s after which no new item starts."""
    stop_on_failure: bool = False


@dataclass(frozen=True)
class Workload(Generic[T, R]):
    """Work items of one kind.

    `item(number)` is called in order, after the first `needs(number)` results are available.
    """

    what: str
    count: int
    function: Callable[..., R]
    item: Callable[[int], T]
    key: Callable[[T], str]
    """Return the same key for the same item; results are saved under it."""
    kept_as: TypeAdapter[R]
    failed: Callable[[R], bool]
    needs: Callable[[int], int] = lambda number: 0
    take: Callable[[R], R] = lambda result: result
    """Process each result in order, and return the part to save."""


class Campaign:
    """Results of work items, in order.

    The order does not depend on the workers or on interruptions.
    """

    def __init__(
        self, workers: WorkerPool, results: Results, limits: Limits, progress: Progress | None
    ) -> None:
        self.workers = workers
        self.left = 0
        """Items not done because of the limits."""
        self._results = results
        self._limits = limits
        self._progress = progress
        self._started = time.monotonic()
        self._failed = False

    def _over(self) -> bool:
        return self._failed or time.monotonic() - self._started > self._limits.budget

    def run(self, work: Workload[T, R]) -> Iterator[R]:
        """Yield the results that arrive within the limits."""
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
