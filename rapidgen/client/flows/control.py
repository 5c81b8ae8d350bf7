"""Requests over the control port."""

import logging

from rapidgen.client.core.motion import reason_of, reason_text
from rapidgen.client.core.robot import Core
from rapidgen.client.errors import NotSupported, RequestRefused
from rapidgen.client.flows.connect import alive, reach_control
from rapidgen.client.flows.effects import Flow, Wait
from rapidgen.diagnostics import suggest
from rapidgen.wire.simple_message import messages
from rapidgen.wire.simple_message.declaration import Content
from rapidgen.wire.simple_message.spec import Feature, Port


def pause(core: Core) -> Flow[None]:
    """Pause the motion on its path."""
    yield from ask(core, messages.PauseRequest(1), "pause")


def resume(core: Core) -> Flow[None]:
    """Resume after a pause. Raises as `pause`."""
    yield from ask(core, messages.PauseRequest(0), "go on")


def set_speed(core: Core, percent: float) -> Flow[None]:
    """Move at 1 to 100 % of the programmed speed, until the next motion."""
    if not 1 <= percent <= 100:
        raise ValueError(f"percent must be 1 to 100, not {percent}")
    yield from ask(core, messages.SpeedRequest(percent), f"go at {percent:g} %")
    core.override = percent / 100


def read_signal(core: Core, signal: str | int) -> Flow[float]:
    """Read an exposed signal, by name or number. Raises as `pause`."""
    return (yield from _signal(core, signal, None))


def write_signal(core: Core, signal: str | int, value: float) -> Flow[float]:
    """Set a signal; return its value as read afterwards. Raises as `pause`."""
    if value is None or isinstance(value, str):
        raise RequestRefused.because(
            "RG625",
            f"signal {signal} takes a number, not {value!r}",
            "0 or 1, or the number of a group or of an analog signal",
        )
    return (yield from _signal(core, signal, value))


def _signal(core: Core, which: str | int, value: float | None) -> Flow[float]:
    index = _index(core, which, writes=value is not None)
    requested = messages.SignalRequest(index, int(value is not None), value or 0.0)
    what = "read" if value is None else "write"
    reply = yield from ask(core, requested, f"{what} signal {which}")
    if not isinstance(reply, messages.SignalReply) or reply.signal != index:
        raise RequestRefused.because(
            "RG625", f"signal {which} was answered with {reply}", **core.evidence()
        )
    return reply.value


def _index(core: Core, which: str | int, *, writes: bool) -> int:
    """Return the number of a signal.

    Raises NotSupported for an unknown signal or one that is read only.
    """
    signals = core.known_group.signals
    names = [signal.name for signal in signals]
    if isinstance(which, str):
        if which not in names:
            raise NotSupported.because(
                "RG624",
                f"the configuration exposes no signal '{which}'",
                suggest(which, names) or f"it exposes: {', '.join(names) or 'none'}",
            )
        which = names.index(which)
    if writes and which < len(signals) and signals[which].access == "read":
        raise NotSupported.because(
            "RG624",
            f"signal '{names[which]}' is exposed for reading only",
            "`access: write` in the configuration; build and deploy again",
        )
    return which


def ask(core: Core, content: Content, what: str) -> Flow[Content]:
    """Send a request over the control port and return its reply."""
    yield from alive(core)
    yield from reach_control(core)
    control = core.ports[Port.CONTROL]
    if not control.is_open:
        has_port = Feature.CONTROL in core.state_port.driver.features
        why = core.state_port.driver.control_fault or "the answer was lost"
        raise NotSupported.because(
            "RG624",
            f"cannot {what}: "
            + (f"no control connection ({why})" if has_port else "the driver has no control port"),
            "connect again" if has_port else "`ports.control` in the configuration",
        )
    pending = core.post(content)
    yield Wait(lambda: pending.reply is not None or not control.is_open, core.timeouts.reply)
    reply = pending.reply
    if reply is None:
        if not control.is_open:
            raise core.disconnected()
        raise core.state_port.late(f"no reply to the request to {what}", "look at the controller")
    if isinstance(reply, messages.NotDone | messages.Failure):
        number = reply.reason if isinstance(reply, messages.NotDone) else 0
        why = reason_text(number) if number else "no reason given"
        core.state_port.note(f"the controller did not {what}: {why}", logging.INFO)
        raise RequestRefused.because(
            "RG625",
            f"the controller did not {what}: {why}",
            reason=reason_of(number) if number else None,
            **core.evidence(),
        )
    return reply
