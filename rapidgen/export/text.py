"""Values and instructions as RAPID text.

Lengths have four decimals (0.1 µm), angles five, quaternions seven: together below a micrometre at
the TCP of a large robot, and short enough to be read. Other values have the seven significant
digits of a num [K §2.13].
"""

from collections.abc import Sequence

from rapidgen.export.description import (
    NOT_CONNECTED,
    Frame,
    JointTarget,
    Load,
    RobTarget,
    Speed,
    Target,
    ToolData,
    Trigger,
    WorkObjectData,
    Zone,
)

_NONE = "[9E9,9E9,9E9,9E9,9E9,9E9]"
_ABSENT = 8.9e9
"""Above it, an external axis is not connected (9E9)."""


def decimals(value: float, places: int) -> str:
    """Return a number with at most so many decimals."""
    text = f"{value:.{places}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def number(value: float) -> str:
    """Return a number with seven significant digits."""
    text = f"{value:.7G}"
    return "0" if text == "-0" else text.replace("E+0", "E").replace("E+", "E").replace("E-0", "E-")


def truth(value: bool) -> str:
    return "TRUE" if value else "FALSE"


def string(value: str) -> str:
    """Return a string literal: quotes and backslashes are doubled."""
    escaped = value.replace("\\", "\\\\").replace('"', '""')
    return f'"{escaped}"'


def joined(values: Sequence[float], places: int) -> str:
    return "[" + ",".join([decimals(value, places) for value in values]) + "]"


def external(values: Sequence[float]) -> str:
    """Return extax: deg or mm."""
    if values == NOT_CONNECTED:
        return _NONE
    return "[" + ",".join("9E9" if v > _ABSENT else decimals(v, 5) for v in values) + "]"


def target(value: Target) -> str:
    """Return a robtarget or a jointtarget."""
    if isinstance(value, JointTarget):
        return f"[{joined(value.robax, 5)},{external(value.extax)}]"
    conf = ",".join(map(str, value.conf))
    return f"[{joined(value.trans, 4)},{joined(value.rot, 7)},[{conf}],{external(value.extax)}]"


def target_type(value: Target) -> str:
    return "robtarget" if isinstance(value, RobTarget) else "jointtarget"


def speed(value: Speed) -> str:
    return f"[{','.join(map(number, value))}]"


def zone(value: Zone) -> str:
    return f"[{truth(value.finep)},{','.join(map(number, value.sizes))}]"


def frame(value: Frame) -> str:
    return f"[{joined(value.trans, 4)},{joined(value.rot, 7)}]"


def load(value: Load) -> str:
    inertia = ",".join(map(number, value.inertia))
    return f"[{number(value.mass)},{joined(value.centre, 4)},{joined(value.axes, 7)},{inertia}]"


def tool(value: ToolData) -> str:
    return f"[{truth(value.held)},{frame(value.frame)},{load(value.load)}]"


def work_object(value: WorkObjectData) -> str:
    return f'[{truth(value.held)},TRUE,"",{frame(value.user)},{frame(value.object)}]'


def trigger(value: Trigger, name: str) -> str:
    """Return the TriggIO that defines a trigger."""
    switch = {"start": " \\Start", "end": "", "time": " \\Time"}[value.reference]
    place = number(value.place)
    signal = f"\\{value.kind}p:={value.signal}"
    return f"TriggIO {name}, {place}{switch} {signal}, {number(value.value)};"
