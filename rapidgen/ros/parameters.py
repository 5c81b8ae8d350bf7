"""The node's parameters: names, defaults, descriptions, common checks."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any, Literal, cast

from rapidgen.client.address import parse_address
from rapidgen.config.model import RobotConfig
from rapidgen.diagnostics import Diagnostic, DiagnosticError, error
from rapidgen.ros.goal_execution import Policy
from rapidgen.ros.goals import Defaults
from rapidgen.ros.operator_services import GUARDED, OperatorAccess

WHOLE = 100.0
"""% of the programmed speed at the start of each motion."""

DECLARED: tuple[tuple[str, str | bool | float | list[str], str], ...] = (
    ("config", "", "robot YAML, or the name of a shipped model"),
    # A list without an element has no type for rclpy.
    ("overrides", [""], "KEY=VALUE, each over a key of config: what `rapidgen build --set` had"),
    ("address", "", "HOST, or HOST:MOTION,STATE,CONTROL; empty: a simulator on this machine"),
    ("cell", "", "cell file: goals are checked for collisions before they are sent"),
    ("control", "node", "node: FollowJointTrajectory; ros2_control: set points of its hardware"),
    ("autostart", True, "configure and activate without being asked"),
    ("tf_prefix", "", "put in front of joint names"),
    ("publish_clock", False, "/clock from the controller's time, for a simulator"),
    ("speed", WHOLE, "speed override of the motion under way, 1 to 100 %"),
    ("replace", "refuse", "a goal while another one moves: refuse, or approach (stop, go there)"),
    ("dense", "refuse", "points nearer than the planner follows: refuse, or resample"),
    ("path_tolerance", 0.0, "default of a goal's path tolerances, rad or m; 0: none"),
    ("goal_tolerance", 0.01, "default of a goal's end, rad or m; 0: none"),
    ("goal_time_tolerance", 0.0, "default of goal_time_tolerance, s; 0: none"),
    ("stamp_tolerance", 0.2, "s by which header.stamp may be past"),
    ("preempt", False, "a command of a streaming topic ends the goal that is executed"),
    ("allow_delayed", False, "without EGM: commands half a second late, at most 50 mm/s"),
    ("stream_speed", 0.25, "share of the speeds and accelerations for streaming topics, to 1"),
    ("stream_idle", 10.0, "s without motion after which a session of streaming ends"),
    ("controller", "", "HOST[:PORT] of Robot Web Services; empty: no services of the operator"),
    ("controller_user", "Default User", "user there; the password is in RAPIDGEN_PASSWORD"),
    ("controller_fingerprint", "", "of the controller's certificate; empty: the known ones"),
    # A list without an element has no type for rclpy.
    ("operate", [""], f"services that may be called: {', '.join(sorted(GUARDED))}"),
)
_WORDS = {
    "control": ("node", "ros2_control"),
    "replace": ("refuse", "approach"),
    "dense": ("refuse", "resample"),
}
PASSWORD = "RAPIDGEN_PASSWORD"
"""Environment variable: parameters of a node can be read by every other node."""
NAMES = frozenset(name for name, _, _ in DECLARED)
"""Those of this node; rclpy has others."""


@dataclass(frozen=True, slots=True)
class Parameters:
    """Parameters that the user set."""

    config: str
    overrides: tuple[str, ...]
    address: str
    cell: str
    """Empty: no collision check."""
    tf_prefix: str
    publish_clock: bool
    has_action: bool
    """False: trajectories and joint_states are those of ros2_control's controllers."""
    policy: Policy
    preempt: bool
    allow_delayed: bool
    stream_speed: float
    stream_idle: float
    operator: OperatorAccess | None
    """None: no services of the operator."""


def read(values: Mapping[str, Any], environment: Mapping[str, str]) -> Parameters:
    """Parameters by name. Raises DiagnosticError with every fault."""
    result = []
    if not values["config"]:
        result.append(_fault("config is not set", "-p config:=robot.yaml"))
    for name, words in _WORDS.items():
        if values[name] not in words:
            report = f"{name} is '{values[name]}'"
            result.append(_fault(report, f"it is {' or '.join(words)}"))
    for name in ("path_tolerance", "goal_tolerance", "goal_time_tolerance", "stamp_tolerance"):
        if not 0 <= values[name] < math.inf:
            result.append(_fault(f"{name} is {values[name]:g}", "it is 0 or more"))
    if not 0 < values["stream_speed"] <= 1:
        report = f"stream_speed is {values['stream_speed']:g}"
        result.append(_fault(report, "it is above 0 and at most 1"))
    if not 1 <= values["stream_idle"] < math.inf:
        result.append(_fault(f"stream_idle is {values['stream_idle']:g}", "it is 1 s or more"))
    allowed = frozenset(filter(None, values["operate"]))
    if unknown := sorted(allowed - GUARDED):
        report = f"operate names '{unknown[0]}'"
        result.append(_fault(report, f"it may name {', '.join(sorted(GUARDED))}"))
    if values["controller"] and find_spec("httpx2") is None:
        result.append(_fault("controller needs httpx2", "pip install 'rapidgen[web]'"))
    if allowed and not values["controller"]:
        result.append(_fault("operate is set without controller", "-p controller:=HOST"))
    if values["speed"] != WHOLE:
        result.append(
            _fault(
                f"speed is {values['speed']:g}, so the robot would not move",
                "100, and another one while a goal is executed; plans are slower by MoveIt's "
                "max_velocity_scaling_factor",
            )
        )
    if result:
        raise DiagnosticError(result)
    return Parameters(
        values["config"],
        tuple(filter(None, values["overrides"])),
        values["address"],
        values["cell"],
        values["tf_prefix"],
        values["publish_clock"],
        values["control"] == "node",
        Policy(
            Defaults(
                path=values["path_tolerance"] or math.inf,
                goal=values["goal_tolerance"] or math.inf,
                goal_time=values["goal_time_tolerance"] or math.inf,
                late=values["stamp_tolerance"],
            ),
            cast("Literal['refuse', 'approach']", values["replace"]),
            cast("Literal['refuse', 'resample']", values["dense"]),
        ),
        values["preempt"],
        values["allow_delayed"],
        values["stream_speed"],
        values["stream_idle"],
        OperatorAccess(
            values["controller"],
            values["controller_user"],
            environment.get(PASSWORD, ""),
            values["controller_fingerprint"],
            allowed,
        )
        if values["controller"]
        else None,
    )


def check_address(address: str, config: RobotConfig) -> None:
    """Raise DiagnosticError for an invalid address.

    Also for one group's ports if there are several groups.
    """
    result = {parse_address(address, group.ports) for group in config.groups if address}
    if address and len(result) < len(config.groups):
        raise DiagnosticError(
            _fault(
                f"address is '{address}', with the ports of one motion group, and {config.name} "
                f"has {len(config.groups)} of them",
                "HOST alone: the ports are those of the configuration",
            )
        )


def check_control(parameters: Parameters, config: RobotConfig) -> None:
    """Raise DiagnosticError if set points are to come from ros2_control and a group has no EGM."""
    without = [group.name for group in config.groups if group.egm is None]
    if not parameters.has_action and without:
        raise DiagnosticError(
            _fault(
                f"control is 'ros2_control', and {', '.join(without)} has no `egm:`",
                "build the driver with `egm:`, or use control:=node",
            )
        )


def _fault(message: str, help: str) -> Diagnostic:
    return error("RG690", None, f"parameter {message}", help)
