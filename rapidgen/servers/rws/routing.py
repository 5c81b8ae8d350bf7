"""Routing table of operations, filled by `@serves(...)`."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

from rapidgen.servers.rws.messages import RwsRequest, RwsResponse
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.operations import Route, RwsOperation

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext

Handler = Callable[["RwsContext", RwsRequest], RwsResponse | None]
_TABLE: list[tuple[RwsOperation, Handler]] = []


def serves(*operations: RwsOperation) -> Callable[[Handler], Handler]:
    """Register the decorated function for these operations."""

    def put(handler: Handler) -> Handler:
        _TABLE.extend((operation, handler) for operation in operations)
        return handler

    return put


def served() -> tuple[tuple[RwsOperation, Handler], ...]:
    """Return all served operations and their handlers."""
    return tuple(_TABLE)


@dataclass(frozen=True, slots=True)
class _Row:
    pattern: re.Pattern[str]
    route: Route
    handler: Handler
    operation: RwsOperation


@dataclass(frozen=True, slots=True)
class RouteMatch:
    """Result of a path: a handler and its operation, or allowed methods."""

    handler: Handler | None
    names: Mapping[str, str]
    allowed: tuple[str, ...] = ()
    operation: RwsOperation | None = None


@cache
def _rows(generation: Generation) -> tuple[_Row, ...]:
    routes = [(operation.route(generation), operation, handler) for operation, handler in _TABLE]
    rows = [_Row(r.pattern, r, handler, operation) for r, operation, handler in routes if r]
    # The more specific path goes first: `/ctrl/identity` before `/ctrl/{variable}`.
    return tuple(sorted(rows, key=_vagueness))


def _vagueness(row: _Row) -> tuple[int, bool, int, bool]:
    path = row.route.path
    return path.count("{"), "*" in path, -len(path), not row.route.selector


@cache
def services(generation: Generation) -> tuple[str, ...]:
    """Return the names directly below `/rw`."""
    paths = (row.route.path.split("/") for row in _rows(generation))
    return tuple(sorted({path[2] for path in paths if path[1] == "rw" and len(path) > 2}))


def find(generation: Generation, method: str, path: str, query: Mapping[str, str]) -> RouteMatch:
    """Return the handler of a request.

    Without a handler, empty `allowed` means 404, else 405.
    """
    action = f"action={query['action']}" if query.get("action") else ""
    request = (action,) if action else (f"resource={query.get('resource', '')}", "")
    allowed: list[str] = []
    for row in _rows(generation):
        match = row.pattern.fullmatch(path)
        if match is None:
            continue
        if row.route.method == method and row.route.selector in request:
            return RouteMatch(row.handler, match.groupdict(), operation=row.operation)
        allowed.append(row.route.method)
    return RouteMatch(None, {}, tuple(dict.fromkeys(allowed)))
