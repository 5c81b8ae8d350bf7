"""Plans of faults in connections and the controller.

A plan is data read from YAML (`sim --faults FILE`). `network/fault_injection.py` executes the part
on connections; `schedule` puts the part on the controller on its clock.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import Field, dataclass, fields
from pathlib import Path
from typing import Literal, Protocol, TypeVar, get_args

from rapidgen._reading import read_foreign
from rapidgen.config.yaml_tree import MAX_BYTES, data_of
from rapidgen.diagnostics import DiagnosticError, Span, refusal, suggest
from rapidgen.machine.network.fault_injection import NetworkRule
from rapidgen.machine.scheduler import S, Scheduler

ControllerAction = Literal[
    "e-stop", "release-e-stop", "reset-e-stop", "motors-on", "motors-off", "auto", "manual",
    "start", "stop", "power-loss",
]  # fmt: skip


@dataclass(frozen=True, slots=True)
class ControllerRule:
    """A fault at a time (s), or before a statement.

    A statement is `task`, `module` and `line`; `pass_` counts its executions.
    """

    do: ControllerAction
    at: float = -1.0
    task: str = ""
    module: str = ""
    line: int = 0
    pass_: int = 1


_R = TypeVar("_R")


@dataclass(frozen=True, slots=True)
class FaultPlan:
    """All rules of one run."""

    network: tuple[NetworkRule, ...] = ()
    controller: tuple[ControllerRule, ...] = ()


class FaultTarget(Protocol):
    """Operations of a controller that a plan needs."""

    @property
    def scheduler(self) -> Scheduler:
        """Clock of the controller."""

    def perform(self, action: str) -> None:
        """Execute a `ControllerAction`."""

    def before_statement(
        self, task: str, module: str, line: int, count: int, action: Callable[[], None]
    ) -> None:
        """Call `action` before the `count`-th execution of a statement."""


def schedule(plan: FaultPlan, controller: FaultTarget) -> None:
    """Schedule the controller's part of a plan."""
    for rule in plan.controller:
        action = _action(controller, rule.do)
        if rule.line:
            controller.before_statement(rule.task, rule.module, rule.line, rule.pass_, action)
        else:
            controller.scheduler.at(round(rule.at * S), action)


def _action(controller: FaultTarget, name: str) -> Callable[[], None]:
    return lambda: controller.perform(name)


def read_plan(path: Path) -> FaultPlan:
    """Read a plan from YAML. Raises DiagnosticError RG421."""
    try:
        content = data_of(read_foreign(path, MAX_BYTES), str(path))
    except OSError as fault:
        raise _unusable(path, fault.strerror or str(fault)) from fault
    except DiagnosticError as fault:
        result = fault.diagnostics[0]
        raise _unusable(path, result.message, result.help, result.span) from fault
    if not isinstance(content, dict) or set(content) - {"network", "controller"}:
        raise _unusable(path, "it is no mapping with `network` and `controller`")
    network = _rules(path, content, "network", NetworkRule, fields(NetworkRule))
    controller = _rules(path, content, "controller", ControllerRule, fields(ControllerRule))
    for i, rule in enumerate(controller, 1):
        if (rule.at >= 0) == bool(rule.line):
            raise _unusable(path, f"controller rule {i}: either `at`, or `module` and `line`")
    return FaultPlan(tuple(network), tuple(controller))


def _rules(
    path: Path,
    plan: Mapping[str, object],
    part: str,
    make: Callable[..., _R],
    known: Sequence[Field[object]],
) -> list[_R]:
    entries = plan.get(part)
    if entries is None:
        return []
    if not isinstance(entries, list):
        raise _unusable(path, f"`{part}` is no list")
    by_name = {field.name.rstrip("_"): field for field in known}
    rules = [_rule(path, f"{part} rule {i}", e, by_name) for i, e in enumerate(entries, 1)]
    return [make(**rule) for rule in rules]


def _rule(
    path: Path, where: str, entry: object, known: Mapping[str, Field[object]]
) -> dict[str, object]:
    if not isinstance(entry, Mapping):
        raise _unusable(path, f"{where} is no mapping")
    chosen: dict[str, object] = {}
    for key, value in entry.items():
        field = known.get(str(key))
        if field is None:
            raise _unusable(path, f"{where}: unknown key '{key}'", suggest(str(key), list(known)))
        chosen[field.name] = _checked(path, f"{where}: `{key}`", value, field.type)
    if "do" not in chosen:
        raise _unusable(path, f"{where}: `do` is missing")
    return chosen


def _checked(path: Path, where: str, value: object, expected: object) -> object:
    allowed = get_args(expected)
    if allowed:
        if value not in allowed:
            raise _unusable(
                path, f"{where} is one of {', '.join(allowed)}", suggest(str(value), allowed)
            )
    elif expected is str:
        if not isinstance(value, str):
            raise _unusable(path, f"{where} is no text")
    elif isinstance(value, bool) or not isinstance(value, int | float) or value < 0:
        raise _unusable(path, f"{where} is no number from 0 on")
    elif expected is int and not isinstance(value, int):
        raise _unusable(path, f"{where} is not whole")
    return value


def _unusable(path: Path, reason: str, help: str = "", span: Span | None = None) -> DiagnosticError:
    return refusal(
        "RG421",
        span or Span(str(path), 1, 1),
        f"the fault plan cannot be used: {reason}",
        help or "`rapidgen explain RG421` shows a plan",
    )
