"""Messages to a page: complete and in order, except passing ones.

The page may read slowly.
"""

import asyncio
import socket
from contextlib import asynccontextmanager

import pytest

from rapidgen.viewer.page_connection import UNREAD, PageConnection, text_frame

FRAME = text_frame(bytes(range(256)) * 4000)
"""Longer than what a socket takes at once."""


@asynccontextmanager
async def viewed():
    """A viewer, and the end that reads on request."""
    ours, theirs = socket.socketpair()
    theirs.setblocking(False)
    with theirs:
        loop = asyncio.get_running_loop()
        transport, _ = await loop.create_connection(asyncio.Protocol, sock=ours)
        viewer = PageConnection(transport)
        yield viewer, theirs
        viewer.close()
        transport.abort()


async def read(end, size):
    got = b""
    while len(got) < size:
        got += await asyncio.get_running_loop().sock_recv(end, size - len(got))
    return got


def test_a_page_that_reads_late_misses_what_is_passing_alone():
    async def run():
        async with viewed() as (viewer, end):
            viewer.send(FRAME)
            waiting = viewer.transport.get_write_buffer_size()
            # The socket has taken what it could; the rest waits, and nothing twice.
            assert 0 < waiting < len(FRAME)
            viewer.send(b"passing", passing=True)
            viewer.send(b"news")
            assert viewer.transport.get_write_buffer_size() == waiting + 4
            assert await read(end, len(FRAME) + 4) == FRAME + b"news"
            viewer.send(b"passing", passing=True)
            assert await read(end, 7) == b"passing"

    asyncio.run(run())


def test_a_page_that_never_reads_is_cut_off():
    async def run():
        async with viewed() as (viewer, _):
            while viewer.transport.get_write_buffer_size() <= UNREAD:
                viewer.send(FRAME)
            assert not viewer.transport.is_closing()
            viewer.send(b"news")
            assert viewer.transport.is_closing()

    asyncio.run(run())


def test_data_of_closed_page_reaches_no_other_page():
    async def run():
        async with viewed() as (viewer, end):
            number = viewer.transport.get_extra_info("socket").fileno()
            viewer.transport.abort()
            await asyncio.sleep(0)
            # The system gives the lowest free number to who comes next.
            other, far = socket.socketpair()
            with other, far:
                assert number in (other.fileno(), far.fileno())
                other.setblocking(False)
                far.setblocking(False)
                end.close()
                viewer.send(b"news")
                for socket_of_another in (other, far):
                    with pytest.raises(BlockingIOError):
                        socket_of_another.recv(1)

    asyncio.run(run())


@pytest.mark.parametrize("size", [0, 125, 126, 65_535, 65_536])
def test_a_frame_says_its_length_as_short_as_it_can(size):
    frame = text_frame(b"x" * size)
    assert frame[0] == 0x81
    short = frame[1]
    head = 2 if size < 126 else 4 if size < 65_536 else 10
    assert short == (size if size < 126 else 126 if size < 65_536 else 127)
    assert size < 126 or int.from_bytes(frame[2:head], "big") == size
    assert frame[head:] == b"x" * size
