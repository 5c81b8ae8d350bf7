"""Display of a robot: one line of text, or a table in HTML.

Both show degrees and mm for people; programs read rad and m.
"""

import math
from collections.abc import Sequence

from rapidgen.client.address import Address
from rapidgen.client.core.group import Group
from rapidgen.client.core.robot import Core
from rapidgen.client.html_tables import table
from rapidgen.config.model import Joint


def in_units(value: float, joint: Joint) -> str:
    """An axis value (rad, m) in degrees or mm."""
    if joint.kind == "prismatic":
        return f"{value * 1000:.2f} mm"
    return f"{math.degrees(value):.2f}°"


def robot_text(core: Core, address: Address) -> str:
    """Describe a robot: its address, the driver that answered, and its state."""
    name = core.group.name if core.group is not None else ""
    whom = f"{name} at {address}" if name else str(address)
    if not core.is_connected:
        return f"{whom}, not connected"
    driver = core.state_port.driver
    name = f"rapidgen {driver.version}" if driver.is_rapidgen else "plain simple_message"
    return f"{whom}: {name}, {core.state_port.status}"


def state_table(caption: str, group: Group, joints: Sequence[float]) -> str:
    """Table of joints (rad, m, URDF order) with the limits of their axes."""
    axes = group.map.to_controller(joints)
    return table(
        caption,
        ("joint", "value", "axis", "least", "is", "most"),
        (
            (
                joint.name,
                in_units(value, joint),
                joint.axis,
                in_units(joint.lower, joint),
                in_units(axis, joint),
                in_units(joint.upper, joint),
            )
            for joint, value, axis in zip(group.joints, joints, axes, strict=False)
        ),
    )
