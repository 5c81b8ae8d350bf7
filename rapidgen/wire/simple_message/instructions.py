"""Instructions of a PROGRAM as words, for the client and the page."""

from collections.abc import Sequence
from struct import pack, unpack

from rapidgen.wire.simple_message.messages import PROGRAM
from rapidgen.wire.simple_message.spec import (
    FIXED_LIMIT,
    FIXED_SCALE,
    LONGEST_TEXT,
    MAX_LENGTH,
    Instruction,
    Modal,
)

WORDS = (MAX_LENGTH - PROGRAM.length) // 4
"""Words that one PROGRAM holds."""

OPERANDS: dict[Instruction, str] = {
    Instruction.MOVE_ABSJ: "joints, in rad or m",
    Instruction.MOVE_J: "position, orientation, joints",
    Instruction.MOVE_L: "position, orientation, joints",
    Instruction.MOVE_C: "position, orientation on the way, position, orientation, joints",
    Instruction.WAIT: "seconds",
    Instruction.WAIT_SIGNAL: "number of the signal as of SIGNAL, its value, seconds at most",
    Instruction.SET: "number of the signal as of SIGNAL, its value",
    Instruction.CALL: "number of the routine, from 0, seconds at most (0: any); of each parameter "
    "a num as float32, a bool as 1 or 0, a string as its length and its characters, four in a "
    "word, a robtarget as position, orientation, joints, a jointtarget as joints",
    Instruction.SETTINGS: "bits, which hold until the program ends or says otherwise: 1 SingArea "
    "with Wrist, 2 ConfL with Off",
    Instruction.TOOL: "values of the program's own tool: position and orientation of its frame, "
    "centre of mass and orientation of the axes of inertia, mass in kg, moments ix, iy, iz (kg m2)",
    Instruction.WORK_OBJECT: "values of the program's own work object: position and orientation "
    "of its user frame, of its object frame",
}
"""Operands of each instruction: position x, y, z in m, orientation w, x, y, z, a word for each of
the group's joints in rad or m.
"""
MODALS: dict[Modal, str] = {
    Modal.SPEED: "speeds of the TCP m/s, its orientation rad/s, external axes m/s and rad/s",
    Modal.ZONE: "1 stop point, 0 not; radii of the TCP, its orientation, external axes, m; of "
    "orientation rad, of linear m and of rotary external axes rad",
    Modal.FRAMES: "numbers of tool and work object; 0 the group's own, 1 the first other one, the "
    "one after the last that of TOOL or WORK_OBJECT",
    Modal.SIGNALS: "how many, 1 to 8; of each its number, its value, where it is set (0 m from the "
    "beginning, 1 m before the end, 2 s before the end) and that distance",
}
MOST_SIGNALS = 8
"""Maximum number of signals set on one move."""


def fixed(values: Sequence[float]) -> list[int]:
    """Return fixed-point words.

    ValueError: a value is NaN or too large.
    """
    if not all(-FIXED_LIMIT <= value <= FIXED_LIMIT for value in values):
        raise ValueError(f"{values} do not fit into words")
    return [round(value * FIXED_SCALE) for value in values]


def instruction(
    kind: Instruction,
    operands: Sequence[float],
    *,
    speed: Sequence[float] | None = None,
    zone: Sequence[float] | None = None,
    frames: tuple[int, int] | None = None,
    signals: Sequence[Sequence[float]] = (),
    arguments: Sequence[float | bool | str | tuple[float, ...]] = (),
) -> list[int]:
    """Return the words of one instruction.

    `speed` (4), `zone` (7) and `frames` if they change; `signals` have four words each. `arguments`
    are those of a routine; those of a target are its operands.
    """
    first = int(kind)
    values: list[float] = []
    if speed is not None:
        first |= Modal.SPEED
        values += speed
    if zone is not None:
        first |= Modal.ZONE
        values += zone
    if frames is not None:
        first |= Modal.FRAMES
        values += frames
    if signals:
        first |= Modal.SIGNALS
        values += [len(signals), *(value for one in signals for value in one)]
    return [first, *fixed([*values, *operands]), *(w for a in arguments for w in _argument(a))]


def _argument(value: float | bool | str | tuple[float, ...]) -> Sequence[int]:
    """Return the words of an argument.

    ValueError: it does not fit.
    """
    if isinstance(value, tuple):
        return fixed(value)
    if isinstance(value, bool):
        return (FIXED_SCALE * value,)
    if isinstance(value, str):
        data = value.encode("latin-1")
        if len(data) > LONGEST_TEXT:
            raise ValueError(f"{value!r} has more than {LONGEST_TEXT} characters")
        filled = data + bytes(-len(data) % 4)
        return FIXED_SCALE * len(data), *unpack(f"<{len(filled) // 4}i", filled)
    return unpack("<i", pack("<f", value))
