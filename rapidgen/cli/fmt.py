"""`rapidgen fmt`: RAPID files in ABB's style."""

from pathlib import Path
from typing import Annotated

import typer

from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, refusal

_SUFFIXES = (".mod", ".modx", ".sys", ".sysx", ".prg")


def fmt(
    paths: Annotated[
        list[Path], typer.Argument(help="RAPID files, or folders of them.", metavar="PATH...")
    ],
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing; exit 1 if a file would change.")
    ] = False,
    diff: Annotated[
        bool, typer.Option("--diff", help="Write nothing; show what would change.")
    ] = False,
) -> int:
    """Format RAPID: keywords in upper case, four spaces a level, comments kept.

    Encoding and line ends stay as they are; where a file mixes them, its commonest is taken, and
    that is said. A file with syntax errors is not touched.
    """
    from rapidgen._atomic_write import write_whole
    from rapidgen.rapid import format_source
    from rapidgen.system.paths import read_limited

    wrong: list[Diagnostic] = []
    changed = 0
    for path in _files(paths):
        before = read_limited(path)
        try:
            after = format_source(before, path=str(path))
        except DiagnosticError as fault:
            if any(d.severity is Severity.ERROR for d in fault.diagnostics):
                wrong += fault.diagnostics
            else:
                typer.echo(f"left {path}: {fault.diagnostics[0].message}", err=True)
            continue
        if after == before:
            continue
        changed += 1
        ends = _line_ends(before)
        if len(ends) > 1:
            displayed = ", ".join(f"{number} {name}" for name, number in ends)
            typer.echo(f"{path} mixes line ends ({displayed}): all become {ends[0][0]}", err=True)
        if diff:
            typer.echo(_difference(path, before, after), nl=False)
        elif check:
            typer.echo(f"would format {path}", err=True)
        else:
            write_whole(path, after)
            typer.echo(f"formatted {path}", err=True)
    if wrong:
        raise DiagnosticError(wrong, exit_code=1)
    return 1 if changed and (check or diff) else 0


def _line_ends(data: bytes) -> list[tuple[str, int]]:
    """Names and numbers of the line ends that a file has, the commonest first."""
    pairs, feeds, returns = data.count(b"\r\n"), data.count(b"\n"), data.count(b"\r")
    result = {"CRLF": pairs, "LF": feeds - pairs, "CR": returns - pairs}
    return sorted(((k, v) for k, v in result.items() if v), key=lambda pair: -pair[1])


def _files(paths: list[Path]) -> list[Path]:
    result: list[Path] = []
    for path in paths:
        if path.is_dir():
            inside = sorted(
                file
                for file in path.rglob("*")
                if file.suffix.lower() in _SUFFIXES and file.is_file()
            )
            if not inside:
                help = f"RAPID files end in {', '.join(sorted(_SUFFIXES))}"
                raise refusal("RG904", None, f"no RAPID file is in {path}", help)
            result += inside
        elif path.exists():
            result.append(path)
        else:
            raise refusal("RG904", None, f"there is no {path}", "name RAPID files or folders")
    return result


def _difference(path: Path, before: bytes, after: bytes) -> str:
    from difflib import unified_diff

    from rapidgen.rapid.syntax.lexer import decode

    old = [line + "\n" for line in decode(before)[0].splitlines()]
    new = [line + "\n" for line in decode(after)[0].splitlines()]
    return "".join(unified_diff(old, new, f"a/{path}", f"b/{path}"))
