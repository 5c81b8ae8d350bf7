"""The reader's thread ends with every channel closed, whenever the channel came."""

import socket

from rapidgen.client.address import Address
from rapidgen.client.channels import Channel, Reader
from rapidgen.wire.simple_message.spec import Port


def test_a_channel_that_comes_with_the_end_is_closed():
    def unused(*_):
        raise AssertionError

    reader = Reader(unused, unused, unused, lambda: False, "test")
    reader._change = lambda: None  # the end comes before it looks
    with socket.create_server(("127.0.0.1", 0)) as server:
        number = server.getsockname()[1]
        channel = Channel(Address("127.0.0.1", number, number), Port.MOTION, 5)
        reader.add(channel)
        reader.close()
        assert channel.socket.fileno() == -1
