"""The stand-in's messages have the fields, types and defaults of the real ones."""

import importlib

import pytest
import standin
from messages import IS_REAL

pytestmark = pytest.mark.skipif(not IS_REAL, reason="needs the real message packages")

PLACES = {
    "builtin_interfaces.msg": "Duration Time",
    "control_msgs.msg": "JointTolerance",
    "diagnostic_msgs.msg": "DiagnosticArray DiagnosticStatus KeyValue",
    "geometry_msgs.msg": "Point Pose Quaternion Twist TwistStamped Vector3",
    "industrial_msgs.msg": "RobotMode RobotStatus TriState",
    "rapidgen_interfaces.msg": "Value",
    "rcl_interfaces.msg": "Log SetParametersResult",
    "rosgraph_msgs.msg": "Clock",
    "sensor_msgs.msg": "JointState",
    "std_msgs.msg": "Float64MultiArray Header MultiArrayDimension MultiArrayLayout",
    "trajectory_msgs.msg": "JointTrajectory JointTrajectoryPoint",
}
PARTS = {
    "FollowJointTrajectory": ("control_msgs.action", ("Goal", "Result", "Feedback")),
    "Trigger": ("std_srvs.srv", ("Request", "Response")),
    "CallRoutine": ("rapidgen_interfaces.srv", ("Request", "Response")),
    "ReadSignal": ("rapidgen_interfaces.srv", ("Request", "Response")),
    "ReadSymbol": ("rapidgen_interfaces.srv", ("Request", "Response")),
    "SetSpeedRatio": ("rapidgen_interfaces.srv", ("Request", "Response")),
    "WriteSignal": ("rapidgen_interfaces.srv", ("Request", "Response")),
    "WriteSymbol": ("rapidgen_interfaces.srv", ("Request", "Response")),
    "Acknowledge": ("rapidgen_interfaces.srv", ("Request", "Response")),
    "ReadDialog": ("rapidgen_interfaces.srv", ("Request", "Response")),
    "ReadTool": ("rapidgen_interfaces.srv", ("Request", "Response")),
    "WriteTool": ("rapidgen_interfaces.srv", ("Request", "Response")),
}
NUMBERS = {"double": float, "float": float, "boolean": bool, "octet": bytes, "string": str}


def _pairs():
    for module, names in PLACES.items():
        for name in names.split():
            yield name, module, None
    for name, (module, parts) in PARTS.items():
        for part in parts:
            yield name, module, part


def _fits(kind, text):
    """True if a field of the stand-in has the type of a real one, such as `sequence<double>`."""
    if isinstance(kind, list):
        element = text.removeprefix("sequence<").removesuffix(">")
        return text.startswith("sequence<") and (kind == [object] or _fits(kind[0], element))
    if "/" in text:
        return kind.__name__ == text.rpartition("/")[2]
    return kind is NUMBERS.get(text, int)


@pytest.mark.parametrize(("name", "module", "part"), list(_pairs()))
def test_fields_are_those_of_the_real_message(name, module, part):
    here, real = getattr(standin, name), getattr(importlib.import_module(module), name)
    if part is not None:
        here, real = getattr(here, part), getattr(real, part)
    fields = real.get_fields_and_field_types()
    assert set(here.FIELDS) <= set(fields)
    assert {name for name, kind in here.FIELDS.items() if not _fits(kind, fields[name])} == set()
    made, genuine = here(), real()
    for field, kind in here.FIELDS.items():
        if kind in (float, int, str, bool):
            assert getattr(made, field) == getattr(genuine, field), field
