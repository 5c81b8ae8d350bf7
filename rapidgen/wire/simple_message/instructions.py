"""The instructions of a PROGRAM as words: what stands where, for client and page."""

from collections.abc import Sequence

from rapidgen.wire.simple_message.messages import PROGRAM
from rapidgen.wire.simple_message.spec import (
    FIXED_LIMIT,
    FIXED_SCALE,
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
}
"""Of each instruction the operands: position x, y, z in m, orientation w, x, y, z, a word each of
the group's joints in rad or m."""
MODALS: dict[Modal, str] = {
    Modal.SPEED: "speeds of the TCP m/s, its orientation rad/s, external axes m/s and rad/s",
    Modal.ZONE: "1 stop point, 0 not; radii of the TCP, its orientation, external axes, m; of "
    "orientation rad, of linear m and of rotary external axes rad",
}


def fixed(values: Sequence[float]) -> list[int]:
    """Fixed-point words. ValueError: one of them is none, or too large."""
    if not all(-FIXED_LIMIT <= value <= FIXED_LIMIT for value in values):
        raise ValueError(f"{values} do not fit into words")
    return [round(value * FIXED_SCALE) for value in values]


def instruction(
    kind: Instruction,
    operands: Sequence[float],
    *,
    speed: Sequence[float] | None = None,
    zone: Sequence[float] | None = None,
) -> list[int]:
    """The words of one instruction; `speed` (4) and `zone` (7) where they change."""
    first = int(kind)
    values: list[float] = []
    if speed is not None:
        first |= Modal.SPEED
        values += speed
    if zone is not None:
        first |= Modal.ZONE
        values += zone
    return [first, *fixed([*values, *operands])]
