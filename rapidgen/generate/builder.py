"""Generate the files of a configuration in memory."""

import hashlib
import json
import os
from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from rapidgen import __version__
from rapidgen._data import data_folder
from rapidgen._json import Members, members
from rapidgen.config import to_manifest
from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.diagnostics import DiagnosticError
from rapidgen.generate import layout
from rapidgen.generate.context import group_context, used_constants
from rapidgen.generate.lint import lint
from rapidgen.generate.name_checks import check_tasks, naming
from rapidgen.generate.numbers import literal
from rapidgen.generate.output import Output, OutputFile, manifest_file
from rapidgen.generate.parameters import OPEN_FILES, cfg_files
from rapidgen.generate.readme import readme_context
from rapidgen.generate.render import RenderedText, Renderer
from rapidgen.system import ModuleFile, System, TaskSpec, expand_lines, write_cfg
from rapidgen.system.build_loading import BaseController, additions, delivered, of_backup, onto
from rapidgen.system.cfg_reader import ModuleEntry

if TYPE_CHECKING:
    from rapidgen.generate.existing_controller import Cell

# Placeholder of the build's id, of equal length, until all its inputs exist.
_UNKNOWN = "{build---id}"


def build(config: RobotConfig, cell: "Cell | None" = None) -> Output:
    """Return all files for one controller; for `cell`, the missing parts.

    `config` must be fitted to `cell`.

    Raises DiagnosticError: RG012 (a motion task has the name of a generated one), RG101 (a name or
    text of the configuration does not fit into RAPID),
    RG105 (the first line of a cfg file is not known for this RobotWare), RG106 (a name is taken in
    RAPID), RG110 (the cell has a conflicting instance), RG112 (its program has a name that the
    driver needs), RG113 (it does not declare required data), RG720..RG723 (it would not load the
    files).
    """
    check_tasks(config)
    templates = data_folder("templates")
    renderer = Renderer(templates)
    renderer.add_filter("num", literal)
    system = layout.make_system(config, _UNKNOWN)
    parameters = cfg_files(config, system)
    used = {}
    if cell is not None:
        # Slow imports: the checker of RAPID and the reader of backups.
        from rapidgen.generate.cell_routines import check_routines
        from rapidgen.generate.existing_controller import check_data, missing, used_signals

        check_data(config, cell.system)
        check_routines(config, cell.system)
        used = used_signals(parameters, cell)
        parameters = missing(parameters, cell)
    files = [
        *(f for group in config.groups for f in _modules(config, group, renderer)),
        *(_cfg(name, write_cfg(text)) for name, text in parameters),
    ]
    readme = renderer.render("README.md.j2", **readme_context(config, system, _UNKNOWN))
    files.append(OutputFile("README.md", readme.text.encode("utf-8"), "readme"))
    build_id = make_build_id(config, files)
    known = build_id.encode()
    files = [replace(f, data=f.data.replace(_UNKNOWN.encode(), known)) for f in files]
    files.append(manifest_file(files, _head(config, build_id, files, used)))
    output = Output(config.name, build_id, tuple(files))
    if cell is not None:
        from rapidgen.generate.existing_controller import check_link_conflicts

        check_link_conflicts(
            make_system(config, output, under=of_backup(cell.cfg, cell.system)), output
        )
    return output


def make_system(
    config: RobotConfig,
    output: Output,
    *,
    under: BaseController | None = None,
    without: Collection[str] = (),
    open_words: bool = True,
) -> System:
    """Return the controller that the output gives, without the disk."""
    modules = {}
    for file in output.files:
        if file.kind == "module":
            name = Path(file.path).stem
            origin = expand_lines(file.lines, file.data.count(b"\n"))
            target = "HOME:/" + file.path.removeprefix("HOME/")
            modules[target] = ModuleFile(name, file.path, file.data, target, origin)

    def load(task: TaskSpec, entries: tuple[ModuleEntry, ...], _: str) -> tuple[ModuleFile, ...]:
        ours = (modules[entry.file] for entry in entries if entry.loads_into(task))
        return (*task.modules, *ours)

    manifest = members(json.loads(output.files[-1].data))
    texts = {file.path: file.data for file in output.files if file.kind == "cfg"}
    given = additions(manifest, texts, without, Path())
    system = onto(under or delivered(manifest), given, load, open_words=open_words)
    return replace(system, name=config.name, build_id=output.build_id)


def make_build_id(config: RobotConfig, files: Iterable[OutputFile]) -> str:
    """Return 12 hexadecimal digits over the generated files and their inputs."""
    digest = hashlib.sha256()
    parts: list[bytes] = [
        __version__.encode(),
        json.dumps(to_manifest(config), sort_keys=True).encode(),
    ]
    for file in files:
        parts += [file.path.encode(), file.data]
    for name, data in config.inputs:
        parts += [os.fsencode(Path(name).name), data]
    for part in parts:
        digest.update(len(part).to_bytes(8, "big") + part)
    return digest.hexdigest()[:12]


def _modules(config: RobotConfig, group: GroupConfig, renderer: Renderer) -> list[OutputFile]:
    context = group_context(config, group, _UNKNOWN)
    names = layout.modules(config, group)

    def render(module: str, **more: object) -> RenderedText:
        kind = "sys" if module in layout.SYSTEM_MODULES else "mod"
        return renderer.render(f"{module}.{kind}.j2", **context, **more)

    result = {module: render(module) for module in names if module != layout.COMMON}
    # The names of the other modules are declared there; it uses some itself.
    own = render(layout.COMMON, constants=(), reasons=())
    used = used_constants(rendered.text for rendered in (*result.values(), own))
    result[layout.COMMON] = render(layout.COMMON, **used)
    files = []
    faults = []
    for module in names:
        rendered = result[module]
        path = f"HOME/{layout.module_file(config, group, module)}"
        faults += lint(path, rendered.text)
        tasks = tuple(
            layout.task_name(config, group, role)
            for role in layout.roles(config, group)
            if module in role.modules
        )
        # Controllers write CR LF and read both; LF keeps line counts and diffs simple.
        data = rendered.text.encode("ascii", errors="replace")
        files.append(OutputFile(path, data, "module", tasks, rendered.lines))
    faults += naming(config, group, [file.data.decode("ascii", errors="replace") for file in files])
    if faults:
        raise DiagnosticError(faults)
    return files


def _cfg(path: str, text: str) -> OutputFile:
    return OutputFile(path, text.replace("\n", "\r\n").encode("ascii"), "cfg")


def _head(
    config: RobotConfig, build_id: str, files: list[OutputFile], used: Mapping[str, str]
) -> Members:
    return {
        "format": 1,
        "rapidgen": __version__,
        "name": config.name,
        "build_id": build_id,
        "robotware": list(config.robotware),
        # Files that a controller may reject as a whole.
        "optional": [f.path for f in files if f.path in OPEN_FILES],
        **({"cell_signals": dict(used)} if used else {}),
        "groups": {
            group.name: {
                "task": group.task,
                "ports": {
                    name: port
                    for name, port in (
                        ("motion", group.ports.motion),
                        ("control", group.ports.control),
                        ("state", group.ports.state),
                    )
                    if port
                },
                "joints": [joint.name for joint in group.joints],
            }
            for group in config.groups
        },
        "configuration": to_manifest(config),
    }
