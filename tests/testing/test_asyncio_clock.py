"""asyncio clients on the virtual clock."""

import asyncio
import contextlib

import pytest

from rapidgen.controller import Deadlock, VirtualController
from rapidgen.system.model import ModuleFile, System, TaskSpec
from rapidgen.testing.asyncio_clock import VirtualLoop, run

ECHO = b"""
MODULE echo
  VAR socketdev server;
  VAR socketdev client;
  PROC main()
    VAR string text;
    SocketCreate server;
    SocketBind server, GetSysInfo(\\LanIp), 11000;
    SocketListen server;
    SocketAccept server, client \\Time:=WAIT_MAX;
    WHILE TRUE DO
      SocketReceive client \\Str:=text \\Time:=WAIT_MAX;
      SocketSend client \\Str:=text;
    ENDWHILE
  ENDPROC
ENDMODULE
"""


def controller(text: bytes = ECHO, **options) -> VirtualController:
    module = ModuleFile("echo", "echo.mod", text)
    return VirtualController(System("echo", (TaskSpec("T_ROB1", modules=(module,)),)), **options)


async def talk(rounds: int) -> float:
    loop = asyncio.get_running_loop()
    reader, writer = await asyncio.open_connection("127.0.0.1", 11000)
    for i in range(rounds):
        writer.write(b"%06d" % i)
        await writer.drain()
        assert await reader.readexactly(6) == b"%06d" % i
    writer.close()
    await writer.wait_closed()
    return loop.time()


async def connect_and_talk(rounds: int) -> float:
    await asyncio.sleep(0.1)
    return await talk(rounds)


def test_round_trips_take_simulated_time_only() -> None:
    with controller() as c:
        finished = run(c, connect_and_talk(300))
        # Two socket calls of 500 us and two ways of 100 us for each round.
        assert finished == pytest.approx(0.1 + 300 * 0.0012, rel=0.1)


def test_same_seed_same_time() -> None:
    def once(seed: int) -> tuple[float, int]:
        with controller(seed=seed) as c:
            return run(c, connect_and_talk(50)), c.scheduler.switches

    assert once(1) == once(1)


def test_sleep_and_timeout() -> None:
    async def main() -> list[float]:
        loop = asyncio.get_running_loop()
        seen = [loop.time()]
        await asyncio.sleep(3600)
        seen.append(loop.time())
        with pytest.raises(TimeoutError):
            async with asyncio.timeout(60):
                await asyncio.Event().wait()
        seen.append(loop.time())
        return seen

    with controller() as c:
        assert run(c, main()) == pytest.approx([0, 3600, 3660], abs=1e-6)


def test_a_port_without_a_server_refuses() -> None:
    with controller() as c, pytest.raises(ConnectionRefusedError):
        run(c, asyncio.wait_for(asyncio.open_connection("127.0.0.1", 4711), 5))


def test_waiting_for_nothing_is_a_deadlock() -> None:
    async def main() -> None:
        await asyncio.Event().wait()

    with controller() as c:
        loop = VirtualLoop(c)
        task = loop.create_task(main())
        with pytest.raises(Deadlock, match=r"echo\.mod:10"):
            loop.run_until_complete(task)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            loop.run_until_complete(task)
        loop.close()


def test_more_than_the_buffers_hold() -> None:
    """Back-pressure: a reader that does not read stops the writer, which loses nothing."""
    text = ECHO.replace(b"SocketSend client \\Str:=text;", b"").replace(
        b"WHILE TRUE DO", b"WaitTime 5;\n    WHILE TRUE DO"
    )

    async def main() -> float:
        loop = asyncio.get_running_loop()
        await asyncio.sleep(0.1)
        _, writer = await asyncio.open_connection("127.0.0.1", 11000)
        for _ in range(40):
            writer.write(b"x" * 10_000)
            await writer.drain()
        finished = loop.time()
        writer.transport.abort()
        with contextlib.suppress(ConnectionError):
            await writer.wait_closed()
        return finished

    with controller(text) as c:
        assert run(c, main()) > 5


def test_the_private_names_of_asyncio_are_there() -> None:
    with controller() as c:
        loop = VirtualLoop(c)
        for name in ("_ready", "_scheduled", "_run_once", "_clock_resolution"):
            assert hasattr(loop, name), name
        loop.close()
