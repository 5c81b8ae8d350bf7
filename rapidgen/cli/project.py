"""What `check` and `fmt` read: folders and robot of the project file, encodings of files."""

from pathlib import Path
from typing import TYPE_CHECKING

from rapidgen._compat import StrEnum
from rapidgen.diagnostics import DiagnosticError, refusal
from rapidgen.system.project import PROJECT_FILE, Project, find_project

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rapidgen.config.model import GroupConfig


class FileEncoding(StrEnum):
    """Encodings of files that are not UTF-8."""

    LATIN_1 = "latin-1"
    CP1252 = "cp1252"
    GBK = "gbk"


def project_folders(verb: str, help: str) -> tuple[Path, ...]:
    """Return the folders of the current project. Raises DiagnosticError RG730, RG901."""
    project = find_project(Path())
    if project is None:
        message = f"nothing to {verb}, and no {PROJECT_FILE} in this folder or above"
        raise refusal("RG901", None, message, help)
    return project.folders or (project.path.parent,)


def project_robots(project: Project) -> "Sequence[GroupConfig]":
    """Return the robots of a project; an unknown name is a fault of its file (RG730)."""
    from rapidgen.controller.mechanics import robots_named

    try:
        return robots_named(project.robot)
    except DiagnosticError as fault:
        first = fault.diagnostics[0]
        raise refusal("RG730", project.places["robot"], first.message, first.help) from fault
