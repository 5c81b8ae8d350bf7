"""Externally guided motion of a group: checks of `egm:`, and its settings in SI units.

A build with `egm:` lets another computer move the robot. So this rejects what no source describes:
releases with mixed units, other arms than those with six or seven turning axes, external axes.
"""

import math

from rapidgen.config import model, schema
from rapidgen.config.draft import DraftFindings
from rapidgen.config.draft import Path as KeyPath
from rapidgen.config.plausibility import is_host, is_radians
from rapidgen.diagnostics import Severity

DEFAULT_DEVICE, DEFAULT_PORT = "ROS_EGM", 6510
OPTIONS = {6: "689-1", 7: "3124-1", 8: "3124-1"}
"""Option of the controller, by RobotWare generation [manual 3HAC073318 1.1]."""
_FIRST = (6, 7)
"""Earlier messages mix rad and deg [code: abb_libegm, egm_base_interface.cpp]."""
_ROBOT_AXES = tuple(f"rax_{n}" for n in range(1, 7))
_SMALL = 1.0
"""deg and deg/s: smaller limits are rad and rad/s."""


def egm_of(
    index: int,
    configuration: schema.ConfigurationKeys,
    joints: tuple[model.Joint, ...],
    path: KeyPath,
    report: DraftFindings,
) -> model.EgmSettings | None:
    """Return the settings of the group number `index`, None without `egm:`.

    Reports RG006, RG071 and RG072 to RG074.
    """
    group = configuration.groups[str(path[1])]
    keys, at = group.egm, (*path, "egm")
    if keys is None:
        return None
    _check_driver(configuration, group, at, report)
    _check_axes(group, joints, at, report)
    _check_limits(keys, joints, at, report)
    if not is_host(keys.address):
        report.error(
            "RG006",
            f"'{keys.address}' is not the IPv4 address of a machine",
            (*at, "address"),
            help="the address of the guiding computer in the network of the robot",
        )
    return model.EgmSettings(
        device=keys.device or DEFAULT_DEVICE + (f"_{index + 1}" if index else ""),
        address=keys.address,
        port=keys.port or DEFAULT_PORT + index,
        max_deviation=math.radians(keys.max_deviation),
        max_speed=math.radians(keys.max_speed),
        filter=keys.filter,
        gain=keys.gain,
        ramp=keys.ramp,
        stop_ramp=keys.stop_ramp,
        timeout=keys.timeout,
        idle_timeout=keys.idle_timeout,
        feedback=keys.feedback,
    )


def _check_driver(
    configuration: schema.ConfigurationKeys,
    group: schema.GroupKeys,
    at: KeyPath,
    report: DraftFindings,
) -> None:
    """Report a release or a profile that has no EGM (RG072)."""
    robotware = configuration.controller.robotware
    if robotware < _FIRST:
        release = f"{robotware[0]}.{robotware[1]:02d}"
        report.error(
            "RG072",
            f"EGM is not supported on RobotWare {release}",
            at,
            "RobotWare 5 has no EGM for this driver"
            if robotware[0] < 6
            else "messages before 6.07 mix rad and deg",
            "leave `egm:` out, or update the controller to RobotWare 6.08 or later",
            key=True,
        )
    if configuration.profile == "basic" or group.ports.control == 0:
        report.error(
            "RG072",
            "EGM needs the control port",
            at,
            "STOP and the heartbeat of the client use it",
            "leave out `profile: basic` and `ports: {control: 0}`, or this",
            key=True,
        )


def _check_axes(
    group: schema.GroupKeys,
    joints: tuple[model.Joint, ...],
    at: KeyPath,
    report: DraftFindings,
) -> None:
    """Report an arm that is not known to be guided by joints (RG073)."""
    axes = {joint.axis for joint in joints}
    turning = all(joint.kind == "revolute" for joint in joints)
    missing = [axis for axis in _ROBOT_AXES if axis not in axes]
    if group.external_units or not turning or missing or axes - {*_ROBOT_AXES, "eax_a"}:
        report.error(
            "RG073",
            "EGM is only supported for arms with six or seven turning axes",
            at,
            "external axes" if group.external_units else "other axes",
            "guide the arm with a configuration of its own, or leave `egm:` out",
            key=True,
        )


def _check_limits(
    keys: schema.EgmKeys, joints: tuple[model.Joint, ...], at: KeyPath, report: DraftFindings
) -> None:
    """Report rad instead of deg (RG071), and a limit that limits nothing (RG074)."""
    for name, value, unit in (
        ("max_deviation", keys.max_deviation, "deg"),
        ("max_speed", keys.max_speed, "deg/s"),
    ):
        if value < _SMALL or is_radians(value):
            report.add(
                "RG071",
                Severity.WARNING,
                f"{name} of {value:g} {unit}",
                (*at, name),
                "rad?",
                f"the unit is {unit}: {value:g} in rad are {math.degrees(value):.4g}",
            )
    slowest = min((j for j in joints if j.kind == "revolute"), key=lambda j: j.speed, default=None)
    if slowest is not None and keys.max_speed > math.degrees(slowest.speed):
        report.error(
            "RG074",
            f"max_speed of {keys.max_speed:g} deg/s is more than joint '{slowest.name}' has",
            (*at, "max_speed"),
            f"{math.degrees(slowest.speed):.4g} deg/s",
            "the controller scales all axes alike, so take less than the slowest axis has",
        )


def check_partners(groups: list[model.GroupConfig], report: DraftFindings) -> None:
    """Report a device, or an address and port, of two groups (RG012)."""
    devices: dict[str, str] = {}
    partners: dict[tuple[str, int], str] = {}
    for group in groups:
        if group.egm is None:
            continue
        at: KeyPath = ("groups", group.name, "egm")
        first = devices.setdefault(group.egm.device.casefold(), group.name)
        if first != group.name:
            report.error(
                "RG012",
                f"groups '{first}' and '{group.name}' share the device {group.egm.device}",
                (*at, "device"),
                help="give each group a `device:` of its own, or leave both out",
            )
        partner = (group.egm.address, group.egm.port)
        first = partners.setdefault(partner, group.name)
        if first != group.name:
            report.error(
                "RG012",
                f"groups '{first}' and '{group.name}' share UDP port {group.egm.port}",
                (*at, "port"),
                help="give each group a `port:` of its own, or leave both out",
            )
