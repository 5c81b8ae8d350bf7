"""The node on the real rclpy, and a second node that asks it over DDS.

`Driver` has the surface of `standin.LifecycleNode`, so that the same tests run with both.
"""

import gc
import importlib
import os
import threading
import time
from functools import cached_property

import rclpy
from action_msgs.msg import GoalStatus
from rcl_interfaces.msg import Log
from rclpy.action import ActionClient
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.signals import SignalHandlerOptions

TIMEOUT = 60.0
"""s that anything may take on a busy machine."""
_STATES = {
    GoalStatus.STATUS_ACCEPTED: "executing",
    GoalStatus.STATUS_EXECUTING: "executing",
    GoalStatus.STATUS_CANCELING: "canceling",
    GoalStatus.STATUS_SUCCEEDED: "succeeded",
    GoalStatus.STATUS_CANCELED: "canceled",
    GoalStatus.STATUS_ABORTED: "aborted",
}
_OWN = ("rosout", "parameter_events", "transition_event")
"""Topics that every node has."""


def start():
    """Initialise rclpy for a domain of this process, on this machine only."""
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    os.environ["ROS_DOMAIN_ID"] = str(1 + os.getpid() % 100)
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)


def _resolved(future):
    done = threading.Event()
    future.add_done_callback(lambda _: done.set())
    assert done.wait(TIMEOUT)
    return future.result()


def _type(name):
    package, kind, type_name = name.split("/")
    return getattr(importlib.import_module(f"{package}.{kind}"), type_name)


def _known(discovered, name):
    """The type of a topic or service, when discovery has found it."""
    absolute = name if name.startswith("/") else f"/{name}"
    until = time.monotonic() + TIMEOUT
    while absolute not in (found := dict(discovered())):
        assert time.monotonic() < until, f"{absolute} was not found"
        time.sleep(0.02)
    return _type(found[absolute][0])


class Handle:
    """A goal, from its client."""

    def __init__(self, client, goal):
        self.feedback, self.fed, self.over = [], threading.Event(), threading.Event()
        self.result = None
        self.handle = _resolved(client.send_goal_async(goal, feedback_callback=self._fed))
        assert self.handle.accepted
        self.handle.get_result_async().add_done_callback(self._ended)

    def _fed(self, message):
        self.feedback.append(message.feedback)
        self.fed.set()

    def _ended(self, future):
        response = future.result()
        self.result, self._status = response.result, response.status
        self.over.set()

    @property
    def status(self):
        return _STATES[self._status if self.over.is_set() else self.handle.status]


class Action:
    def __init__(self, client):
        self._client = client
        assert client.wait_for_server(TIMEOUT)

    def send(self, goal):
        return Handle(self._client, goal)

    def cancel(self, handle):
        assert _resolved(handle.handle.cancel_goal_async()).goals_canceling


class Topic:
    """What came on a topic."""

    def __init__(self, node, kind, name, qos):
        self.sent, self.came = [], threading.Condition()
        self.subscription = node.create_subscription(kind, name, self._received, qos)

    def _received(self, message):
        with self.came:
            self.sent.append(message)
            self.came.notify_all()

    def wait(self, condition):
        with self.came:
            assert self.came.wait_for(lambda: self.sent and condition(self.sent[-1]), TIMEOUT)
            return self.sent[-1]


class Logged:
    """Log lines of the node, from /rosout."""

    def __init__(self, topic, name):
        self._topic, self._name = topic, name

    @property
    def logged(self):
        return self._topic.came

    @property
    def lines(self):
        return [one.msg for one in list(self._topic.sent) if one.name == self._name]


class Client:
    """A node that asks another one, in this process or not."""

    def __init__(self):
        self.client = rclpy.create_node("asking")
        self._ending, self._threads = threading.Event(), []
        self._spin(SingleThreadedExecutor(), self.client)
        self.topics, self.actions = _Made(self._topic), _Made(self._action)
        self.services = _Made(self._service)

    def _spin(self, executor, node):
        """Serve a node in a thread, until `close` has nothing more to wait for."""
        executor.add_node(node)

        def spin():
            while not self._ending.is_set():
                executor.spin_once(timeout_sec=0.1)
            executor.remove_node(node)
            executor.shutdown()

        self._threads.append(threading.Thread(target=spin, daemon=True))
        self._threads[-1].start()

    def close(self):
        self._ending.set()
        for thread in self._threads:
            thread.join(TIMEOUT)
            assert not thread.is_alive()
        self.client.destroy_node()

    def _topic(self, name):
        kinds = _known(self.client.get_topic_names_and_types, name)
        return Topic(self.client, kinds, name, QoSProfile(depth=10))

    def _service(self, name):
        client = self.client.create_client(
            _known(self.client.get_service_names_and_types, name), name
        )
        assert client.wait_for_service(TIMEOUT)

        def call(**fields):
            return _resolved(client.call_async(client.srv_type.Request(**fields)))

        return call

    def _action(self, name):
        from control_msgs.action import FollowJointTrajectory

        return Action(ActionClient(self.client, FollowJointTrajectory, name))


class Driver(Client):
    """A `RobotNode` in this process, and its client."""

    def __init__(self, *, parameter_overrides, **options):
        from rapidgen.ros.node import RobotNode

        super().__init__()
        qos = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self._publishers = _Made(self._publisher)
        self._rosout = Topic(self.client, Log, "/rosout", qos)
        overrides = [Parameter(name, value=value) for name, value in parameter_overrides.items()]
        self.node = RobotNode(parameter_overrides=overrides, **options)
        self._workers = MultiThreadedExecutor(num_threads=8)
        self._spin(self._workers, self.node)

    @cached_property
    def _parameters(self):
        client = AsyncParameterClient(self.client, self.node.get_name())
        assert client.wait_for_services(TIMEOUT)
        return client

    @property
    def published(self):
        """Topics of the node that are its own."""
        names = {publisher.topic_name for publisher in self.node.publishers}
        return {name for name in names if not name.endswith(_OWN) and "/_action/" not in name}

    @property
    def published_actions(self):
        """Action servers of the node, from what it publishes for them."""
        names = {publisher.topic_name for publisher in self.node.publishers}
        return {name for name in names if name.endswith("/_action/status")}

    def qos(self, name):
        """Reliability, durability and depth of the node's publisher."""
        name = name if name.startswith("/") else f"/{name}"
        publisher = next(one for one in self.node.publishers if one.topic_name == name)
        profile = publisher.qos_profile
        return profile.reliability.name, profile.durability.name, profile.depth

    def is_qos_overridable(self, name):
        name = name if name.startswith("/") else f"/{name}"
        return self.node.has_parameter(f"qos_overrides.{name}.publisher.reliability")

    @property
    def state(self):
        return self.node._state_machine.current_state[1]

    def set(self, name, value):
        """As a service of ROS does it."""
        response = _resolved(self._parameters.set_parameters([Parameter(name, value=value)]))
        return response.results[0]

    def get_parameter(self, name):
        return self.node.get_parameter(name)

    def get_logger(self):
        return Logged(self._rosout, self.node.get_logger().name)

    @property
    def fault(self):
        return self.node.fault

    def send(self, topic, message):
        """Publish a message when the node has been discovered."""
        publisher = self._publishers[topic, type(message)]
        until = time.monotonic() + TIMEOUT
        while not publisher.get_subscription_count():
            assert time.monotonic() < until, f"nothing subscribes to {topic}"
            time.sleep(0.02)
        publisher.publish(message)

    def _publisher(self, place):
        topic, kind = place
        return self.client.create_publisher(
            kind, topic.replace("~", self.node.get_fully_qualified_name()), QoSProfile(depth=10)
        )

    def break_joint_states(self, fault):
        """Let every message of `joint_states` raise."""
        (door,) = self.node._doors
        door._joint_states = _Broken(fault)

    def trigger_deactivate(self):
        return self.node.trigger_deactivate()

    def trigger_cleanup(self):
        return self.node.trigger_cleanup()

    def destroy_node(self):
        if self.state == "active":
            self.node.trigger_deactivate()
        while self.node.is_busy:
            time.sleep(0.01)
        self.close()
        # Else a callback that still runs would use what is destroyed.
        self._workers._executor.shutdown(wait=True)
        self.node.destroy_node()
        # rcl ends a node when its last reference goes, and with it the log of a new node of this
        # name: not later, while that one runs.
        del self.node
        gc.collect()


class _Broken:
    """A publisher of a middleware that has failed."""

    def __init__(self, fault):
        self._fault = fault

    def publish(self, message):
        raise self._fault


class _Made(dict):
    """What is made when it is first asked for."""

    def __init__(self, make):
        self._make = make

    def __missing__(self, name):
        self[name] = self._make(name)
        return self[name]
