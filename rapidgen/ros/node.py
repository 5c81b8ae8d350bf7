"""The ROS 2 node: with the modules `*_interface` all that imports rclpy.

It maps messages to calls of `RobotLink` and back. The links run on one asyncio loop in a thread;
rclpy's callbacks wait for their results. QoS: all topics are reliable, volatile, depth 10, as
joint_state_broadcaster has it.
"""

import asyncio
import os
import signal
import threading
import time
import uuid
from collections.abc import Callable, Coroutine
from concurrent.futures import Future
from typing import TypeVar

import rclpy
from builtin_interfaces.msg import Duration, Time
from control_msgs.action import FollowJointTrajectory
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.signals import SignalHandlerOptions
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger
from trajectory_msgs.msg import JointTrajectoryPoint

from rapidgen._extras import named
from rapidgen._interruption import INTERRUPTIONS, raise_on_signals
from rapidgen.client.aio import AsyncRobot
from rapidgen.client.errors import RobotError
from rapidgen.config import load_config
from rapidgen.config.model import RobotConfig
from rapidgen.diagnostics import DiagnosticError
from rapidgen.ros.goal_execution import ActiveGoal, GoalFeedback, reason
from rapidgen.ros.goals import FinalStatus, Goal, Outcome, Point, Tolerance
from rapidgen.ros.operator_interface import OperatorInterface
from rapidgen.ros.parameters import (
    DECLARED,
    NAMES,
    WHOLE,
    Parameters,
    check_address,
    check_control,
    read,
)
from rapidgen.ros.robot_link import RobotLink, set_speeds
from rapidgen.ros.status_messages import (
    DiagnosticsFilter,
    JointStates,
    Level,
    RobotHealth,
    RobotStatus,
)
from rapidgen.ros.stream_commands import CommandReader, StreamReport, StreamSettings
from rapidgen.ros.stream_interface import StreamInterface, seconds
from rapidgen.ros.user_services import (
    ARE_THERE,
    MISSING,
    Message,
    services,
)

try:  # A package that not every distribution has.
    from industrial_msgs.msg import RobotStatus as RobotStatusMessage
except ImportError:
    RobotStatusMessage = None
else:
    # ROS 1's message has one `error_code`; packages of that form exist for ROS 2 too.
    if "error_codes" not in RobotStatusMessage.get_fields_and_field_types():
        RobotStatusMessage = None

T = TypeVar("T")
_QOS = QoSProfile(depth=10)
CLOCK_PERIOD = 0.02
"""s of the controller's time between two messages of /clock: timers of other nodes wait for it."""
_KEPT = 10
"""s for which a goal's result is available."""
_LOOK = 0.2
"""s between two checks for an ending signal."""
_FAREWELL = 2.0
"""s within which results of goals stopped at the end are sent."""


class RobotNode(LifecycleNode):  # type: ignore[misc]
    """One robot; each group has its topics, services and action."""

    def __init__(self, **options: Message) -> None:
        super().__init__("rapidgen", **options)
        for name, value, report in DECLARED:
            self.declare_parameter(name, value, _described(report))
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, name="rapidgen", daemon=True)
        self._thread.start()
        self._doors: list[GroupInterface] = []
        self._operator: OperatorInterface | None = None
        self._running: list[Future[None]] = []
        self._running_log: list[Future[None]] = []
        self.fault = ""
        """Why a link ended that was not asked to: this process can do nothing useful any more."""
        self.add_on_set_parameters_callback(self._parameters_set)
        if self.get_parameter("autostart").value:
            self._start()

    # Life cycle

    def _start(self) -> None:
        if self.trigger_configure() is TransitionCallbackReturn.SUCCESS:
            self.trigger_activate()

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Read the configuration; create topics, services and actions."""
        try:
            values = {name: self.get_parameter(name).value for name, _, _ in DECLARED}
            parameters = read(values, os.environ)
            config = load_config(parameters.config, overrides=parameters.overrides)
            check_address(parameters.address, config)
            check_control(parameters, config)
            makers = [self._maker(config, parameters, group.name) for group in config.groups]
        except (DiagnosticError, ModuleNotFoundError) as error:
            helps = [one.help for one in getattr(error, "diagnostics", ()) if one.help]
            self.get_logger().error("; ".join([str(error), *helps]))
            return TransitionCallbackReturn.FAILURE
        if not ARE_THERE:
            self.get_logger().info(MISSING)
        if parameters.publish_clock and config.state_period > CLOCK_PERIOD:
            rate, least = 1 / config.state_period, 1 / CLOCK_PERIOD
            self.get_logger().warning(
                f"/clock has the {rate:g} Hz of the states: --set state.rate={least:g} for driver "
                "and node"
            )
        several = len(config.groups) > 1
        for group, make in zip(config.groups, makers, strict=True):
            space = f"{group.name}/" if several else ""
            # One clock for all groups: two of them would go back and forth.
            clock = parameters.publish_clock and not self._doors
            name = f"{group.name}_controller"
            links = f"{group.name}_" if several else ""
            stream = StreamSettings(
                group,
                CommandReader.of(group, parameters.tf_prefix, links),
                preempt=parameters.preempt,
                speed=parameters.stream_speed,
                idle=parameters.stream_idle,
                allow_delayed=parameters.allow_delayed,
                is_hardware=not parameters.has_action,
            )
            self._doors.append(
                GroupInterface(self, make, parameters, space, name, stream, tells_clock=clock)
            )
        if parameters.operator is not None:
            self._operator = OperatorInterface(self, parameters.operator)
        return super().on_configure(state)

    def _maker(
        self, config: RobotConfig, parameters: Parameters, group: str
    ) -> Callable[[], AsyncRobot]:
        """Return what makes the group's client. Raises DiagnosticError for a faulty cell."""
        check = None
        if parameters.cell:
            with named():
                from rapidgen.client.collisions import cell_check

                # Meshes are read once, not again for each connection.
                check = cell_check(parameters.cell, config, group)
            for finding in check.diagnostics:
                self.get_logger().warning(f"{finding.code}: {finding.message}")

        def make() -> AsyncRobot:
            address = parameters.address or None
            return AsyncRobot(config, address=address, group=group, feedback=True, cell=check)

        return make

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Connect to the robot, and keep the connection."""
        self._running = [self.ask(door.link.run()) for door in self._doors]
        for running in self._running:
            running.add_done_callback(self._link_ended)
        if self._operator is not None:
            self._running_log = [self.ask(self._operator.run())]
        return super().on_activate(state)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Stop motions of goals, and disconnect."""
        self._let_go()
        return super().on_deactivate(state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Destroy topics, services and actions."""
        for door in self._doors:
            door.destroy()
        self._doors = []
        if self._operator is not None:
            self._operator.destroy()
            self._operator = None
        return super().on_cleanup(state)

    def destroy_node(self) -> None:
        """Stop motions of goals, end the loop."""
        self._let_go()
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()
        super().destroy_node()

    def _link_ended(self, running: "Future[None]") -> None:
        """Report why a link ended, unless it was cancelled; `run` then ends the process."""
        if running.cancelled() or (fault := running.exception()) is None:
            return
        text = f"the link ended by a fault of this node: {fault!r}"
        self.get_logger().error(text)
        for door, link in zip(self._doors, self._running, strict=True):
            if link is running:
                door.report(RobotHealth(Level.ERROR, text))
        self.fault = text

    def _let_go(self) -> None:
        running = [*self._running, *self._running_log]
        for one in running:
            one.cancel()
        self.ask(_ended(len(running))).result()
        self._running, self._running_log = [], []

    def end(self, executor: MultiThreadedExecutor) -> None:
        """Stop motions of goals, and send the results to their clients."""
        self._let_go()
        until = time.monotonic() + _FAREWELL
        while self.is_busy and time.monotonic() < until:
            executor.spin_once(timeout_sec=0.05)
        for _ in range(5):  # Results are sent after the callback that created them.
            executor.spin_once(timeout_sec=0.05)

    def _parameters_set(self, parameters: list[Message]) -> SetParametersResult:
        """Set `speed` at once; others are read when the node is configured."""
        for parameter in parameters:
            if not self._doors or parameter.name not in NAMES:
                continue
            if parameter.name != "speed":
                why = f"{parameter.name} is read when the node is configured: clean it up before"
                return SetParametersResult(successful=False, reason=why)
            if parameter.value == WHOLE and not self.is_busy:
                continue  # The speed at the start of each motion.
            links = [door.link for door in self._doors]
            done, report = self.asked(set_speeds(links, float(parameter.value)))
            if not done:
                return SetParametersResult(successful=False, reason=report)
        return SetParametersResult(successful=True)

    @property
    def is_busy(self) -> bool:
        """True if a goal has no result yet."""
        return any(door.is_busy for door in self._doors)

    def goal_ended(self) -> None:
        """Reset the speed of an ended motion."""
        if not self.is_busy and self.get_parameter("speed").value != WHOLE:
            self.set_parameters([Parameter("speed", value=WHOLE)])

    def ask(self, coroutine: Coroutine[object, None, T]) -> "Future[T]":
        """Run on the links' loop and return the result."""
        return asyncio.run_coroutine_threadsafe(coroutine, self._loop)

    def asked(self, coroutine: Coroutine[object, None, object]) -> tuple[bool, str]:
        """Return whether the robot did it, and why not."""
        try:
            self.ask(coroutine).result()
        except RobotError as error:
            return False, reason(error)
        except ValueError as error:
            return False, str(error)
        return True, "done"

    def trigger(
        self, act: Callable[[], Coroutine[object, None, object]]
    ) -> Callable[[Message, Message], Message]:
        """Return the callback of a Trigger."""
        return self.fill(lambda *_: act())

    def fill(
        self, serve: Callable[[Message, Message], Coroutine[object, None, object]]
    ) -> Callable[[Message, Message], Message]:
        """Return the callback of a service whose response `serve` fills."""

        def filled(request: Message, response: Message) -> Message:
            response.success, response.message = self.asked(serve(request, response))
            return response

        return filled

    def soon(self, act: Callable[[], None]) -> None:
        """Run on the links' loop without waiting."""
        self._loop.call_soon_threadsafe(act)

    def now(self) -> float:
        """s of ROS time, simulated if use_sim_time is set."""
        return float(self.get_clock().now().nanoseconds) * 1e-9


class GroupInterface:
    """ROS interface of one motion group; the `LinkListener` of its link."""

    def __init__(
        self,
        node: RobotNode,
        make: Callable[[], AsyncRobot],
        parameters: Parameters,
        space: str,
        controller: str,
        stream: StreamSettings,
        *,
        tells_clock: bool,
    ) -> None:
        self.link = RobotLink(
            make,
            parameters.policy,
            node.now,
            self,
            is_clock=parameters.publish_clock,
            stream=stream,
        )
        self._node = node
        self._prefix = parameters.tf_prefix
        self._name = controller
        self._lock = threading.Lock()
        self._goals: dict[bytes, ActiveGoal] = {}
        self._stops: dict[int, int] = {}
        """By the identity of a goal's request: stops before its acceptance."""
        self._callbacks = ReentrantCallbackGroup()
        # With ros2_control its broadcaster publishes `joint_states`, from what its hardware reads.
        self._joint_states = self._publisher(
            JointState, "joint_states" if parameters.has_action else f"~/{space}joint_states"
        )
        self._diagnostics = self._publisher(DiagnosticArray, "/diagnostics")
        self._filter = DiagnosticsFilter(
            f"{node.get_fully_qualified_name()} {controller} {uuid.uuid4().hex}"
        )
        self._heard = node.create_subscription(
            DiagnosticArray, "/diagnostics", self._received, _QOS, callback_group=self._callbacks
        )
        self._status = (
            self._publisher(RobotStatusMessage, f"{space}robot_status")
            if RobotStatusMessage is not None
            else None
        )
        self._clock = self._publisher(Clock, "/clock") if tells_clock else None
        self._services = [
            node.create_service(
                Trigger, f"{space}{name}", node.trigger(act), callback_group=self._callbacks
            )
            for name, act in (
                ("stop", self.link.stop),
                ("pause", self.link.pause),
                ("resume", self.link.resume),
            )
        ]
        self._services += [
            node.create_service(
                kind, f"{space}{name}", node.fill(serve), callback_group=self._callbacks
            )
            for kind, name, serve in services(self.link)
        ]
        self._action = self._make_action() if parameters.has_action else None
        self._stream = StreamInterface(node, self.link, space, parameters.tf_prefix)

    def _make_action(self) -> ActionServer:
        return ActionServer(
            self._node,
            FollowJointTrajectory,
            f"{self._name}/follow_joint_trajectory",
            execute_callback=self._execute,
            callback_group=self._callbacks,
            # A rejection has no reason: goals are accepted, and aborted with one.
            goal_callback=self._accept,
            cancel_callback=self._cancel,
            # rcl's default since Iron; rclpy would keep each goal for a quarter of an hour.
            result_timeout=_KEPT,
        )

    @property
    def is_busy(self) -> bool:
        """True if a goal has no result yet."""
        with self._lock:
            return bool(self._goals)

    def destroy(self) -> None:
        """Destroy all entities of the group."""
        if self._action is not None:
            self._action.destroy()
        self._stream.destroy()
        for service in self._services:
            self._node.destroy_service(service)
        self._node.destroy_subscription(self._heard)
        for publisher in (self._joint_states, self._diagnostics, self._status, self._clock):
            if publisher is not None:
                self._node.destroy_publisher(publisher)

    def _publisher(self, kind: type, topic: str) -> Message:
        return self._node.create_publisher(
            kind, topic, _QOS, qos_overriding_options=QoSOverridingOptions.with_default_policies()
        )

    # Calls of the link

    def joint_states(self, states: JointStates) -> None:
        """See `LinkListener`."""
        message = JointState()
        message.header.stamp = _time(states.stamp)
        message.name = [self._prefix + name for name in states.names]
        message.position = list(states.positions)
        message.velocity = list(states.velocities)
        if self._clock is not None:
            self._clock.publish(Clock(clock=message.header.stamp))
        self._joint_states.publish(message)

    def status(self, status: RobotStatus, health: RobotHealth) -> None:
        """See `LinkListener`."""
        stamp = self.report(health)
        if self._status is None:
            return
        message = RobotStatusMessage()
        message.header.stamp = stamp
        message.mode.val = status.mode
        for name in ("e_stopped", "drives_powered", "motion_possible", "in_motion", "in_error"):
            getattr(message, name).val = getattr(status, name)
        message.error_codes = [status.error_code] if status.error_code else []
        self._status.publish(message)

    def report(self, health: RobotHealth) -> Time:
        """Publish diagnostics if they are new, or a second old; return the stamp."""
        stamp = _time(round(self.link.now() * 1e9))
        new = self._filter.to_publish(health, time.monotonic())
        if new is None:
            return stamp
        diagnostics = DiagnosticArray()
        diagnostics.header.stamp = stamp
        diagnostics.status = [
            DiagnosticStatus(
                level=bytes([new.level]),
                name=f"{self._node.get_name()}: {self._name}",
                message=new.message,
                hardware_id=new.values.get("address", ""),
                values=[KeyValue(key=key, value=value) for key, value in new.values.items()],
            )
        ]
        self._diagnostics.publish(diagnostics)
        return stamp

    def streaming(self, report: StreamReport) -> None:
        """See `LinkListener`."""
        diagnostics = DiagnosticArray()
        diagnostics.header.stamp = _time(round(self.link.now() * 1e9))
        level = Level.WARN if report.code else Level.OK
        diagnostics.status = [
            DiagnosticStatus(
                level=bytes([level]),
                name=f"{self._node.get_name()}: {self._name} streaming",
                message=report.text,
                values=[
                    KeyValue(key="code", value=report.code),
                    KeyValue(key="topic", value=report.topic),
                ],
            )
        ]
        self._diagnostics.publish(diagnostics)
        if report.code:
            self._node.get_logger().warning(f"{self._name}: {report.text} [{report.code}]")

    def _received(self, diagnostics: Message) -> None:
        """Notice another node on this robot."""
        for status in diagnostics.status:
            values = {one.key: one.value for one in status.values}
            other = self._filter.received(status.hardware_id, values, time.monotonic())
            if other:
                self._node.get_logger().warning(
                    f"{self._name}: another node is connected to this robot: {other.split()[0]}; "
                    "end one of them, because each stops the other's motions"
                )

    def note(self, text: str) -> None:
        """See `LinkListener`."""
        self._node.get_logger().info(f"{self._name}: {text}")

    # Requests of ROS

    def _accept(self, request: Message) -> GoalResponse:
        """Accept a goal; a stop from now on ends it, although it may be executed later."""
        with self._lock:
            self._stops[id(request)] = self.link.stops
        return GoalResponse.ACCEPT

    def _cancel(self, handle: Message) -> CancelResponse:
        self._node.soon(self._under_way(handle).cancel)
        return CancelResponse.ACCEPT

    def _under_way(self, handle: Message) -> ActiveGoal:
        """Return the active goal of this handle.

        A cancellation may precede its execution.
        """
        with self._lock:
            stops = self._stops.pop(id(handle.request), None)
            return self._goals.setdefault(bytes(handle.goal_id.uuid), ActiveGoal(stops))

    def _execute(self, handle: Message) -> Message:
        """Execute a goal until the robot is at rest, in an executor's thread."""

        def tell(feedback: GoalFeedback) -> None:
            if handle.is_active:
                handle.publish_feedback(self._feedback(feedback))

        under = self._under_way(handle)
        goal = self._goal(handle.request)
        try:
            outcome = self._node.ask(self.link.follow(goal, tell, under)).result()
            outcome_text = f"{self._name}: goal {outcome.status.value}: {outcome.text}"
            # Two calls: rclpy refuses another severity at the source line of an earlier one.
            if outcome.status is FinalStatus.SUCCEEDED:
                self._node.get_logger().info(outcome_text)
            else:
                self._node.get_logger().warning(outcome_text)
            return _ending(handle, outcome)
        finally:
            # After its end: an earlier cancellation would enter it again.
            with self._lock:
                del self._goals[bytes(handle.goal_id.uuid)]
            self._node.goal_ended()

    def _goal(self, request: Message) -> Goal:
        trajectory = request.trajectory
        return Goal(
            names=[name.removeprefix(self._prefix) for name in trajectory.joint_names],
            points=[
                Point(
                    seconds(point.time_from_start),
                    point.positions,
                    point.velocities,
                    point.accelerations,
                    point.effort,
                )
                for point in trajectory.points
            ],
            stamp=seconds(trajectory.header.stamp),
            path_tolerance=[self._tolerance(report) for report in request.path_tolerance],
            goal_tolerance=[self._tolerance(report) for report in request.goal_tolerance],
            goal_time_tolerance=seconds(request.goal_time_tolerance),
            has_multi_dof=bool(request.multi_dof_trajectory.points),
        )

    def _tolerance(self, report: Message) -> Tolerance:
        name = report.name.removeprefix(self._prefix)
        return Tolerance(name, report.position, report.velocity, report.acceleration)

    def _feedback(self, feedback: GoalFeedback) -> Message:
        message = FollowJointTrajectory.Feedback()
        message.header.stamp = _time(round(self.link.now() * 1e9))
        message.joint_names = [self._prefix + name for name in feedback.names]
        at = _duration(feedback.time)
        for name, positions, velocities in (
            ("desired", feedback.desired, feedback.desired_velocity),
            ("actual", feedback.actual, feedback.actual_velocity),
            ("error", feedback.error, feedback.desired_velocity - feedback.actual_velocity),
        ):
            point = JointTrajectoryPoint(
                positions=positions.tolist(), velocities=velocities.tolist(), time_from_start=at
            )
            setattr(message, name, point)
        return message


def _ending(handle: Message, outcome: Outcome) -> Message:
    """Return the result and set the goal's last state.

    A cancelled goal that was done is done.
    """
    if outcome.status is FinalStatus.SUCCEEDED:
        handle.succeed()
    elif outcome.status is FinalStatus.CANCELED and handle.is_cancel_requested:
        handle.canceled()
    else:
        handle.abort()
    result = FollowJointTrajectory.Result()
    result.error_code = int(outcome.code)
    result.error_string = outcome.text
    return result


def _described(text: str) -> ParameterDescriptor:
    return ParameterDescriptor(description=text)


async def _ended(count: int) -> None:
    """Wait for all other tasks of this loop, `count` links among them."""
    others = asyncio.all_tasks() - {asyncio.current_task()}
    if count and others:
        await asyncio.gather(*others, return_exceptions=True)


def _time(stamp: int) -> Time:
    """Convert ns to a Time."""
    seconds, nanoseconds = divmod(stamp, 10**9)
    return Time(sec=seconds, nanosec=nanoseconds)


def _duration(seconds: float) -> Duration:
    complete, remaining = divmod(round(seconds * 1e9), 10**9)
    return Duration(sec=complete, nanosec=remaining)


def run(arguments: list[str]) -> int:
    """Run the node until SIGINT, SIGTERM or SIGHUP.

    `arguments` are as in ROS 2 (`--ros-args -p config:=...`). The exit code is 1 after a fault, so
    that `ros2 launch` can respawn the node.
    """
    # rclpy's own handlers would prevent messages after a signal.
    rclpy.init(args=arguments, signal_handler_options=SignalHandlerOptions.NO)
    raise_on_signals()
    try:
        node = RobotNode()
    except KeyboardInterrupt:
        rclpy.try_shutdown()
        return 0
    # A goal occupies a thread during its execution, a service during its call.
    executor = MultiThreadedExecutor(num_threads=8)
    executor.add_node(node)
    try:
        while not node.fault:
            executor.spin_once(timeout_sec=_LOOK)
        node.end(executor)
    except (KeyboardInterrupt, ExternalShutdownException):
        # `ros2 launch` sends a second one; the robot is stopped in any case.
        for number in INTERRUPTIONS:
            signal.signal(number, signal.SIG_IGN)
        node.get_logger().info("ending: what moves for a goal is stopped")
        node.end(executor)
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
    return 1 if node.fault else 0
