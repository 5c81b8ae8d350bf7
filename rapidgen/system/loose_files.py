"""Systems of single module, program and cfg files, with one or more tasks."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from rapidgen.diagnostics import refusal
from rapidgen.system.cfg import CfgText, parse_cfg
from rapidgen.system.cfg_reader import tasks_of, with_cfg
from rapidgen.system.loading import expand, load_module
from rapidgen.system.model import System, TaskSpec
from rapidgen.system.paths import module_files, read_limited
from rapidgen.system.releases import UNKNOWN_ROBOTWARE

_MOTION_TASK = re.compile(r"T_ROB(\d|_)", re.I)
_TASK = re.compile(r"T_\w+", re.I)


def task_folders(folder: Path) -> dict[str, list[Path]]:
    """Return module folders by task, at or below one named like a task.

    Programs of several tasks are published as T_ROB_L next to T_ROB_R. The result is empty if the
    folder has modules of its own.
    """
    if any(module_files(folder)):
        return {}
    result: dict[str, list[Path]] = {}
    for task in sorted(path for path in folder.iterdir() if _TASK.fullmatch(path.name)):
        below = [task, *(path for path in sorted(task.rglob("*")) if path.is_dir())]
        holding = [path for path in below if any(module_files(path))]
        if holding:
            result[task.name] = holding
    return result


def read_files(
    tasks: Mapping[str, Sequence[Path | str]] | Sequence[Path | str],
    *,
    cfg: Sequence[Path | str] = (),
    name: str = "loose",
    entry: str = "main",
    robotware: tuple[int, int] = UNKNOWN_ROBOTWARE,
    home: Path | None = None,
) -> System:
    """Return a system of modules, folders, `.pgf` and `.cfg` files.

    A plain sequence is one task, T_ROB1. SYS.cfg describes the tasks that it lists; of the others
    every task named like T_ROB1 (or the first, if none is) has a robot.

    Raises DiagnosticError: RG701..RG709.
    """
    source = dict(tasks) if isinstance(tasks, Mapping) else {"T_ROB1": tasks}
    cfg_files = [Path(path) for path in cfg]
    sources: dict[str, list[Path]] = {}
    for task, paths in source.items():
        for path in map(Path, paths):
            if path.suffix.casefold() == ".cfg":
                cfg_files.append(path)
            else:
                sources.setdefault(task, []).extend(expand(path))
    if not sources:
        raise refusal("RG709", None, "no RAPID module was given", "name a .mod or .sys file")
    texts = [parse_cfg(read_limited(path), path=str(path)) for path in cfg_files]
    sys_cfg = _merged(texts, "SYS", robotware)
    eio_cfg = _merged(texts, "EIO", robotware)
    described = {task.name.casefold(): task for task in tasks_of(sys_cfg)}
    motion = {task for task in sources if _MOTION_TASK.match(task)} or {next(iter(sources))}
    specs = []
    for task, paths in sources.items():
        spec = described.get(task.casefold())
        if spec is None:
            spec = TaskSpec(task, entry=entry, motion=task in motion)
        modules = tuple(load_module(path) for path in paths)
        specs.append(replace(spec, modules=modules))
    result = System(
        name=name,
        tasks=tuple(specs),
        robotware=robotware,
        home=home,
    )
    return with_cfg(result, sys_cfg, eio_cfg)


def _merged(texts: Sequence[CfgText], domain: str, robotware: tuple[int, int]) -> CfgText:
    result = [text for text in texts if text.domain == domain]
    sections = tuple(section for text in result for section in text.sections)
    path = result[0].path if result else ""
    return CfgText(domain, (robotware[0], 0), sections, path)
