"""Hash of the joint map, so that client and driver detect differences."""

from collections.abc import Iterable
from hashlib import sha256


def mapping_hash(joints: Iterable[tuple[str, str, str, int, float]], coupling: float) -> str:
    """Return 12 hexadecimal digits over the joint map, in wire order.

    Each joint is (name, axis, kind, sign, offset). `coupling` is the factor k of controller axis 3
    = J3 + k * J2, `offset` is rad or m.
    """
    rows = [
        f"{name}\t{axis}\t{kind}\t{sign:d}\t{offset:.9g}"
        for name, axis, kind, sign, offset in joints
    ]
    return sha256("\n".join([*rows, f"{coupling:.9g}"]).encode()).hexdigest()[:12]
