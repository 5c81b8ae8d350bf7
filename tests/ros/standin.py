"""A stand-in for what a sourced ROS 2 brings, as far as the node uses it, and as strict.

Signatures and QoS defaults are those of rclpy in Humble, Jazzy and Rolling, recorded in
recorded.json: keyword-only arguments are, unknown ones raise, messages take values of their types
only (rosidl's generated `assert`s), a goal takes only the transitions of rcl_action.
"""

import sys
import threading
from enum import Enum
from types import MappingProxyType, ModuleType, SimpleNamespace


class Message:
    """As rosidl generates it: named fields, each with a type; nothing else can be set."""

    FIELDS = MappingProxyType({})

    def __init__(self, **given):
        unknown = set(given) - set(self.FIELDS)
        assert not unknown, f"Invalid arguments passed to constructor: {sorted(unknown)}"
        for name, kind in self.FIELDS.items():
            object.__setattr__(self, name, [] if isinstance(kind, list) else kind())
        for name, value in given.items():
            setattr(self, name, value)

    @classmethod
    def get_fields_and_field_types(cls):
        return dict(cls.FIELDS)

    def __setattr__(self, name, value):
        kind = self.FIELDS.get(name)
        if kind is None:
            raise AttributeError(f"'{type(self).__name__}' object has no attribute '{name}'")
        report = f"The '{name}' field must be of type {kind}"
        if isinstance(kind, list):
            assert not isinstance(value, str), report
            assert all(isinstance(item, kind[0]) for item in value), report
        else:
            assert isinstance(value, kind), report
            if kind is int:
                assert -(2**31) <= value < 2**32, report
        object.__setattr__(self, name, value)


def message(_, /, **fields):
    return type(_, (Message,), {"FIELDS": fields})


class Quaternion(message("Quaternion", x=float, y=float, z=float, w=float)):
    """Without fields it is no rotation, as geometry_msgs/Quaternion.msg says."""

    def __init__(self, **given):
        super().__init__(**{"w": 1.0, **given})


Time = message("Time", sec=int, nanosec=int)
Duration = message("Duration", sec=int, nanosec=int)
Header = message("Header", stamp=Time, frame_id=str)
JointState = message(
    "JointState", header=Header, name=[str], position=[float], velocity=[float], effort=[float]
)
JointTrajectoryPoint = message(
    "JointTrajectoryPoint",
    positions=[float],
    velocities=[float],
    accelerations=[float],
    effort=[float],
    time_from_start=Duration,
)
JointTrajectory = message(
    "JointTrajectory", header=Header, joint_names=[str], points=[JointTrajectoryPoint]
)
MultiDOF = message("MultiDOFJointTrajectory", header=Header, joint_names=[str], points=[object])
JointTolerance = message(
    "JointTolerance", name=str, position=float, velocity=float, acceleration=float
)
Vector3 = message("Vector3", x=float, y=float, z=float)
Twist = message("Twist", linear=Vector3, angular=Vector3)
TwistStamped = message("TwistStamped", header=Header, twist=Twist)
MultiArrayDimension = message("MultiArrayDimension", label=str, size=int, stride=int)
MultiArrayLayout = message("MultiArrayLayout", dim=[MultiArrayDimension], data_offset=int)
Float64MultiArray = message("Float64MultiArray", layout=MultiArrayLayout, data=[float])
KeyValue = message("KeyValue", key=str, value=str)
DiagnosticStatus = message(
    "DiagnosticStatus", level=bytes, name=str, message=str, hardware_id=str, values=[KeyValue]
)
DiagnosticArray = message("DiagnosticArray", header=Header, status=[DiagnosticStatus])
Clock = message("Clock", clock=Time)
ParameterDescriptor = message("ParameterDescriptor", name=str, description=str)
SetParametersResult = message("SetParametersResult", successful=bool, reason=str)
Log = message("Log", stamp=Time, level=int, name=str, msg=str, file=str, function=str, line=int)
TriState = message("TriState", val=int)
RobotMode = message("RobotMode", val=int)
RobotStatus = message(
    "RobotStatus",
    header=Header,
    mode=RobotMode,
    e_stopped=TriState,
    drives_powered=TriState,
    motion_possible=TriState,
    in_motion=TriState,
    in_error=TriState,
    error_codes=[int],
)


class FollowJointTrajectory:
    Goal = message(
        "FollowJointTrajectory_Goal",
        trajectory=JointTrajectory,
        multi_dof_trajectory=MultiDOF,
        path_tolerance=[JointTolerance],
        component_path_tolerance=[object],
        goal_tolerance=[JointTolerance],
        component_goal_tolerance=[object],
        goal_time_tolerance=Duration,
    )
    Result = message("FollowJointTrajectory_Result", error_code=int, error_string=str)
    Feedback = message(
        "FollowJointTrajectory_Feedback",
        header=Header,
        joint_names=[str],
        desired=JointTrajectoryPoint,
        actual=JointTrajectoryPoint,
        error=JointTrajectoryPoint,
    )


class Trigger:
    Request = message("Trigger_Request")
    Response = message("Trigger_Response", success=bool, message=str)


Point = message("Point", x=float, y=float, z=float)
Pose = message("Pose", position=Point, orientation=Quaternion)
Value = message("Value", type=int, number=float, boolean=bool, text=str, pose=Pose, joints=[float])
Value.NUM, Value.BOOL, Value.STRING, Value.ROBTARGET, Value.JOINTTARGET = range(5)


class ReadSignal:
    Request = message("ReadSignal_Request", name=str)
    Response = message("ReadSignal_Response", success=bool, message=str, value=float)


class WriteSignal:
    Request = message("WriteSignal_Request", name=str, value=float)
    Response = message("WriteSignal_Response", success=bool, message=str, value=float)


class CallRoutine:
    Request = message("CallRoutine_Request", name=str, arguments=[Value])
    Response = message("CallRoutine_Response", success=bool, message=str, results=[Value])


class ReadSymbol:
    Request = message("ReadSymbol_Request", path=str)
    Response = message("ReadSymbol_Response", success=bool, message=str, value=str)


class WriteSymbol:
    Request = message("WriteSymbol_Request", path=str, value=str)
    Response = message("WriteSymbol_Response", success=bool, message=str, value=str)


class ReadDialog:
    Request = message("ReadDialog_Request")
    Response = message(
        "ReadDialog_Response",
        success=bool,
        message=str,
        dialog=str,
        instruction=str,
        parameters=[str],
    )


class Acknowledge:
    Request = message("Acknowledge_Request", dialog=str, answer=str)
    Response = message("Acknowledge_Response", success=bool, message=str)


_TOOL = {"tool": str, "tool_data": str, "load": str, "load_data": str}


class ReadTool:
    Request = message("ReadTool_Request", unit=str)
    Response = message("ReadTool_Response", success=bool, message=str, **_TOOL)


class WriteTool:
    Request = message("WriteTool_Request", unit=str, tool_data=str, load_data=str)
    Response = message("WriteTool_Response", success=bool, message=str, **_TOOL)


class SetSpeedRatio:
    Request = message("SetSpeedRatio_Request", percent=float)
    Response = message("SetSpeedRatio_Response", success=bool, message=str, percent=float)


class ReentrantCallbackGroup:
    pass


class MutuallyExclusiveCallbackGroup:
    pass


class QoSProfile:
    history, reliability, durability = "KEEP_LAST", "RELIABLE", "VOLATILE"

    def __init__(self, *, depth):
        self.depth = depth


class QoSOverridingOptions:
    @classmethod
    def with_default_policies(cls, *, callback=None, entity_id=None):
        return cls()


class GoalResponse(Enum):
    REJECT = 1
    ACCEPT = 2


class CancelResponse(Enum):
    REJECT = 1
    ACCEPT = 2


class Parameter:
    def __init__(self, name, type_=None, value=None):
        self.name, self.value = name, value


class RCLError(RuntimeError):
    pass


class Handle:
    """rcl_action's state machine: executing, canceling, then one of three ends."""

    _ALLOWED = frozenset(
        {
            ("executing", "succeeded"),
            ("executing", "aborted"),
            ("executing", "canceling"),
            ("canceling", "succeeded"),
            ("canceling", "aborted"),
            ("canceling", "canceled"),
        }
    )

    def __init__(self, number, request):
        self.goal_id = SimpleNamespace(uuid=number.to_bytes(16, "big"))
        self.request = request
        self.status = "executing"
        self.feedback = []
        self.fed = threading.Event()
        self.result = None
        self.over = threading.Event()

    def to(self, status):
        if (self.status, status) not in self._ALLOWED:
            raise RCLError(f"goal_handle attempted invalid transition {self.status} -> {status}")
        self.status = status

    @property
    def is_active(self):
        return self.status in ("executing", "canceling")

    @property
    def is_cancel_requested(self):
        return self.status == "canceling"

    def succeed(self):
        self.to("succeeded")

    def abort(self):
        self.to("aborted")

    def canceled(self):
        self.to("canceled")

    def publish_feedback(self, feedback):
        if not isinstance(feedback, FollowJointTrajectory.Feedback):
            raise TypeError
        self.feedback.append(feedback)
        self.fed.set()


class ActionServer:
    def __init__(
        self,
        node,
        action_type,
        action_name,
        execute_callback,
        *,
        callback_group=None,
        goal_callback=None,
        handle_accepted_callback=None,
        cancel_callback=None,
        result_timeout=900,
    ):
        self.name, self._execute, self._cancel, self._goal = (
            action_name,
            execute_callback,
            cancel_callback,
            goal_callback,
        )
        self._count = 0
        node.actions[action_name] = self

    def destroy(self):
        self.name = None

    # As an action client

    def send(self, goal):
        assert self._goal(goal) is GoalResponse.ACCEPT
        self._count += 1
        handle = Handle(self._count, goal)

        def execute():
            handle.result = self._execute(handle)
            assert not handle.is_active, "Goal state not set"
            handle.over.set()

        threading.Thread(target=execute, daemon=True).start()
        return handle

    def cancel(self, handle):
        assert self._cancel(handle) is CancelResponse.ACCEPT
        if handle.is_active:
            handle.to("canceling")


class Publisher:
    def __init__(self, kind, qos, overriding):
        self.kind, self.qos, self.overriding, self.sent = kind, qos, overriding, []
        self.came = threading.Condition()

    def publish(self, sent):
        if not isinstance(sent, self.kind):
            raise TypeError
        with self.came:
            self.sent.append(sent)
            self.came.notify_all()

    def wait(self, condition):
        with self.came:
            assert self.came.wait_for(lambda: self.sent and condition(self.sent[-1]), 60)
            return self.sent[-1]


class TransitionCallbackReturn(Enum):
    SUCCESS = 1
    FAILURE = 2
    ERROR = 3


class _Moment:
    def __init__(self, nanoseconds):
        self.nanoseconds = nanoseconds

    def to_msg(self):
        return Time(sec=self.nanoseconds // 10**9, nanosec=self.nanoseconds % 10**9)


class SignalHandlerOptions(Enum):
    NO = 0
    ALL = 3


class _Logger:
    """As rcutils_logger: one place of the program always logs with the same severity."""

    def __init__(self):
        self.lines, self._severities = [], {}
        self.logged = threading.Condition()

    def _log(self, text, severity):
        caller = sys._getframe(2)
        place = caller.f_code, caller.f_lasti
        if self._severities.setdefault(place, severity) != severity:
            raise ValueError("Logger severity cannot be changed between calls.")
        with self.logged:
            self.lines.append(text)
            self.logged.notify_all()

    def info(self, text):
        self._log(text, "info")

    def warning(self, text):
        self._log(text, "warning")

    def error(self, text):
        self._log(text, "error")


class LifecycleNode:
    """As rclpy's: what a transition raises is swallowed there, so it is an error here."""

    clock = None

    def __init__(
        self, node_name, *, context=None, cli_args=None, namespace=None, parameter_overrides=None
    ):
        self._name = node_name
        self._parameters = {}
        self._given = dict(parameter_overrides or {})
        self._logger = _Logger()
        self.state = "unconfigured"
        self.topics, self.services, self.actions, self.subscriptions = {}, {}, {}, {}

    def get_name(self):
        return self._name

    def get_logger(self):
        return self._logger

    def get_clock(self):
        return SimpleNamespace(now=lambda: _Moment(self.clock()))

    def declare_parameter(self, name, value=None, descriptor=None, ignore_override=False):
        assert name not in self._parameters
        assert isinstance(descriptor, ParameterDescriptor)
        self._parameters[name] = self._given.get(name, value)
        assert type(self._parameters[name]) is type(value), name

    def get_parameter(self, name):
        return SimpleNamespace(name=name, value=self._parameters[name])

    def add_on_set_parameters_callback(self, callback):
        self._on_set = callback

    def set_parameters(self, parameter_list):
        results = []
        for parameter in parameter_list:
            assert isinstance(parameter, Parameter)
            results.append(self._on_set([parameter]))
            if results[-1].successful:
                self._parameters[parameter.name] = parameter.value
        return results

    def set(self, name, value):
        """As a service of ROS does it."""
        return self.set_parameters([Parameter(name, value=value)])[0]

    def create_publisher(
        self,
        msg_type,
        topic,
        qos_profile,
        *,
        callback_group=None,
        event_callbacks=None,
        qos_overriding_options=None,
    ):
        assert isinstance(qos_profile, QoSProfile)
        return self.topics.setdefault(
            topic.replace("~", f"/{self._name}", 1),
            Publisher(msg_type, qos_profile, qos_overriding_options),
        )

    @property
    def published(self):
        return {name if name.startswith("/") else f"/{name}" for name in self.topics}

    @property
    def published_actions(self):
        return set(self.actions)

    def qos(self, name):
        profile = self.topics[name].qos
        return profile.reliability, profile.durability, profile.depth

    def is_qos_overridable(self, name):
        return self.topics[name].overriding is not None

    def break_joint_states(self, fault):
        def publish(sent):
            raise fault

        self.topics["joint_states"].publish = publish

    def create_subscription(
        self, msg_type, topic, callback, qos_profile, *, callback_group=None, raw=False
    ):
        assert isinstance(qos_profile, QoSProfile)
        self.subscriptions[topic] = msg_type, callback
        return topic

    def destroy_subscription(self, subscription):
        del self.subscriptions[subscription]

    def send(self, topic, message):
        """As a publisher of another node."""
        kind, callback = self.subscriptions[topic]
        assert isinstance(message, kind)
        callback(message)

    def get_fully_qualified_name(self):
        return f"/{self._name}"

    def destroy_publisher(self, publisher):
        self.topics = {t: p for t, p in self.topics.items() if p is not publisher}

    def create_service(
        self, srv_type, srv_name, callback, *, qos_profile=None, callback_group=None
    ):
        self.services[srv_name] = lambda **report: callback(
            srv_type.Request(**report), srv_type.Response()
        )
        return srv_name

    def destroy_service(self, service):
        del self.services[service]

    def _go(self, before, callback, after):
        assert self.state == before, (self.state, before)
        result = callback(SimpleNamespace(label=before))
        if result is TransitionCallbackReturn.SUCCESS:
            self.state = after
        return result

    def trigger_configure(self):
        return self._go("unconfigured", self.on_configure, "inactive")

    def trigger_activate(self):
        return self._go("inactive", self.on_activate, "active")

    def trigger_deactivate(self):
        return self._go("active", self.on_deactivate, "inactive")

    def trigger_cleanup(self):
        return self._go("inactive", self.on_cleanup, "unconfigured")

    def on_configure(self, state):
        return TransitionCallbackReturn.SUCCESS

    on_activate = on_deactivate = on_cleanup = on_configure

    def destroy_node(self):
        self.state = "finalized"


def modules():
    """The modules by name."""
    here = {name: value for name, value in globals().items() if isinstance(value, type)}
    result = {}
    for module, names in {
        "rclpy": "",
        "rclpy.action": "ActionServer CancelResponse GoalResponse",
        "rclpy.callback_groups": "MutuallyExclusiveCallbackGroup ReentrantCallbackGroup",
        "rclpy.lifecycle": "LifecycleNode TransitionCallbackReturn",
        "rclpy.parameter": "Parameter",
        "rclpy.qos": "QoSProfile",
        "rclpy.qos_overriding_options": "QoSOverridingOptions",
        "rclpy.signals": "SignalHandlerOptions",
        "builtin_interfaces.msg": "Duration Time",
        "control_msgs.action": "FollowJointTrajectory",
        "diagnostic_msgs.msg": "DiagnosticArray DiagnosticStatus KeyValue",
        "geometry_msgs.msg": "TwistStamped",
        "industrial_msgs.msg": "RobotStatus",
        "rapidgen_interfaces.msg": "Value",
        "rapidgen_interfaces.srv": (
            "Acknowledge CallRoutine ReadDialog ReadSignal ReadSymbol ReadTool SetSpeedRatio "
            "WriteSignal WriteSymbol WriteTool"
        ),
        "rcl_interfaces.msg": "Log ParameterDescriptor SetParametersResult",
        "rosgraph_msgs.msg": "Clock",
        "sensor_msgs.msg": "JointState",
        "std_msgs.msg": "Float64MultiArray",
        "std_srvs.srv": "Trigger",
        "trajectory_msgs.msg": "JointTrajectory JointTrajectoryPoint",
    }.items():
        made = ModuleType(module)
        for name in names.split():
            setattr(made, name, here[name])
        result[module] = made
        package = module.split(".")[0]
        result.setdefault(package, ModuleType(package))
    result["rclpy.qos"].qos_profile_sensor_data = QoSProfile(depth=5)
    result["rclpy.lifecycle"].LifecycleState = SimpleNamespace
    executors = result["rclpy.executors"] = ModuleType("rclpy.executors")
    executors.MultiThreadedExecutor = executors.ExternalShutdownException = type(
        "E", (Exception,), {}
    )
    return result


def install(monkeypatch):
    """As if ROS 2 were sourced."""
    for name, made in modules().items():
        monkeypatch.setitem(sys.modules, name, made)
