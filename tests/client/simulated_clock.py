"""An asyncio loop whose time is simulated, and a scripted driver on it: no sockets, no waiting.

For long streams: hours of them pass in seconds.
"""

import asyncio
import selectors
from collections import deque

from fake_controller import (
    HEAD,
    Script,
    frame,
    hello_reply,
    joint_frame,
    pieces,
    status_frame,
)


class _Jump(selectors.BaseSelector):
    """Lets time pass instead of waiting."""

    def __init__(self, loop):
        self._loop = loop

    def select(self, timeout=None):
        assert timeout is not None, "nothing is ahead"
        self._loop.now += max(0.0, timeout)
        return []

    def register(self, *_):
        raise NotImplementedError

    unregister = register

    def get_map(self):
        return {}


class SimulatedLoop(asyncio.BaseEventLoop):
    """Connections go to `driver.connect(port)`."""

    def __init__(self, driver):
        super().__init__()
        self.now = 0.0
        self._selector = _Jump(self)
        self._clock_resolution = 1e-9
        self.driver = driver
        driver.loop = self

    def time(self):
        return self.now

    def _process_events(self, events):
        """There are none."""

    def _write_to_self(self):
        """No other thread calls this loop."""

    async def create_connection(self, factory, host=None, port=None, **_):
        protocol = factory()
        transport = _Pipe(self, protocol, port)
        protocol.connection_made(transport)
        self.driver.opened(transport)
        await asyncio.sleep(0)
        return transport, protocol


class _Pipe(asyncio.Transport):
    """A connection with a short delay."""

    latency = 0.001

    def __init__(self, loop, protocol, port):
        super().__init__()
        self.loop, self.protocol, self.port = loop, protocol, port
        self.closed = False
        self.there, self.back = deque(), deque()

    # Two timers of the same moment fire in any order: what they deliver is in a queue.

    def write(self, data):
        if not self.closed:
            self.there.append(bytes(data))
            latency = self.loop.driver.latencies.get(self.port, self.latency)
            self.loop.call_later(latency, self._arrive)

    def _arrive(self):
        self.loop.driver.received(self, self.there.popleft())

    def tell(self, data):
        """From the driver to the client."""
        if not self.closed:
            self.back.append(data)
            self.loop.call_later(self.latency, self._tell)

    def _tell(self):
        data = self.back.popleft()
        if not self.closed:
            self.protocol.data_received(data)

    def set_write_buffer_limits(self, high=None, low=None):
        """The buffer is unlimited."""

    def close(self):
        if not self.closed:
            self.closed = True
            self.loop.driver.lost(self)
            self.loop.call_soon(self.protocol.connection_lost, None)


class SimulatedDriver:
    """A StreamModel as the three ports of a driver."""

    MOTION, CONTROL, STATE = 11000, 11001, 11002

    def __init__(self, model, *, state_period=0.1, control=True, pace=1):
        """`pace`: how much faster its clock runs than it says."""
        self.model, self.period = model, state_period
        self.script = Script(stream=model, control=control, state_period=state_period * pace)
        self.loop = None
        self.latencies = {}
        """s that bytes to a port need, where that is not the usual."""
        self.log = []
        """(time, port, message number)"""

    def opened(self, pipe):
        if pipe.port == self.STATE:
            self._tell_state(pipe)

    def lost(self, pipe):
        if pipe.port == self.CONTROL:
            self.model.control_lost()

    def received(self, pipe, data):
        self.model.advance(self.loop.time())
        for piece in pieces(data)[0]:
            number = HEAD.unpack_from(piece)[1]
            self.log.append((self.loop.time(), pipe.port, number))
            if number == 1300:
                pipe.tell(hello_reply(self.script, self.CONTROL))
            elif number == 1302:
                pipe.tell(self.model.points(piece))
            elif pipe.port == self.CONTROL:
                pipe.tell(self.model.control(number, piece[16:]))
            elif number == 11:
                self.model.halt(6, 40)
                pipe.tell(frame(11, 3, 1))

    def _tell_state(self, pipe):
        if pipe.closed:
            return
        model = self.model
        model.advance(self.loop.time())
        report = joint_frame(model.position) + status_frame(in_motion=int(model.is_moving))
        pipe.tell(report + (model.progress() if model.trajectory else b""))
        self.loop.call_later(self.period, self._tell_state, pipe)
