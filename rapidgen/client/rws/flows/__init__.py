"""What the client does step by step: generators over `effects`."""

from rapidgen.client.rws.flows import (
    cfg,
    connecting,
    files,
    holding,
    jobs,
    log,
    motion,
    panel,
    rapid,
    signals,
    subscribing,
    users,
)

__all__ = [
    "cfg",
    "connecting",
    "files",
    "holding",
    "jobs",
    "log",
    "motion",
    "panel",
    "rapid",
    "signals",
    "subscribing",
    "users",
]
