"""Flows of the client: generators of `effects` that a carrier executes."""

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
