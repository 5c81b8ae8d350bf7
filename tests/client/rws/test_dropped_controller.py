"""Controller clients that are dropped without `close()`, and those in a forked process."""

import asyncio
import gc
import logging
import os
import threading
import warnings

import pytest

from rapidgen.client.errors import ConnectionLost
from rapidgen.client.rws import AsyncController, Controller, topics


def resources():
    return len(os.listdir("/proc/self/fd")), threading.active_count()


def dropped(drop):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        drop()
        gc.collect()
    return [warning.category for warning in caught]


def test_dropped_controller_logs_out(served, caplog, comes):
    before = resources()

    def drop():
        controller = Controller(served.address, **served.keywords)
        controller.take_mastership("cfg")
        events = controller.subscribe(topics.execution())
        events.next()
        del events, controller

    with caplog.at_level(logging.DEBUG, "rapidgen.servers"):
        # The subscription, and its controller.
        assert dropped(drop) == [ResourceWarning] * 2
        assert comes(lambda: "GET /logout: " in caplog.text)
        assert comes(lambda: resources() == before)


def test_dropped_async_controller_logs_out(served, caplog):
    async def run():
        controller = AsyncController(served.address, **served.keywords)
        await controller.take_mastership("cfg")
        del controller
        gc.collect()
        while "GET /logout: " not in caplog.text:
            await asyncio.sleep(0.005)

    with caplog.at_level(logging.DEBUG, "rapidgen.servers"):
        assert dropped(lambda: asyncio.run(run())) == [ResourceWarning]


def test_fork_leaves_the_parents_session(served_two, caplog):
    with (
        caplog.at_level(logging.DEBUG, "rapidgen.servers"),
        Controller(served_two.address, **served_two.keywords) as controller,
        controller.mastership("cfg"),
        controller.subscribe(topics.execution()) as events,
    ):
        events.next()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)
            child = os.fork()
        if not child:
            code = 1
            try:
                with pytest.raises(ConnectionLost, match="forked"):
                    events.next()
                events.close()
                controller.close()
                code = 0
            finally:
                os._exit(code)
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
        assert "DELETE" not in caplog.text
        assert "logout" not in caplog.text
        assert controller.holder("cfg").mine
