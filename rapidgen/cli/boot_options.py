"""What `run` and `sim` boot: options to wishes, what no controller loads, and what was guessed."""

import sys
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rapidgen.cli.terminal import use_colour
from rapidgen.diagnostics import DiagnosticError, Severity, refusal, render

if TYPE_CHECKING:
    from rapidgen.controller.boot_targets import Bootable
    from rapidgen.controller.cell_setup import InferenceLog
    from rapidgen.controller.inference.answers import Answer
    from rapidgen.controller.inference.cell import UndeclaredName


def chosen(
    targets: Sequence[str],
    *,
    tasks: Iterable[str] | None = None,
    robot: str = "",
    robotware: str = "",
    entry: str = "",
    cell: str = "",
    start: str = "",
    backup: Path | None = None,
    overrides: Sequence[str] | None = None,
    check: bool = True,
) -> "Bootable":
    """Read what is to be booted, and refuse what no controller loads unless `check` is False.

    Notes, and what was guessed, are told on stderr. Raises DiagnosticError.
    """
    from rapidgen.controller.boot_targets import BootOptions, load_target

    options = BootOptions(
        _tasks(tasks or ()),
        robot=robot,
        robotware=_release(robotware),
        entry=entry,
        cell=cell,
        start=_numbers(start),
        backup=backup,
        overrides=tuple(overrides or ()),
    )
    result = load_target(targets, options)
    if result.notes:
        sys.stderr.write(render(result.notes, colour=use_colour()))
    if result.likely is not None:
        one = result.likely
        reach = f"reaches {one.reached} of {one.targets} targets that its program names"
        sys.stderr.write(f"guessed robot: {one.model}, which {reach}\n")
    if result.guessed is not None:
        sys.stderr.write(_table("guessed", result.guessed.named))
        sys.stderr.write(_table("nobody declares, and it was not guessed", result.guessed.unknown))
    if check:
        _refuse_unloadable(result)
    return result


def _release(text: str) -> tuple[int, int] | None:
    from rapidgen.system.releases import ANY_MINOR, release

    if not text:
        return None
    major, minor = release(text)
    if minor == ANY_MINOR:
        raise refusal(
            "RG901", None, "a controller has one release", f"such as --robotware {major}.6"
        )
    return major, minor


def _tasks(given: Iterable[str]) -> dict[str, list[str]]:
    by_task: dict[str, list[str]] = {}
    for text in given:
        name, equals, names = text.partition("=")
        if not equals or not name or not names:
            raise refusal(
                "RG901",
                None,
                f"--task '{text}' is not NAME=FILE,FILE",
                "such as --task T_ROB1=main.mod,data.mod",
            )
        by_task.setdefault(name, []).extend(names.split(","))
    return by_task


def _numbers(text: str) -> tuple[float, ...]:
    try:
        return tuple(float(part) for part in text.strip("[] ").split(",")) if text else ()
    except ValueError as fault:
        help = "such as --start 0,0,0,0,30,0"
        raise refusal("RG901", None, f"--start '{text}' is no list of numbers", help) from fault


def _table(title: str, rows: "Sequence[UndeclaredName]") -> str:
    if not rows:
        return ""
    width = max(len(row.name) for row in rows)
    lines = (
        f"  {row.name:{width}}  {row.type or '?':9}  {Path(row.span.path).name}:{row.span.line}\n"
        for row in sorted(rows, key=lambda row: (row.type, row.name.casefold()))
    )
    return f"{title}:\n{''.join(lines)}"


def inference_report(guessed: "InferenceLog") -> str:
    """What guessed inputs became, how dialogs were answered, and where the guessed robot did not
    go as programmed."""
    why = "guessed, because the program waited for it"
    other = "the guessed robot did not come there as programmed (`--robot` chooses another)"
    again = "stopped behind an answer that was guessed, and started from main again"
    return (
        _counted(why, " = ", guessed.answered)
        + _counted(again, ": ", guessed.stopped)
        + _counted(other, ": ", guessed.missed)
    )


def _counted(title: str, between: str, message: "Iterable[Answer]") -> str:
    given = [
        f"{name}{between}{value if isinstance(value, str) else f'{value:g}'}"
        + (f" ({count} times)" if count > 1 else "")
        for (name, value), count in Counter(message).items()
    ]
    return f"{title}: {', '.join(given)}\n" if given else ""


def _refuse_unloadable(result: "Bootable") -> None:
    """Names that nothing declares are found when reached; warnings are `check`'s business."""
    from rapidgen.rapid import check

    errors = [d for d in check(result.system, gaps=True) if d.severity is Severity.ERROR]
    if errors:
        raise DiagnosticError(errors)
