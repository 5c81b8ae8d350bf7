"""A limit of memory: a program that takes more is told so, before this machine suffers."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from rapidgen.diagnostics import error, refusal
from rapidgen.diagnostics.model import DiagnosticError

MB = 2**20


@contextmanager
def at_most(megabytes: int) -> Iterator[None]:
    """Give this process so much memory for its data while the block runs.

    DiagnosticError RG406 when it was not enough. The limit is the operating system's
    (RLIMIT_DATA); where it has none there is none.
    """
    if megabytes < 1:
        raise refusal(
            "RG901", None, f"--max-memory {megabytes} is no size", "such as --max-memory 1024"
        )
    if sys.platform == "win32":
        yield
        return
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_DATA)
    requested = megabytes * MB
    if hard != resource.RLIM_INFINITY:
        requested = min(requested, hard)
    resource.setrlimit(resource.RLIMIT_DATA, (requested, hard))
    full = False
    try:
        yield
    except MemoryError:
        full = True
    finally:
        resource.setrlimit(resource.RLIMIT_DATA, (soft, hard))
    if full:
        # Told here, when what filled the memory is gone.
        raise DiagnosticError(
            error(
                "RG406",
                None,
                f"the program takes more than {megabytes} MB of memory",
                "raise --max-memory, or look for what grows: arrays, and calls inside calls",
            ),
            exit_code=1,
        )
