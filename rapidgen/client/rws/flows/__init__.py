"""What the client does step by step: generators over `effects`."""

from rapidgen.client.rws.flows import (
    cfg,
    connecting,
    dialogs,
    files,
    holding,
    jobs,
    log,
    motion,
    panel,
    queues,
    rapid,
    signals,
    subscribing,
    users,
)

__all__ = [
    "cfg",
    "connecting",
    "dialogs",
    "files",
    "holding",
    "jobs",
    "log",
    "motion",
    "panel",
    "queues",
    "rapid",
    "signals",
    "subscribing",
    "users",
]
