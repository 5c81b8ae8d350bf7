"""Subscriptions as iterators, over restarts, on three generations."""

import asyncio

import pytest

from rapidgen.client import RobotTimeout
from rapidgen.client.errors import ConnectionLost
from rapidgen.client.rws import AsyncController, Controller, topics
from rapidgen.client.rws.errors import RwsError

CHOSEN = (
    topics.execution(),
    topics.ctrl_state(),
    topics.signal("do x;1"),
    topics.symbol("T_ROB1/MainModule/x"),
    topics.log(),
)


def until(events, wanted):
    """Events up to one of (resource, value)."""
    received = []
    while (received[-1].resource, received[-1].value) != wanted if received else True:
        received.append(events.next(60))
    return [(event.resource, event.value) for event in received]


def test_events_come_as_things_change_and_go_on_over_a_restart(served):
    with (
        Controller(served.address, **served.keywords) as controller,
        controller.subscribe(*CHOSEN) as events,
    ):
        now = [events.next(60) for _ in range(4)]
        assert [(e.resource, e.value) for e in now] == [
            ("execution", "stopped"),
            ("ctrlstate", "motoron"),
            ("do x;1", "0"),
            ("T_ROB1/MainModule/x", "1"),
        ]
        for value in (1, 0, 1):
            controller.set_signal("do x;1", value)
        received = [events.next(60).value for _ in range(3)]
        assert received == ["1", "0", "1"]
        controller.set_symbol("T_ROB1/x", 5)
        until(events, ("T_ROB1/MainModule/x", "5"))
        controller.start()
        received = until(events, ("execution", "running"))
        assert any(name == "log 0" for name, _ in received)
        controller.restart()
        assert ("execution", "stopped") in until(events, ("ctrlstate", "motoroff"))
        until(events, ("T_ROB1/MainModule/x", "5"))
        controller.set_symbol("T_ROB1/x", 6)
        until(events, ("T_ROB1/MainModule/x", "6"))
        with controller.subscribe(topics.mode()) as quiet:
            assert quiet.next(60).value == "AUTO"
            with pytest.raises(RobotTimeout):
                quiet.next(0.01)


def test_no_ticket_of_tls_comes_between_a_read_and_a_write(served_two):
    """One thread reads and one writes: a write during TLS 1.3's tickets was lost, and the
    handshake of the websocket waited for ever, once in a thousand."""
    with (
        Controller(served_two.address, **served_two.keywords) as controller,
        controller.subscribe(topics.mode()) as events,
    ):
        assert events._socket.socket.version() == "TLSv1.2"


def test_a_websocket_that_is_lost_at_its_opening_is_opened_again(served, monkeypatch):
    with (
        Controller(served.address, **served.keywords) as controller,
        controller.subscribe(topics.symbol("T_ROB1/x")) as events,
    ):
        assert events.next(60).value == "1"
        opened, carrier = [], type(events._runner)
        real = carrier.open_socket

        def lost_once(self, path, stack):
            opened.append(path)
            if len(opened) == 1:
                raise ConnectionLost.because("RG601", "the controller restarts again")
            return real(self, path, stack)

        monkeypatch.setattr(carrier, "open_socket", lost_once)
        controller.restart()
        assert events.next(60).value == "1"
        assert len(opened) == 2


def test_async_subscription_receives_same_events(served):
    async def run():
        async with (
            AsyncController(served.address, **served.keywords) as controller,
            controller.subscribe(topics.symbol("T_ROB1/x")) as events,
        ):
            assert (await events.next(60)).value == "1"
            await controller.set_symbol("T_ROB1/x", 2)
            async for event in events:
                assert event.value == "2"
                break

    asyncio.run(run())


def test_what_cannot_be_subscribed_is_refused(served):
    with Controller(served.address, **served.keywords) as controller:
        for topic in (topics.signal("none"), topics.symbol("T_ROB1/count"), topics.task("T_NONE")):
            with pytest.raises(RwsError):
                controller.subscribe(topic)
        held = [controller.subscribe(topics.mode()) for _ in range(2)]
        with pytest.raises(Exception, match="503"):
            controller.subscribe(topics.mode())
        for one in held:
            one.close()
