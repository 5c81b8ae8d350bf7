"""Flows of the client: generators of `effects` that a carrier executes."""

from rapidgen.client.flows import (
    connect,
    control,
    data,
    download,
    job,
    motion,
    program,
    state,
    stop,
)

__all__ = ["connect", "control", "data", "download", "job", "motion", "program", "state", "stop"]
