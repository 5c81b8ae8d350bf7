"""Position of a robot as text for a program.

RAPID in deg and mm, Python in rad and m.
"""

from collections.abc import Iterable

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Kinematics, Posture, orientation
from rapidgen.axes.mapping import ABSENT, JointMap
from rapidgen.viewer.messages import Copy
from rapidgen.viewer.provider import RequestRejected
from rapidgen.viewer.robots import ToolAndWorkObject


def copied(
    form: Copy,
    map: JointMap,
    kinematics: Kinematics | None,
    posture: Posture,
    carried: ToolAndWorkObject,
) -> str:
    """Return a posture in the requested form.

    RequestRejected: the model has no geometry.
    """
    if form.form == "jointtarget":
        return jointtarget(map, posture)
    if form.form == "python":
        return python(map, posture)
    tcp = carried.tcp(kinematics, posture)
    if tcp is None or kinematics is None:
        raise RequestRejected(f"the model of {form.group} has no geometry")
    return robtarget(kinematics, posture, tcp, carried.object)


def jointtarget(map: JointMap, posture: Posture) -> str:
    """A jointtarget of controller axis values."""
    robot, external = map.to_rapid(posture)
    return f"[{_row(robot, 4)},{_row(external, 4)}]"


def robtarget(
    kinematics: Kinematics, posture: Posture, tcp: frames.Pose, object: frames.Pose
) -> str:
    """Return a robtarget: the TCP (world) in the object.

    It has the configuration of the posture.
    """
    seen = frames.within(object, tcp)
    place = _row((value * 1000 for value in seen[0]), 3)
    turned = _row(orientation(seen), 7)
    _, external = kinematics.map.to_rapid(posture)
    configuration = _row(kinematics.configuration(posture), 0)
    return f"[{place},{turned},{configuration},{_row(external, 4)}]"


def python(map: JointMap, posture: Posture) -> str:
    """Return joint values by name, as the client accepts them."""
    values = zip(map.names, map.to_urdf(posture), strict=True)
    return "{" + ", ".join(f'"{name}": {value:.6f}' for name, value in values) + "}"


def _row(values: Iterable[float], digits: int) -> str:
    return "[" + ",".join(map(lambda value: _number(value, digits), values)) + "]"


def _number(value: float, digits: int) -> str:
    if value > ABSENT / 2:
        return "9E9"
    text = f"{value:.{digits}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if text == "-0" else text
