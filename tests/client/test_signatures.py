"""Calls of both clients are ordinary methods: editors show signature, docstring and source."""

import ast
import inspect
import textwrap
from pathlib import Path

import pytest

import rapidgen.client
from rapidgen.client import (
    AsyncCell,
    AsyncController,
    AsyncExecution,
    AsyncProgramRun,
    AsyncRobot,
    AsyncStream,
    Cell,
    Controller,
    Execution,
    ProgramRun,
    Robot,
    Stream,
)

PACKAGE = Path(rapidgen.client.__file__).parent
PAIRS = [
    (Robot, AsyncRobot),
    (Execution, AsyncExecution),
    (ProgramRun, AsyncProgramRun),
    (Stream, AsyncStream),
    (Controller, AsyncController),
]
SYNC_ONLY = {(Robot, "data")}
"""A mapping, whose access cannot be awaited."""
OWN_BODY = {"egm", "extend", "states", "mastership", "subscribe"}
"""Asynchronous iterators and context managers."""


def public(kind):
    return {name for name in dir(kind) if not name.startswith("_")}


CALLS = [
    pytest.param(kind, twin, name, id=f"{kind.__name__}.{name}")
    for kind, twin in [*PAIRS, (Cell, AsyncCell)]
    for name in sorted(public(kind))
    if inspect.isfunction(getattr(kind, name))
]


def without_async(text):
    text = text.replace("client.aio.", "client.sync.").replace("Async", "")
    return text.replace("async ", "").replace("await ", "").replace("\n", " ")


def body(function):
    (node,) = ast.parse(textwrap.dedent(inspect.getsource(function))).body
    return without_async(ast.unparse(node.body[1:]))


@pytest.mark.parametrize(("kind", "twin"), [*PAIRS, (Cell, AsyncCell)])
def test_both_clients_have_the_same_names(kind, twin):
    only = {name for owner, name in SYNC_ONLY if owner is kind}
    assert public(kind) - only == public(twin)


@pytest.mark.parametrize(("kind", "twin", "name"), CALLS)
def test_call_has_a_real_signature_and_a_source(kind, twin, name):
    for owner in (kind, twin):
        function = inspect.unwrap(getattr(owner, name))
        assert inspect.isfunction(function)
        assert function.__name__ == name
        assert PACKAGE in Path(inspect.getsourcefile(function)).parents
        assert f"def {name}(" in inspect.getsource(function)
        assert not hasattr(function, "__signature__")
        assert (function.__doc__ or "").strip().endswith((".", "`"))


@pytest.mark.parametrize(("kind", "twin", "name"), CALLS)
def test_both_clients_have_the_same_call(kind, twin, name):
    sync, other = getattr(kind, name), getattr(twin, name)
    if name not in OWN_BODY:
        assert without_async(str(inspect.signature(other))) == str(inspect.signature(sync))
        assert sync is other or name == "stream" or inspect.iscoroutinefunction(other)
        if kind is not Cell:
            assert other.__doc__ == sync.__doc__
            assert body(other) == body(sync)
    names = [list(inspect.signature(call).parameters) for call in (sync, other)]
    assert names[0] == names[1]


@pytest.mark.parametrize("kind", [kind for pair in PAIRS for kind in pair])
def test_properties_are_described(kind):
    for name in public(kind):
        member = inspect.getattr_static(kind, name)
        if isinstance(member, property):
            assert (member.__doc__ or "").strip()
