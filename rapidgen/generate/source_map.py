"""Map lines of generated RAPID to lines of their templates.

A build stores the map of its lines with the files; the templates come with the program. A folder
may have been built by another version, or name other files as its templates: then only name and
line of the template are shown.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from rapidgen._data import data_folder

Line = tuple[int, str, int]
"""A line, its template, the template's line."""


@dataclass(frozen=True, slots=True)
class TextOrigin:
    """Templates of a text; no `templates`: not those of this version."""

    lines: tuple[Line, ...]
    templates: Mapping[str, str] = field(default_factory=dict)
    """Texts by name."""


def origin_of(text: str, lines: Sequence[Line]) -> TextOrigin:
    """Return the templates of a text with this line map."""
    known = {path.name: path for path in data_folder("templates").glob("*.j2")}
    names = dict.fromkeys(template for _, template, _ in lines)
    if not known.keys() >= names.keys():
        return TextOrigin(tuple(lines))
    texts = {name: known[name].read_text(encoding="utf-8") for name in names}
    if not _fit(text, lines, texts):
        return TextOrigin(tuple(lines))
    return TextOrigin(tuple(lines), texts)


def _fit(text: str, lines: Sequence[Line], templates: Mapping[str, str]) -> bool:
    """True if the text agrees with the templates' lines without tags."""
    made = text.splitlines()
    written = {name: template.splitlines() for name, template in templates.items()}
    for line, template, number in lines:
        if not (0 < line <= len(made) and 0 < number <= len(written[template])):
            return False
        source = written[template][number - 1]
        if "{" not in source and source.rstrip() != made[line - 1].rstrip():
            return False
    return True
