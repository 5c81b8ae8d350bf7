"""What campaigns share: work by several processes, resumed where a run was cut short."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from rapidgen.verification.result_file import Results
from rapidgen.verification.worker_pool import CachedResult, Call, LocalPool, in_order


def outcomes(
    one: Any, pieces: dict[str, Any], of: str, *, jobs: int, path: Path | None
) -> Iterator[tuple[str, Any]]:
    """Yield each key of `pieces` with what `one(None, piece)` gives, in their order.

    `path` keeps results `of` one campaign (None: they are not kept); what it has is not done again.
    """
    keys = list(pieces)
    with Results(path, of, resume=True) as results, LocalPool(None, jobs) as workers:

        def make(number: int) -> Call | CachedResult:
            known = results.known(keys[number])
            return Call(number, one, pieces[keys[number]]) if known is None else CachedResult(known)

        for key, result in zip(keys, in_order(workers, len(keys), make), strict=True):
            results.add(key, result)
            yield key, result
