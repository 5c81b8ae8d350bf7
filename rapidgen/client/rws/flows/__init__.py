"""What the client does step by step: generators over `effects`."""

from rapidgen.client.rws.flows import (
    cfg,
    connect,
    dialogs,
    files,
    jobs,
    log,
    mastership,
    motion,
    panel,
    queues,
    rapid,
    signals,
    subscriptions,
    users,
)

__all__ = [
    "cfg",
    "connect",
    "dialogs",
    "files",
    "jobs",
    "log",
    "mastership",
    "motion",
    "panel",
    "queues",
    "rapid",
    "signals",
    "subscriptions",
    "users",
]
