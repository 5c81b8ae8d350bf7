"""Which build serves a state port: the question that `doctor` and `deploy` ask a driver."""


def hello(host: str, port: int, timeout: float = 3.0) -> str | None:
    """BUILD_ID that a driver tells on its state port; None for another program. OSError: nobody."""
    import socket
    import time

    from rapidgen import __version__
    from rapidgen.wire.simple_message.codec import decode, encode
    from rapidgen.wire.simple_message.frames import FrameSplitter, WireError
    from rapidgen.wire.simple_message.messages import HelloReply, HelloRequest
    from rapidgen.wire.simple_message.spec import PROTOCOL_VERSION, Comm

    major, minor, patch = (int(part) for part in __version__.split(".")[:3])
    end = time.monotonic() + timeout
    with socket.create_connection((host, port), timeout) as connection:
        connection.sendall(
            encode(HelloRequest(PROTOCOL_VERSION, (major, minor, patch), 0), Comm.REQUEST)
        )
        splitter = FrameSplitter()
        try:
            while (left := end - time.monotonic()) > 0:
                connection.settimeout(left)
                block = connection.recv(4096)
                if not block:
                    return None
                splitter.feed(block)
                while (frame := splitter.next()) is not None:
                    content = decode(frame)
                    if isinstance(content, HelloReply):
                        return content.build_id
        except (WireError, TimeoutError):
            return None
    return None
