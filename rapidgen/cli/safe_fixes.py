"""Application of safe fixes to RAPID files, for `check --fix`."""

from collections.abc import Iterable
from pathlib import Path

import typer

from rapidgen.cli.project import FileEncoding
from rapidgen.diagnostics import Diagnostic, Edit, apply_edits


def apply_safe_fixes(findings: Iterable[Diagnostic], encoding: FileEncoding) -> int:
    """Write files with all safe fixes of their findings; return the number of fixes.

    A fix is applied as a whole or not at all. Files keep their encoding and line ends. Files of a
    generated folder are not changed, because the next build would write them again. A file that is
    not UTF-8 has the given encoding. Raises DiagnosticError for a file that cannot be read or
    written.
    """
    from rapidgen._atomic_write import write_whole
    from rapidgen.rapid import Dialect, parse
    from rapidgen.system import is_generated
    from rapidgen.system.paths import read_limited

    edits: dict[str, list[Edit]] = {}
    counts: dict[str, int] = {}
    for finding in findings:
        for fix in finding.fixes:
            paths = {edit.span.path for edit in fix.edits}
            if not fix.is_safe or len(paths) != 1:
                continue
            path = paths.pop()
            known = edits.setdefault(path, [])
            if not any(_overlap(edit, other) for edit in fix.edits for other in known):
                known += fix.edits
                counts[path] = counts.get(path, 0) + 1
                break
    for path, changes in edits.items():
        file = Path(path)
        if any(is_generated(folder) for folder in file.resolve().parents):
            typer.echo(f"not changed: {path} is generated", err=True)
            counts[path] = 0
            continue
        data = read_limited(file)
        source = parse(data, path=path, dialect=Dialect(encoding=encoding.value)).source
        text = apply_edits(data.decode(source.encoding), changes, source.offset)
        write_whole(file, text.encode(source.encoding))
        typer.echo(f"fixed {counts[path]} finding(s) in {path}", err=True)
    return sum(counts.values())


def _overlap(one: Edit, other: Edit) -> bool:
    if one.span == other.span:
        return True
    start = (one.span.line, one.span.column)
    end = (one.span.end_line, one.span.end_column)
    second = (other.span.line, other.span.column)
    second_end = (other.span.end_line, other.span.end_column)
    return start < second_end and second < end
