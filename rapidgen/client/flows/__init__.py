"""What the client does step by step: generators over `effects`, carried out by others."""

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
