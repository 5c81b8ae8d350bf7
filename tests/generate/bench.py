"""A bench: a generated driver on the virtual controller, driven with bytes.

Frames are packed here from the layout of the wire (length, type, comm, reply, sequence, ten
joints, velocity, duration; little endian), not by rapidgen's own codec.
"""

import math
import struct

from rapidgen.controller.controller import VirtualController
from rapidgen.generate import build, make_system

POINT = struct.Struct("<4ii10fff")
STOP = POINT.pack(64, 11, 2, 0, -4, *[0.0] * 12)
_CACHE = {}


def point(sequence, joints, duration, *, comm=1, velocity=0.0):
    padded = [*joints, *[0.0] * (10 - len(joints))]
    return POINT.pack(64, 11, comm, 0, sequence, *padded, velocity, duration)


def trajectory(joints, durations, *, request=True):
    """Frames of a trajectory: the first -1, the last -3, 1, 2, ... between."""
    count = len(joints)
    sequences = [-1, *range(1, count - 1), -3]
    return [
        point(s, j, d, comm=2 if request and s == -3 else 1)
        for s, j, d in zip(sequences, joints, durations, strict=True)
    ]


class Client:
    """One connection to a port of the virtual controller, in memory."""

    def __init__(self, bench, port):
        self.bench = bench
        self.network = bench.vc.network
        # In memory both ends have one address.
        self.endpoint = self.network.connect(bench.address, port)
        self.received = b""
        self.closed = False

    def send(self, data):
        vc = self.bench.vc
        vc.run_until(lambda: self.endpoint.connected, timeout=5)
        while data:
            taken = self.network.send(self.endpoint, data)
            data = data[taken:]
            if data:
                vc.run_for(0.001)

    def close(self):
        self.network.close(self.endpoint)

    def pump(self):
        """Take what has arrived."""
        while not self.closed:
            try:
                data = self.network.receive(self.endpoint, 65536)
            except OSError:
                self.closed = True
                return
            except Exception as fault:
                if type(fault).__name__ != "NetworkFault":
                    raise
                self.closed = True
                return
            if data is None:
                return
            if data == b"":
                self.closed = True
                return
            self.received += data

    def frames(self):
        """Whole frames received so far, oldest first, taken out of the buffer."""
        self.pump()
        found = []
        while len(self.received) >= 4:
            (length,) = struct.unpack_from("<i", self.received)
            if len(self.received) < length + 4:
                break
            found.append(self.received[: length + 4])
            self.received = self.received[length + 4 :]
        return found

    def wait_frame(self, timeout=5.0):
        """The next frame, or None."""
        found = []

        def there():
            self.pump()
            if len(self.received) >= 4:
                (length,) = struct.unpack_from("<i", self.received)
                return len(self.received) >= length + 4
            return self.closed

        self.bench.vc.run_until(there, timeout=timeout)
        found = self.frames()
        if found:
            self.received = b"".join(found[1:]) + self.received
            return found[0]
        return None


class Bench:
    """One driver on one virtual controller on the virtual clock."""

    def __init__(self, config, *, system=None, **options):
        key = (config, config.inputs)
        if key not in _CACHE:
            output = build(config)
            _CACHE[key] = (output, make_system(config, output))
        self.config = config
        self.output, self.system = _CACHE[key]
        self.system = system or self.system
        self.address = next(iter(config.allowed_clients), "10.0.0.1")
        self.vc = VirtualController(self.system, config.groups, **options)
        self.vc.run_for(0.5)

    @property
    def group(self):
        return self.vc.motion.group(self.config.groups[0].name)

    def joints(self, group=None):
        """Axis values in rad and m."""
        return self.vc.motion.group(group or self.config.groups[0].name).positions()

    def client(self, port=None):
        return Client(self, port or self.config.groups[0].ports.motion)

    def state_client(self):
        return Client(self, self.config.groups[0].ports.state)

    def pers(self, name, task="T_ROS_RECV"):
        return self.vc.tasks[task][f"ROS_common:{name}"]

    def healthy(self):
        """No task has stopped with an error."""
        return {n: t.fault for n, t in self.vc.tasks.items() if t.state == "error"} == {}

    def status(self, client):
        """The newest STATUS as a tuple of seven, after dropping what came before."""
        client.frames()
        while True:
            frame = client.wait_frame(timeout=2.0)
            assert frame is not None, "no state"
            if struct.unpack_from("<i", frame, 4)[0] == 13:
                return struct.unpack_from("<7i", frame, 16)

    def stop(self):
        self.vc.close()


def close_to(found, wanted, tolerance=1e-4):
    return all(math.isclose(a, b, abs_tol=tolerance) for a, b in zip(found, wanted, strict=True))
