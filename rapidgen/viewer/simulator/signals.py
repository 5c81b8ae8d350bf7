"""The signals of a virtual controller."""

import math
from collections.abc import Iterable, Mapping

from rapidgen.controller.runner import ControllerRunner
from rapidgen.machine.io import Signal
from rapidgen.viewer.messages import (
    AllSignals,
    Request,
    SetSignal,
    ShownSignal,
    SignalValues,
    ToPage,
)
from rapidgen.viewer.provider import Handler, RequestRejected


class SignalsProvider:
    """All signals, then those that have changed."""

    def __init__(self, runner: ControllerRunner) -> None:
        self._io = runner.controller.io
        self._last_sent: dict[Signal, float] = {}

    def whole(self) -> Iterable[ToPage]:
        """Return all signals."""
        yield AllSignals(signals=tuple(map(_shown, self._io.signals.values())))

    def changes(self) -> Iterable[ToPage]:
        """Return changed values."""
        text = self._last_sent
        new = [s for s in self._io.signals.values() if text.get(s) != s.value]
        if new:
            text.update((signal, signal.value) for signal in new)
            yield SignalValues(values={signal.name: signal.value for signal in new})

    def handlers(self) -> Mapping[type, Handler]:
        """Handlers that set a signal: inputs usually, outputs possible."""
        return {SetSignal: self._set}

    def _set(self, request: Request) -> str:
        assert isinstance(request, SetSignal)
        signal = self._io.get(request.name)
        if signal is None:
            raise RequestRejected(f"there is no signal {request.name}")
        try:
            self._io.set(signal, request.value)
        except ValueError as error:
            raise RequestRejected(str(error)) from error
        return ""


def _shown(signal: Signal) -> ShownSignal:
    largest = signal.largest
    return ShownSignal(
        name=signal.name,
        kind=signal.spec.type,
        device=signal.spec.device,
        value=signal.value,
        largest=None if math.isinf(largest) else largest,
    )
