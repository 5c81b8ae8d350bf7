"""Render templates to text, with a line map to the templates.

The map uses marks in Unicode's private use area. They are put at the start of every template line
that can produce text and removed after rendering, so that the output does not depend on them.
"""

import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import jinja2

from rapidgen import __version__

_OPEN, _CLOSE = "\ue000", "\ue001"
_MARK = re.compile(f"{_OPEN}([^{_OPEN}{_CLOSE}:]*):(\\d+){_CLOSE}")
_TAG = re.compile(r"\{%.*?%\}|\{#.*?#\}|\{\{.*?\}\}", re.S)


@dataclass(frozen=True, slots=True)
class RenderedText:
    """Text with LF line ends; `lines` has (line, template, template line) where it changes."""

    text: str
    lines: tuple[tuple[int, str, int], ...]


class Renderer:
    """Renders the templates of one folder.

    An undefined name is an error, never an empty text.
    """

    def __init__(self, folder: Path) -> None:
        self._environment = jinja2.Environment(
            loader=_Loader(folder, encoding="utf-8"),
            undefined=jinja2.StrictUndefined,
            trim_blocks=True,
            lstrip_blocks=True,
            keep_trailing_newline=True,
            autoescape=False,
            bytecode_cache=_compiled(),
        )

    def add_filter(self, name: str, function: Callable[..., object]) -> None:
        """Register `function` as a template filter."""
        self._environment.filters[name] = function

    def render(self, template: str, **context: object) -> RenderedText:
        """Return one template as text."""
        return unmarked(self._environment.get_template(template).render(**context))


def _compiled() -> jinja2.BytecodeCache | None:
    """Return the cache of compiled templates in the user's cache folder.

    Compiling is a third of a build. Jinja uses the text of a template as the key of its entry.
    """
    base = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    folder = os.path.join(base, "rapidgen", f"templates-{__version__}")
    try:
        os.makedirs(folder, mode=0o700, exist_ok=True)
    except OSError:
        return None
    # Code from a folder of another user would be executed; Windows has no numbers of users.
    is_own = not hasattr(os, "getuid") or os.stat(folder).st_uid == os.getuid()
    usable = is_own and os.access(folder, os.W_OK)
    return jinja2.FileSystemBytecodeCache(folder) if usable else None


class _Loader(jinja2.FileSystemLoader):
    def get_source(
        self, environment: jinja2.Environment, template: str
    ) -> tuple[str, str, Callable[[], bool]]:
        source, name, uptodate = super().get_source(environment, template)
        return marked(source, template), name, uptodate


def marked(source: str, template: str) -> str:
    """Return template text with a mark at each line start outside tags.

    A line that holds only a block or a comment gets none: it would keep Jinja from trimming it.
    """
    inside: set[int] = set()
    line = end = 0
    for tag in _TAG.finditer(source):
        first = line + source.count("\n", end, tag.start())
        end = tag.end()
        line = first + source.count("\n", tag.start(), end)
        inside.update(range(first + 1, line + 1))
    out = []
    for number, text in enumerate(source.splitlines(keepends=True)):
        bare = text.strip()
        if number in inside or bare.startswith(("{%", "{#")):
            out.append(text)
        else:
            out.append(f"{_OPEN}{template}:{number + 1}{_CLOSE}{text}")
    return "".join(out)


def unmarked(text: str) -> RenderedText:
    """Return the text without marks, and the line map."""
    lines: list[tuple[int, str, int]] = []
    place: tuple[str, int] | None = None
    out = []
    for number, line in enumerate(text.splitlines(keepends=True), 1):
        marks = _MARK.findall(line)
        if marks:
            result = (marks[0][0], int(marks[0][1]))
            # A run of consecutive template lines needs only one entry.
            if place is None or result != place:
                lines.append((number, *result))
            place = result
        if place is not None:
            place = (place[0], place[1] + 1)
        out.append(_MARK.sub("", line))
    return RenderedText("".join(out), tuple(lines))
