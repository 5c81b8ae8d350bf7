"""ROS interface of the operator's services; as `node` it imports rclpy."""

from collections.abc import Callable, Coroutine
from typing import TYPE_CHECKING, Any, Protocol

from rcl_interfaces.msg import Log
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.qos import QoSProfile
from std_srvs.srv import Trigger

from rapidgen.ros.operator_services import OperatorAccess, OperatorServices, triggers
from rapidgen.ros.user_services import Message, Serve, operator_services

if TYPE_CHECKING:
    from rapidgen.client.rws.model import LogEvent

_LEVELS = {"info": 20, "warning": 30, "error": 40}
"""rcl_interfaces/msg/Log: INFO, WARN, ERROR."""
Serving = Callable[[Message, Message], Message]


class ServingNode(Protocol):
    """What this needs of the node, beside rclpy's own methods."""

    is_busy: bool
    """True if a goal has no result yet."""

    def trigger(self, act: Callable[[], Coroutine[object, None, object]]) -> Serving:
        """Return the callback of a Trigger."""

    def fill(self, serve: Serve) -> Serving:
        """Return the callback of a service whose response `serve` fills."""

    def __getattr__(self, name: str) -> Any: ...  # noqa: ANN401


class OperatorInterface:
    """Services of the operator, and the controller's event log, over Robot Web Services."""

    def __init__(self, node: ServingNode, access: OperatorAccess) -> None:
        self._node = node
        self._operator = OperatorServices(access, lambda: node.is_busy)
        callbacks = ReentrantCallbackGroup()
        self._events = node.create_publisher(Log, "event_log", QoSProfile(depth=50))
        self._services = [
            node.create_service(Trigger, name, node.trigger(act), callback_group=callbacks)
            for name, act in triggers(self._operator)
        ]
        self._services += [
            node.create_service(kind, name, node.fill(serve), callback_group=callbacks)
            for kind, name, serve in operator_services(self._operator)
        ]

    async def run(self) -> None:
        """Publish the event log until cancelled, then log out."""
        try:
            await self._operator.follow_log(self._publish, self._node.get_logger().warning)
        finally:
            await self._operator.close()

    def destroy(self) -> None:
        """Destroy all entities."""
        for service in self._services:
            self._node.destroy_service(service)
        self._node.destroy_publisher(self._events)

    def _publish(self, event: "LogEvent") -> None:
        message = Log()
        message.stamp = self._node.get_clock().now().to_msg()
        message.level = _LEVELS[event.type]
        message.name = "controller"
        message.msg = f"{event.code} {event.title}: {event.description}".rstrip(": ")
        self._events.publish(message)
