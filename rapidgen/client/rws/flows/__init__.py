"""Flows of the client: generators of `effects` that a runner executes."""

from rapidgen.client.rws.flows import (
    cfg,
    connect,
    dialogs,
    equipment,
    files,
    jobs,
    mastership,
    panel,
    queues,
    rapid,
    subscriptions,
    users,
)

__all__ = [
    "cfg",
    "connect",
    "dialogs",
    "equipment",
    "files",
    "jobs",
    "mastership",
    "panel",
    "queues",
    "rapid",
    "subscriptions",
    "users",
]
