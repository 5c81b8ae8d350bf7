"""One test text for both clients: an AsyncRobot under the calls of a Robot."""

import asyncio
import functools
import inspect
import threading

from rapidgen.client import AsyncRobot
from rapidgen.client.api import MotionHandle


class Handle:
    """Wrapper of an asynchronous client; `run` waits for a coroutine."""

    def __init__(self, target, run):
        self._target, self._run = target, run

    def __enter__(self):
        self._run(self._target.__aenter__())
        return self

    def __exit__(self, *error):
        self._run(self._target.__aexit__(*error))

    def __getattr__(self, name):
        value = getattr(self._target, name)
        if not callable(value):
            return value

        @functools.wraps(value)
        def call(*arguments, **options):
            result = value(*arguments, **options)
            result = self._run(result) if inspect.isawaitable(result) else result
            return Handle(result, self._run) if isinstance(result, MotionHandle) else result

        return call

    @property
    def later(self):
        """The same calls, which go on while others are made: `.result()`, `.cancel()`."""
        return Handle(self._target, functools.partial(_Later, self._run))


class _Later:
    def __init__(self, run, coroutine):
        async def begin():
            task = asyncio.ensure_future(coroutine)
            await asyncio.sleep(0)
            return task

        self._run, self._task = run, run(begin())
        self.cancel, self.done = self._task.cancel, self._task.done

    def result(self):
        async def outcome():
            return await self._task

        return self._run(outcome())


class Simulated(Handle):
    """An AsyncRobot on a loop of simulated time, which passes only while a call waits."""

    def __init__(self, target, loop):
        super().__init__(target, loop.run_until_complete)
        self._loop = loop
        self.time = loop.time

    def __exit__(self, *error):
        super().__exit__(*error)
        self._run(self._loop.shutdown_asyncgens())
        self._loop.close()

    def open_another(self, target):
        """Another one on the same loop."""
        return Handle(target, self._run)

    def sleep(self, seconds):
        self._run(asyncio.sleep(seconds))


class Blocking(Handle):
    """An AsyncRobot whose loop runs in a thread."""

    def __init__(self, *arguments, **options):
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, daemon=True)
        self._thread.start()
        super().__init__(AsyncRobot(*arguments, **options), self._call)

    def _call(self, coroutine):
        return asyncio.run_coroutine_threadsafe(coroutine, self._loop).result(60)

    def __enter__(self):
        try:
            return super().__enter__()
        except BaseException:
            self.end()
            raise

    def __exit__(self, *error):
        try:
            super().__exit__(*error)
        finally:
            self.end()

    def end(self):
        self._call(_cancel_all())
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join(5)
        self._loop.close()


async def _cancel_all():
    await asyncio.sleep(0)
    tasks = asyncio.all_tasks() - {asyncio.current_task()}
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)
