"""Run work on several processes, and resume interrupted runs."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from rapidgen.verification.result_file import Results
from rapidgen.verification.worker_pool import CachedResult, Call, LocalPool, in_order


def outcomes(
    one: Any, pieces: dict[str, Any], of: str, *, jobs: int, path: Path | None
) -> Iterator[tuple[str, Any]]:
    """Yield each key of `pieces` with `one(None, piece)`, in their order.

    `path` stores the results `of` one campaign (None: they are not stored); known results are not
    computed again.
    """
    keys = list(pieces)
    with Results(path, of, resume=True) as results, LocalPool(None, jobs) as workers:

        def make(number: int) -> Call | CachedResult:
            known = results.known(keys[number])
            return Call(number, one, pieces[keys[number]]) if known is None else CachedResult(known)

        for key, result in zip(keys, in_order(workers, len(keys), make), strict=True):
            results.add(key, result)
            yield key, result
