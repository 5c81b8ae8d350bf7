"""Externally guided motion in tests: client and controller in lock-step on the virtual clock.

    with VirtualController.from_files(...) as controller:
        session = guide(controller, "UCdevice", "irb120")
        session.wait_until_guided()
        session.send(q)
        session.next_state()

Each `next_state` is one cycle of 4 ms of the controller. Nothing waits in real time, so a test of a
control loop takes a fraction of its duration and has the same result each time.
"""

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from rapidgen.axes.mapping import JointMap
from rapidgen.client.egm import EgmSession, EgmState, Envelope
from rapidgen.client.egm.exchange import CYCLE, Guidance, Order, PartnerExchange
from rapidgen.client.egm.session import choose_group
from rapidgen.client.errors import RobotTimeout
from rapidgen.config.model import RobotConfig

if TYPE_CHECKING:
    from rapidgen.controller.controller import VirtualController


def guide(
    controller: "VirtualController",
    device: str,
    config: str | RobotConfig,
    *,
    guidance: Guidance = "joints",
    group: str = "",
    envelope: Envelope | None = None,
    timeout: float = 0.1,
) -> "LockStepSession":
    """Return a session whose calls advance the controller.

    Args:
        controller: On the virtual clock.
        device: UdpUc device of the program.
        config: Configuration, its file, or a shipped name.
        guidance, group, envelope, timeout: As of `rapidgen.client.egm.listen`.
    """
    chosen = choose_group(config, group)
    limits = envelope or Envelope.of(chosen)
    exchange = PartnerExchange(JointMap.of(chosen), limits, timeout, guidance)
    return LockStepSession(controller, device, limits, exchange)


class _LockStepLoop:
    """Answers the frames of a controller at once."""

    port = 0

    def __init__(
        self,
        controller: "VirtualController",
        device: str,
        exchange: PartnerExchange,
        receive: Callable[[EgmState], None],
        receive_end: Callable[[], None],
    ) -> None:
        self._exchange, self._receive, self._receive_end = exchange, receive, receive_end
        self._now, self._open = controller_clock(controller), True
        controller.egm.connect(device, self._answer)

    def _answer(self, frame: bytes) -> bytes | None:
        if not self._open:
            return None
        answer = self._exchange.answer(frame, self._now())
        self._receive(self._exchange.state())
        return answer

    def post(self, order: Order) -> None:
        """Execute an order."""
        self._exchange.execute(order)

    def wait_started(self) -> None:
        """Answer from the beginning."""

    def close(self) -> None:
        """Answer no longer."""
        self._open = False
        self._receive_end()


class LockStepSession(EgmSession):
    """`EgmSession` on the virtual clock: waiting advances the controller by cycles."""

    def __init__(
        self,
        controller: "VirtualController",
        device: str,
        envelope: Envelope,
        exchange: PartnerExchange,
    ) -> None:
        self._controller = controller
        super().__init__(
            envelope,
            exchange.guidance,
            partial(_LockStepLoop, controller, device, exchange),
            controller_clock(controller),
        )

    def _wait(self, ready: Callable[[EgmState], bool], timeout: float, missing: str) -> EgmState:
        for _ in range(round(timeout / CYCLE) + 1):
            if (state := self._ready(ready)) is not None:
                return state
            self._controller.run_for(CYCLE)
        raise RobotTimeout.because(
            "RG681", f"{missing} within {timeout:g} s", "let the program execute EGMRun"
        )


def controller_clock(controller: "VirtualController") -> Callable[[], float]:
    """Return the clock of a controller, s."""
    return lambda: controller.scheduler.now * 1e-9
