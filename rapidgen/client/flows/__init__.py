"""Flows of the client: generators of `effects` that a runner executes."""

from rapidgen.client.flows import (
    connect,
    control,
    data,
    guidance,
    motion,
    program,
    state,
    stop,
    stream,
)

__all__ = ["connect", "control", "data", "guidance", "motion", "program", "state", "stop", "stream"]
