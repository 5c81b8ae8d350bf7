"""One module of the user loaded into a task over Robot Web Services: plan, apply, verify.

`make_upload_plan` only reads. `upload_module` makes the plan again under mastership, so that it
changes exactly what was shown, and then

1. saves the module that it replaces, with its persistents,
2. copies the new one to its own folder below HOME and reads it back,
3. loads it, asks for build errors, and compares the text that the controller has then.

If a step fails, the saved module is loaded again, or the new one is unloaded. No task is started or
stopped: a controller loads modules only while no task runs [real 7.21].
"""

import difflib
import hashlib
import json
from collections.abc import Callable, Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from rapidgen.client.rws.errors import NotConfirmed, RwsError
from rapidgen.diagnostics import DiagnosticError, Span, error, refusal, suggest
from rapidgen.rapid import parse
from rapidgen.rapid.syntax.lexer import decode

if TYPE_CHECKING:
    from rapidgen.client.rws import Controller
    from rapidgen.client.rws.model import TaskState

FOLDER = "HOME/rapidgen_load"
_SCRATCH = "rapidgen_saved"


@dataclass(frozen=True, slots=True)
class UploadPlan:
    """What an upload does to a controller, found without changing it."""

    id: str
    """Changes with the controller, its module and the new text."""
    host: str
    task: str
    module: str
    action: Literal["add", "replace", "keep"]
    diff: tuple[str, ...]
    """Lines of a unified diff, from the controller's text to the new one."""
    pointer: str
    """Routine of the module with the program pointer, which moves to its beginning; else empty."""
    mode: str
    obstacles: tuple[str, ...]
    """Reasons why it cannot be applied now, each with its fix."""

    def text(self) -> str:
        """Return the plan for a user."""
        what = {"add": "add", "replace": "replace", "keep": "no change of"}[self.action]
        lines = [f"{self.host}: {what} module {self.module} in {self.task}"]
        if self.action == "replace":
            lines.append("  its data get the values of the file")
        if self.pointer:
            place = f"{self.module}/{self.pointer}"
            lines.append(f"  the program pointer moves to the beginning of {place}")
        lines += [f"  cannot be applied now: {reason}" for reason in self.obstacles]
        return "\n".join([*lines, *self.diff]) + "\n"


def make_upload_plan(
    services: "Controller", data: bytes, path: str, *, task: str = ""
) -> UploadPlan:
    """Return what an upload of a module file would do.

    Without `task` it is the only task that has the module, else the only motion task. Raises
    DiagnosticError RG340 and those of the syntax, RobotError.
    """
    text = decode(data)[0]
    tree = parse(text, path=path)
    faults = [d for d in tree.diagnostics if d.severity.value == "error"]
    if faults:
        raise DiagnosticError(faults)
    tasks = services.tasks()
    chosen = _task(services, tasks, task, tree.name)
    loaded = {m.name.lower(): m.name for m in services.modules(chosen)}
    own = loaded.get(tree.name.lower(), "")
    before = _readable(services, chosen, own) if own else ""
    same = bool(own) and _lines(before) == _lines(text)
    diff = difflib.unified_diff(
        _lines(before),
        _lines(text),
        f"{own} on the controller" if own else "nothing",
        path,
        lineterm="",
    )
    at = services.pointer(chosen)
    pointed = at.routine if own and at.module.lower() == own.lower() else ""
    parts = [services.identity().id, chosen, tree.name, before, hashlib.sha256(data).hexdigest()]
    return UploadPlan(
        hashlib.sha256(json.dumps(parts).encode()).hexdigest()[:16],
        services.where,
        chosen,
        own or tree.name,
        "keep" if same else "replace" if own else "add",
        () if same else tuple(diff),
        "" if same else pointed,
        services.panel().mode,
        () if same else tuple(_obstacles(tasks, tree.name)),
    )


def _task(services: "Controller", tasks: "Sequence[TaskState]", asked: str, module: str) -> str:
    names = [one.name for one in tasks]
    if asked:
        for name in names:
            if name.lower() == asked.lower():
                return name
        message = f"{services.where} has no task '{asked}'"
        help = suggest(asked, names) or f"its tasks are {', '.join(names)}"
        raise refusal("RG340", None, message, help, exit_code=1)
    having = [
        name
        for name in names
        if any(one.name.lower() == module.lower() for one in services.modules(name))
    ]
    motion = [one.name for one in tasks if one.motion]
    for candidates in (having, motion):
        if len(candidates) == 1:
            return candidates[0]
    message = f"the task of {module} at {services.where} is not clear"
    raise refusal("RG340", None, message, f"--task {' or '.join(having or names)}", exit_code=1)


def _readable(services: "Controller", task: str, module: str) -> str:
    """Return the text of a module; RG340 for an encrypted one, which could not be restored."""
    try:
        return services.module_text(task, module)
    except (RwsError, NotConfirmed) as fault:
        message = f"{services.where} does not give the text of {module} in {task}"
        help = "an encrypted or installed module is not replaced"
        raise refusal("RG340", None, message, help, exit_code=1) from fault


def _obstacles(tasks: "Sequence[TaskState]", module: str) -> list[str]:
    result = []
    running = [one.name for one in tasks if one.execution == "started"]
    if running:
        result.append(f"{', '.join(running)} run: stop them, `rapidgen stop-program HOST --all`")
    if module.upper().startswith("ROS_"):
        result.append(f"{module} belongs to a generated driver: use `rapidgen deploy`")
    return result


def _lines(text: str) -> list[str]:
    """Return lines that can be compared: the controller changes line ends and its encoding."""
    plain = text.encode("ascii", "replace").decode("ascii").strip()
    return [line.rstrip() for line in plain.splitlines()]


def upload_module(
    services: "Controller",
    plan: UploadPlan,
    data: bytes,
    path: str,
    *,
    keep: Callable[[bytes], None],
    say: Callable[[str], None],
) -> None:
    """Apply a plan. `keep` stores the module that is replaced, before anything changes.

    Raises DiagnosticError RG340 (not possible now), RG341 (the controller or the file has changed
    since the plan), RG342 (build errors; the earlier state is back), RobotError.
    """
    with services.mastership("rapid"):
        now = make_upload_plan(services, data, path, task=plan.task)
        if now.id != plan.id:
            message = f"{plan.module} or its controller has changed since the plan"
            raise refusal("RG341", None, message, "make the plan again and read it", exit_code=1)
        if now.obstacles:
            raise refusal("RG340", None, now.obstacles[0], exit_code=1)
        if now.action == "keep":
            return
        saved = b""
        if now.action == "replace":
            place = services.save_module(now.task, now.module, _SCRATCH)
            saved = services.read_file(place)
            services.delete_file(place)
            keep(saved)
        with ExitStack() as cleanup:
            with suppress(RwsError):
                services.make_folder(FOLDER)
            file = f"{FOLDER}/{now.module}.mod"
            _write(services, file, data)
            cleanup.callback(services.delete_file, file)
            with ExitStack() as undo:
                _point(services, now)
                undo.callback(_restore, services, now, file, saved, say)
                say(f"loading {now.module} into {now.task}")
                services.load_module(now.task, file, replace=now.action == "replace")
                _verify(services, now, data)
                undo.pop_all()
            _point(services, now)
    say(f"{now.module} is loaded into {now.task}")


def _write(services: "Controller", file: str, data: bytes) -> None:
    services.write_file(file, data)
    if services.read_file(file) != data:
        raise NotConfirmed.because("RG655", f"{file} at {services.where} is not what was written")


def _point(services: "Controller", plan: UploadPlan) -> None:
    """Set a pointer in the module to the beginning of its routine.

    A module with the pointer of a stopped program cannot be unloaded [code: an RWS 1 client]. The
    routine may be missing afterwards: then there is no pointer, and the program cannot start.
    """
    if plan.pointer:
        with suppress(RwsError):
            services.set_pointer(plan.task, plan.module, plan.pointer)


def _verify(services: "Controller", plan: UploadPlan, data: bytes) -> None:
    faults = services.build_errors(plan.task)
    if faults:
        raise DiagnosticError(
            [
                error("RG342", Span(f.module, f.row, f.column), f.text or "build error")
                for f in faults
            ],
            exit_code=1,
        )
    if _lines(services.module_text(plan.task, plan.module)) != _lines(decode(data)[0]):
        message = f"{services.where} agreed to load {plan.module}, and its text is another one"
        raise NotConfirmed.because("RG655", message)


def _restore(
    services: "Controller",
    plan: UploadPlan,
    file: str,
    saved: bytes,
    say: Callable[[str], None],
) -> None:
    """Bring the earlier state back after a failure."""
    if plan.action == "replace":
        say(f"loading the earlier {plan.module} again")
        _write(services, file, saved)
        _point(services, plan)
        services.load_module(plan.task, file, replace=True)
        return
    loaded = {m.name.lower() for m in services.modules(plan.task)}
    if plan.module.lower() in loaded:
        say(f"unloading {plan.module}")
        services.unload_module(plan.task, plan.module)
