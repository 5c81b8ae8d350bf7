"""Flows of the client: generators of `effects` that a carrier executes."""

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
