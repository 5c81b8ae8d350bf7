"""Both clients under the same calls: one test text for `Robot` and `AsyncRobot`."""

import asyncio
import functools
import inspect
import threading

from rapidgen.client import AsyncRobot


class Blocking:
    """`AsyncRobot` whose loop runs in a thread: one test text for both clients."""

    def __init__(self, *arguments, **options):
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, daemon=True)
        self._thread.start()
        self._target = AsyncRobot(*arguments, **options)

    def _call(self, coroutine):
        return asyncio.run_coroutine_threadsafe(coroutine, self._loop).result(60)

    def __enter__(self):
        try:
            self._call(self._target.__aenter__())
        except BaseException:
            self.end()
            raise
        return self

    def __exit__(self, *error):
        try:
            self._call(self._target.__aexit__(*error))
        finally:
            self.end()

    def end(self):
        self._call(_cancel_all())
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join(5)
        self._loop.close()

    def stream(self, *arguments, **options):
        return _Handle(self, self._target.stream(*arguments, **options))

    def __getattr__(self, name):
        value = getattr(self._target, name)
        if not callable(value):
            return value

        @functools.wraps(value)
        def call(*arguments, **options):
            result = value(*arguments, **options)
            if not inspect.isawaitable(result):
                return result
            result = self._call(result)
            return _Handle(self, result) if hasattr(result, "cancel") else result

        return call


class _Handle:
    def __init__(self, owner, target):
        self._owner, self._target = owner, target

    __getattr__ = Blocking.__getattr__

    def _call(self, coroutine):
        return self._owner._call(coroutine)

    def __enter__(self):
        self._call(self._target.__aenter__())
        return self

    def __exit__(self, *error):
        self._call(self._target.__aexit__(*error))


async def _cancel_all():
    await asyncio.sleep(0)
    tasks = asyncio.all_tasks() - {asyncio.current_task()}
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)
