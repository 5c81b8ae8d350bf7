"""Handlers of operations, and sources of events, by theme.

Importing this package fills their tables.
"""

from rapidgen.servers.rws.handlers import (
    cfg,
    dialogs,
    files,
    modules,
    motion,
    panel,
    queues,
    signals,
    subscribing,
    symbols,
    system,
    tasks,
    users,
)

__all__ = [
    "cfg",
    "dialogs",
    "files",
    "modules",
    "motion",
    "panel",
    "queues",
    "signals",
    "subscribing",
    "symbols",
    "system",
    "tasks",
    "users",
]
