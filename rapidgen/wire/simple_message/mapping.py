"""The hash by which client and driver find out that their joint maps differ."""

from collections.abc import Iterable
from hashlib import sha256


def mapping_hash(joints: Iterable[tuple[str, str, str, int, float]], coupling: float) -> str:
    """12 hexadecimal digits over (name, axis, kind, sign, offset) of each joint, in wire order.

    `coupling` is the factor k of controller axis 3 = J3 + k * J2, `offset` is rad or m.
    """
    rows = [
        f"{name}\t{axis}\t{kind}\t{sign:d}\t{offset:.9g}"
        for name, axis, kind, sign, offset in joints
    ]
    return sha256("\n".join([*rows, f"{coupling:.9g}"]).encode()).hexdigest()[:12]
