"""The TCP moves as a joystick says: a device of Linux, the keyboard, or a script.

A joystick is read from /dev/input/js0, a keyboard from the terminal (arrows: x and y, PageUp and
PageDown: z). Without both, a script moves the stick. Release the stick and the robot stops.
"""

import os
import select
import struct
import sys
from collections.abc import Iterator
from pathlib import Path

from guiding import session_of

SPEED = 0.08  # m/s at full deflection
SECONDS = 2.5
DEVICE = Path("/dev/input/js0")
KEYS = {"[A": (1, 0, 0), "[B": (-1, 0, 0), "[C": (0, -1, 0), "[D": (0, 1, 0)}
KEYS |= {"[5": (0, 0, 1), "[6": (0, 0, -1)}


def joystick() -> Iterator[tuple[float, float, float]]:
    """Axes of a joystick, -1 to 1: events of 8 bytes (time, value, type, number)."""
    axes = [0.0, 0.0, 0.0]
    with DEVICE.open("rb", buffering=0) as device:
        while True:
            while select.select([device], [], [], 0)[0]:
                _, value, kind, number = struct.unpack("<IhBB", device.read(8))
                if kind & 0x02 and number < 3:
                    axes[number] = -value / 32767
            yield axes[1], axes[0], axes[2]


def keyboard() -> Iterator[tuple[float, float, float]]:
    """A key that is held down repeats; 0.3 s after the last one the stick is released."""
    import termios
    import tty

    file = sys.stdin.fileno()
    settings = termios.tcgetattr(file)
    tty.setcbreak(file)
    axes, left = (0.0, 0.0, 0.0), 0
    try:
        while True:
            if select.select([file], [], [], 0)[0]:
                typed = os.read(file, 16).decode(errors="replace")
                axes, left = KEYS.get(typed[1:3], (0.0, 0.0, 0.0)), 75
            left -= 1
            yield axes if left > 0 else (0.0, 0.0, 0.0)
    finally:
        termios.tcsetattr(file, termios.TCSADRAIN, settings)


def script() -> Iterator[tuple[float, float, float]]:
    """A second forward, half a second up, then released."""
    for stick, frames in (((1.0, 0.0, 0.0), 250), ((0.0, 0.0, 1.0), 125)):
        for _ in range(frames):
            yield stick
    while True:
        yield 0.0, 0.0, 0.0


source = joystick() if DEVICE.exists() else keyboard() if sys.stdin.isatty() else script()
with session_of("guided_tcp.mod") as session:
    begin = session.state
    state, seconds = begin, 0.0 if sys.stdin.isatty() else SECONDS
    while not seconds or state.controller_time - begin.controller_time < seconds:
        x, y, z = next(source)
        session.send(speeds=[SPEED * x, SPEED * y, SPEED * z, 0.0, 0.0, 0.0])
        state = session.next_state()
    session.stop()
    moved = [(b - a) * 1000 for a, b in zip(begin.pose[0], state.pose[0], strict=True)]
    print("moved by {:.0f}, {:.0f}, {:.0f} mm".format(*moved))
