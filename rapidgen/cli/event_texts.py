"""Texts about event numbers of a controller: for `explain` and `log`."""

import textwrap
from collections import Counter
from collections.abc import Iterator

from rapidgen.machine.event_table import KINDS, EventKind, domain_of
from rapidgen.machine.saved_log import SavedEvent, SavedLog

_TYPES = {"E": "error", "W": "warning", "I": "information"}
_WIDTH = 88


def explained(kind: EventKind) -> str:
    """Return number, meaning, usual causes, remedy and source of an event."""
    types = " or ".join(_TYPES[letter] for letter in kind.types)
    if kind.is_own:
        seen = "rapidgen's own number: no controller writes it"
    elif kind.releases:
        seen = f"seen with RobotWare {', '.join(kind.releases)}"
    else:
        seen = "releases unknown"
    parts = [
        f"{kind.code}: {kind.title}",
        f"{types}, domain {domain_of(kind.code).name.lower()}; {seen}",
        "",
        kind.text.replace("{", "<").replace("}", ">"),
    ]
    if kind.causes:
        parts.append(f"Usual causes: {kind.causes}")
    if kind.remedy:
        parts.append(f"What to do: {kind.remedy}")
    parts.append(f"Source: {kind.source}")
    return "\n".join(textwrap.fill(part, _WIDTH, subsequent_indent="  ") for part in parts) + "\n"


def listed() -> Iterator[str]:
    """Yield one line for each known event."""
    for code in sorted(KINDS):
        yield f"{code:6}  {'/'.join(KINDS[code].types):3}  {KINDS[code].title}"


def saved_event(event: SavedEvent) -> str:
    """Return an event of a saved log with the table's text, or its own where none is known."""
    kind = KINDS.get(event.code)
    text = kind.filled(event.arguments) if kind is not None else event.text
    title = kind.title if kind is not None else event.title
    return f"{event.date}  {event.type}  {event.code:6}  {title}\n    {text}"


def summary(log: SavedLog) -> Iterator[str]:
    """Yield how often each error and warning occurs, and what to do about it."""
    counts = Counter((event.code, event.type) for event in log.events if event.type != "I")
    release = f" of RobotWare {log.robotware}" if log.robotware else ""
    yield f"{len(log.events)} events{release}; errors and warnings:"
    titles = {event.code: event.title for event in log.events}
    for (code, letter), count in counts.most_common():
        kind = KINDS.get(code)
        yield f"{count:6} x  {letter}  {code:6}  {kind.title if kind else titles[code]}"
        if kind is not None and kind.remedy:
            yield textwrap.fill(
                kind.remedy, _WIDTH, initial_indent=" " * 22, subsequent_indent=" " * 22
            )
