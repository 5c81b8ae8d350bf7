"""Flows that wait for data of the state port."""

from collections.abc import Callable

from rapidgen.client.core.robot import Core
from rapidgen.client.core.state import Event, Feedback, State
from rapidgen.client.errors import NotSupported
from rapidgen.client.flows.connect import alive
from rapidgen.client.flows.effects import Flow, Wait
from rapidgen.wire.simple_message.spec import Feature


def wait_until(core: Core, condition: Callable[[State], bool], timeout: float) -> Flow[State]:
    """Return the first state for which `condition` holds."""
    return (yield from _until(core, condition, timeout, "the awaited state"))


def _until(
    core: Core, condition: Callable[[State], bool], timeout: float, what: str
) -> Flow[State]:
    yield from alive(core)
    state_port = core.state_port
    result: list[State] = []

    def holds() -> bool:
        state = state_port.state
        if state is not None and state_port.is_complete and condition(state):
            result.append(state)
        return bool(result) or not core.state_open

    yield Wait(holds, timeout)
    if result:
        return result[0]
    if not core.state_open:
        raise core.disconnected()
    raise core.state_port.late(f"{what} did not come within {timeout:g} s")


def next_state(core: Core, timeout: float | None = None) -> Flow[State]:
    """Return the state of the next joint message."""
    yield from alive(core)
    seen = core.state_port.samples
    longest = core.timeouts.state if timeout is None else timeout
    return (yield from _until(core, lambda state: state.number > seen, longest, "the next state"))


def next_event(
    core: Core, timeout: float | None = None, *, after: Event | None = None
) -> Flow[Event]:
    """Return the next entry of the controller's log, or the one after `after`."""
    yield from alive(core)
    state_port = core.state_port
    seen = state_port.event_count if after is None else after.number
    longest = float("inf") if timeout is None else timeout
    yield Wait(lambda: state_port.event_count > seen or not core.state_open, longest)
    result = [event for event in state_port.events if event.number > seen]
    if result:
        return result[0]
    if not core.state_open:
        raise core.disconnected()
    raise core.state_port.late(f"no event arrived within {timeout:g} s")


def next_feedback(core: Core, timeout: float | None = None) -> Flow[Feedback]:
    """Return the next joints with the controller's time."""
    yield from alive(core)
    state_port = core.state_port
    if Feature.FEEDBACK not in state_port.driver.features & core.subscribe:
        raise NotSupported.because(
            "RG624",
            "the driver sends no feedback with the controller's time",
            "Robot(..., feedback=True) requests it from a driver that has it",
        )
    seen = state_port.feedbacks
    limit = core.timeouts.state if timeout is None else timeout
    yield Wait(lambda: state_port.feedbacks > seen or not core.state_open, limit)
    feedback = state_port.feedback
    if feedback is not None and state_port.feedbacks > seen:
        return feedback
    if not core.state_open:
        raise core.disconnected()
    raise core.state_port.late(f"no feedback arrived within {limit:g} s")
