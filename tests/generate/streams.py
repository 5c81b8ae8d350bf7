"""Batches of points and what answers them, by hand from the tables of docs/develop/protocol.md.

Rows are (duration, joints) in s, rad and m.
"""

import struct
from itertools import pairwise

BEGIN, END, FLUSH = 1, 2, 4
MODULUS = 2**51 - 129
POINTS, STOPPED, PAUSE, SPEED, HEARTBEAT, SIGNAL = 1302, 1303, 1304, 1305, 1306, 1307
HEAD = struct.Struct("<4i")


def pair(high, low):
    """Two numbers as one word."""
    return ((round(high * 1e6) + 2**25) << 26) + round(low * 1e6) + 2**25


def words_of(row):
    """The words of one point."""
    duration, joints = row
    values = [duration, *joints]
    if len(values) % 2:
        values.append(0.0)
    return [pair(*values[i : i + 2]) for i in range(0, len(values), 2)]


def checksum(words):
    c = 0
    for word in words:
        c = (2 * c + word) % MODULUS
    return c


def batch_of_words(stream, flags, first, count, words, *, comm=2, check=None):
    """A POINTS message of any words."""
    head = [stream + (flags << 32), first + (count << 32)]
    check = checksum([*head, *words]) if check is None else check
    data = struct.pack(f"<{len(words) + 3}Q", *head, *words, check)
    return HEAD.pack(12 + len(data), POINTS, comm, 0) + data


def batch(stream, first, rows, flags=0, *, comm=2, check=None):
    """A POINTS message."""
    words = [word for row in rows for word in words_of(row)]
    return batch_of_words(stream, flags, first, len(rows), words, comm=comm, check=check)


def batches(stream, rows, *, size=30, end=True, comm=2):
    """A whole stream: BEGIN in the first message, END in the last."""
    found = []
    for first in range(0, len(rows), size):
        flags = BEGIN if first == 0 else 0
        if end and first + size >= len(rows):
            flags |= END
        found.append(batch(stream, first, rows[first : first + size], flags, comm=comm))
    return found


def request(kind, data=b""):
    """A request of the control connection."""
    return HEAD.pack(12 + len(data), kind, 2, 0) + data


def reply(client, kind=POINTS, timeout=5.0):
    """(reply code, data) of the next reply of a kind; what came before it is dropped."""
    while True:
        frame = client.wait_frame(timeout=timeout)
        assert frame is not None, "no reply"
        _, found, comm, code = HEAD.unpack_from(frame)
        if (found, comm) == (kind, 3):
            return code, frame[16:]


def accepted(client):
    """(stream, trajectory, accepted, room, planned, reached, state) of a success."""
    code, data = reply(client)
    assert code == 1, struct.unpack("<6i", data)
    return struct.unpack("<7i", data)


def refused(client):
    """(stream, trajectory, accepted, reason, point, joint) of a failure."""
    code, data = reply(client)
    assert code == 2, struct.unpack("<7i", data)
    return struct.unpack("<6i", data)


def line(start, count, *, step=0.004, duration=0.1):
    """Rows from where the robot stands, each joint `step` farther; the first takes no time."""
    return [(duration if n else 0.0, [v + step * n for v in start]) for n in range(count)]


def seconds(rows):
    """How long the rows are, without the approach to the first."""
    return sum(duration for duration, _ in rows[1:])


def send_stream(client, rows, *, stream=7, size=30, end=True):
    """Send a stream with credits: a batch when the reply to the one before has told room for it."""
    room, first = 127, 0
    while first < len(rows):
        count = min(size, room, len(rows) - first)
        last = end and first + count == len(rows)
        flags = (BEGIN if first == 0 else 0) | (END if last else 0)
        if count or first == 0:
            client.send(batch(stream, first, rows[first : first + count], flags))
            first += count
        else:
            client.bench.vc.run_for(0.1)
            client.send(batch(stream, first, []))
        room = accepted(client)[3]


def positions(bench, seconds, *, step=0.004):
    """Joint values each `step` s from now on."""
    found = [bench.joints()]
    while len(found) * step < seconds:
        bench.vc.run_for(step)
        found.append(bench.joints())
    return found


def longest_rest(track, *, step=0.004):
    """s of the longest rest inside of a movement."""
    moves = [one != other for one, other in pairwise(track)]
    inside = moves[moves.index(True) : len(moves) - moves[::-1].index(True)]
    longest = current = 0
    for moving in inside:
        current = 0 if moving else current + 1
        longest = max(longest, current)
    return longest * step
