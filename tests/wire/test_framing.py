"""Framed JSON messages: valid, divided and hostile input."""

import json
import socket
import subprocess
import sys
import threading

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidgen._message_streams import MessageStream, listening
from rapidgen.wire.framing import (
    MAX_DEPTH,
    MAX_HEADER,
    ContentError,
    FramingError,
    MessageSplitter,
    encode,
)

# Written by hand from the base protocol of LSP 3.17, which DAP shares.
HELLO = b'Content-Length: 15\r\n\r\n{"seq":1,"a":2}'


def split(data: bytes) -> dict | None:
    splitter = MessageSplitter()
    splitter.feed(data)
    return splitter.next()


def framed(body: bytes) -> bytes:
    return b"Content-Length: %d\r\n\r\n" % len(body) + body


def nested(levels: int) -> bytes:
    return framed(b'{"a":' + b"[" * (levels - 1) + b"]" * (levels - 1) + b"}")


def test_message_is_encoded_as_the_protocol_says():
    assert encode({"seq": 1, "a": 2}) == HELLO


@pytest.mark.parametrize(
    "header",
    [
        b"Content-Length: 15\r\n\r\n",
        b"content-length:15\r\n\r\n",
        b"Content-Type: application/vscode-jsonrpc; charset=utf-8\r\nContent-Length: 15\r\n\r\n",
    ],
)
def test_header_variants_are_accepted(header):
    assert split(header + HELLO[-15:]) == {"seq": 1, "a": 2}


@given(st.lists(st.integers(1, 40)), st.text(max_size=20))
def test_division_of_the_stream_does_not_matter(cuts, text):
    data = HELLO + encode({"text": text}) + HELLO
    splitter, messages = MessageSplitter(), []
    for size in [*cuts, len(data)]:
        splitter.feed(data[:size])
        data = data[size:]
        while (message := splitter.next()) is not None:
            messages.append(message)
    assert messages == [{"seq": 1, "a": 2}, {"text": text}, {"seq": 1, "a": 2}]
    assert splitter.pending == 0


def test_half_surrogate_pair_is_returned():
    assert split(encode({"text": "\ud800"})) == {"text": "\ud800"}


@pytest.mark.parametrize(
    "data",
    [
        b"Content-Length: 99999999999\r\n\r\n",
        b"Content-Length: " + b"9" * 900 + b"\r\n\r\n",
        b"Content-Length: -1\r\n\r\n",
        b"Content-Length: +5\r\n\r\n",
        b"Content-Length: 0x10\r\n\r\n",
        b"Content-Length: \r\n\r\n",
        b"Content-Length: 5\r\nContent-Length: 6\r\n\r\n",
        b"Content-Type: x\r\n\r\n",
        b"\r\n\r\n",
        b"x" * MAX_HEADER,
        b"POST /a HTTP/1.1\r\nHost: 127.0.0.1\r\n",
        b"POST /a:b HTTP/1.1\r\nContent-Length: 15\r\n\r\n" + HELLO,
    ],
)
def test_wrong_header_ends_the_stream(data):
    splitter = MessageSplitter()
    splitter.feed(data)
    for _ in range(2):
        with pytest.raises(FramingError):
            splitter.next()
        splitter.feed(HELLO)
    assert splitter.pending == 0


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"[]",
        b"1",
        b"{",
        b"{'a':1}",
        b'{"a":NaN}',
        b'{"a":1e999}',
        b'{"a":"\xff"}',
        b'{"a":1} {}',
        b'{"a":' + b"1" * 5000 + b"}",
        b'{"a":' + b"[" * 200_000 + b"}",
    ],
)
def test_wrong_content_is_skipped(body):
    splitter = MessageSplitter()
    splitter.feed(framed(body) + HELLO)
    with pytest.raises(ContentError):
        splitter.next()
    assert splitter.next() == {"seq": 1, "a": 2}


def test_depth_is_limited():
    assert split(nested(MAX_DEPTH)) is not None
    with pytest.raises(ContentError, match="levels"):
        split(nested(MAX_DEPTH + 1))


def test_brackets_in_texts_are_no_levels():
    assert split(encode({"text": "[{" * 500})) == {"text": "[{" * 500}


def test_message_above_the_limit_is_refused():
    splitter = MessageSplitter(max_message=14)
    splitter.feed(HELLO)
    with pytest.raises(FramingError, match="15 bytes"):
        splitter.next()


def test_tcp_serves_clients_one_after_another():
    received = []
    with listening(0) as (port, clients):

        def serve():
            for _ in range(2):
                stream = next(clients)
                while (message := stream.read()) is not None:
                    received.append(message)
                    stream.write(message)

        thread = threading.Thread(target=serve)
        thread.start()
        for number in (1, 2):
            with socket.create_connection(("127.0.0.1", port)) as own:
                mine = MessageStream(own.recv, own.sendall)
                mine.write({"number": number})
                assert mine.read() == {"number": number}
        thread.join()
    assert received == [{"number": 1}, {"number": 2}]


def test_lost_client_is_noted():
    def send(_data: bytes) -> None:
        raise BrokenPipeError

    stream = MessageStream(lambda _size: b"", send)
    stream.write({})
    assert stream.is_lost
    assert stream.read() is None


def test_prints_do_not_get_between_messages():
    program = (
        "from rapidgen._message_streams import standard_stream\n"
        "with standard_stream() as stream:\n"
        "    print('noise')\n"
        "    stream.write(stream.read())\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], input=HELLO, capture_output=True, check=True
    )
    assert json.loads(done.stdout.partition(b"\r\n\r\n")[2]) == {"seq": 1, "a": 2}
    assert done.stderr == b"noise\n"
