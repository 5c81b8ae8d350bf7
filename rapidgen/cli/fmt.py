"""The command `fmt`: format RAPID sources."""

from pathlib import Path
from typing import Annotated

import typer

from rapidgen.cli.project import FileEncoding, project_folders
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, Span, refusal

_SUFFIXES = (".mod", ".modx", ".sys", ".sysx", ".prg")


def fmt(
    paths: Annotated[
        list[Path] | None,
        typer.Argument(
            help="RAPID files or folders; default: those of the project file.", metavar="PATH"
        ),
    ] = None,
    check: Annotated[
        bool, typer.Option("--check", help="Do not write; exit with 1 if a file would change.")
    ] = False,
    diff: Annotated[bool, typer.Option("--diff", help="Do not write; show the changes.")] = False,
    encoding: Annotated[
        FileEncoding | None,
        typer.Option(help="Encoding of files that are not UTF-8; default: Latin-1."),
    ] = None,
    to_utf_8: Annotated[
        bool, typer.Option("--to-utf-8", help="Write UTF-8 without byte order mark.")
    ] = False,
) -> int:
    """Format RAPID source files.

    Writes keywords in upper case and indents by four spaces; comments stay. The encoding and the
    line ends stay, unless a file mixes line ends: it gets the most frequent one, with a message.
    Files with syntax errors are not changed. Without a path: the folders of rapidgen.toml.
    """
    from rapidgen._atomic_write import write_whole
    from rapidgen.system.paths import read_limited

    wrong: list[Diagnostic] = []
    changed = 0
    paths = paths or list(project_folders("format", "name RAPID files or folders"))
    for path in _files_to_format(paths):
        before = read_limited(path)
        try:
            after, is_like = _formatted(path, before, encoding, to_utf_8=to_utf_8)
        except DiagnosticError as fault:
            if any(d.severity is Severity.ERROR for d in fault.diagnostics):
                wrong += fault.diagnostics
            else:
                typer.echo(f"skipped {path}: {fault.diagnostics[0].message}", err=True)
            continue
        if after == before:
            continue
        changed += 1
        ends = _line_ends(before)
        if len(ends) > 1:
            displayed = ", ".join(f"{number} {name}" for name, number in ends)
            typer.echo(
                f"{path} mixes line ends ({displayed}): all changed to {ends[0][0]}", err=True
            )
        if diff:
            typer.echo(_difference(path, before, after, is_like), nl=False)
        elif check:
            typer.echo(f"would format {path}", err=True)
        else:
            write_whole(path, after)
            typer.echo(f"formatted {path}", err=True)
    if wrong:
        raise DiagnosticError(wrong, exit_code=1)
    return 1 if changed and (check or diff) else 0


def _line_ends(data: bytes) -> list[tuple[str, int]]:
    """Count the line ends of a file; the most frequent is first."""
    pairs, feeds, returns = data.count(b"\r\n"), data.count(b"\n"), data.count(b"\r")
    result = {"CRLF": pairs, "LF": feeds - pairs, "CR": returns - pairs}
    return sorted(((k, v) for k, v in result.items() if v), key=lambda pair: -pair[1])


def _files_to_format(paths: list[Path]) -> list[Path]:
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
                raise refusal("RG904", None, f"no RAPID file in {path}", help)
            result += inside
        elif path.exists():
            result.append(path)
        else:
            raise refusal("RG904", None, f"{path} does not exist", "use RAPID files or folders")
    return result


def _formatted(
    path: Path, before: bytes, encoding: FileEncoding | None, *, to_utf_8: bool
) -> tuple[bytes, str]:
    """Return a formatted file, and the encoding that it had.

    Raises DiagnosticError for a text that cannot be formatted, or is in another encoding.
    """
    from rapidgen.rapid import format_source
    from rapidgen.rapid.syntax.lexer import decode
    from rapidgen.rapid.syntax.text import refuse

    text, known = decode(before)
    if known != "latin-1" or refuse(before, str(path)) is not None:
        after = format_source(before, path=str(path))
        return (decode(after)[0].encode() if to_utf_8 else after), known
    if encoding is None and to_utf_8:
        from rapidgen.editor.documents import probable_encoding

        # A wrong encoding gives wrong letters without any error: it is not guessed.
        help = f"name it, such as `--encoding {probable_encoding(before)}`"
        raise refusal("RG339", Span(str(path), 1, 1), "the encoding of the file is unknown", help)
    own = str(encoding or known)
    try:
        text = before.decode(own)
    except UnicodeDecodeError as fault:
        line = before.count(b"\n", 0, fault.start) + 1
        raise refusal(
            "RG339", Span(str(path), line, 1), f"the file is not {own}", "name another `--encoding`"
        ) from fault
    return format_source(text, path=str(path)).encode("utf-8" if to_utf_8 else own), own


def _difference(path: Path, before: bytes, after: bytes, encoding: str) -> str:
    from difflib import unified_diff

    from rapidgen.rapid.syntax.lexer import decode

    def text(data: bytes) -> str:
        own, known = decode(data)
        return data.decode(encoding) if known == "latin-1" else own

    old = [line + "\n" for line in text(before).splitlines()]
    new = [line + "\n" for line in text(after).splitlines()]
    return "".join(unified_diff(old, new, f"a/{path}", f"b/{path}"))
