"""`asyncio.timeout`, also for Python 3.10.

Its end raises the built-in TimeoutError.
"""

import sys

if sys.version_info >= (3, 11):
    from asyncio import timeout
else:
    from asyncio import TimeoutError as _AsyncioTimeoutError
    from collections.abc import AsyncIterator
    from contextlib import asynccontextmanager

    from async_timeout import timeout as _timeout

    @asynccontextmanager
    async def timeout(delay: float | None) -> AsyncIterator[None]:
        """Cancel the awaited call after `delay` s (None: never).

        Raises TimeoutError then.
        """
        try:
            async with _timeout(delay):
                yield
        except _AsyncioTimeoutError as error:
            raise TimeoutError(*error.args) from error


__all__ = ["timeout"]
