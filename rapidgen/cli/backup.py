"""`rapidgen backup`: a backup of a controller, over Robot Web Services."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.cli import options
from rapidgen.diagnostics import refusal

if TYPE_CHECKING:
    from rapidgen.client.rws import Controller


def backup(
    host: options.WebServices,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="New folder here.", metavar="FOLDER")
    ],
    keep: Annotated[
        bool, typer.Option("--keep", help="Leave the backup on the controller, too.")
    ] = False,
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
) -> int:
    """Bring a backup of a controller here, which `sim` reads.

    The controller makes it; it is fetched file by file and taken off the controller again.
    """
    import shutil
    from datetime import datetime

    from rapidgen.cli.rws_session import controller

    if output.exists():
        raise refusal("RG660", None, f"{output} is there already", "name a folder that is not")
    with controller(host, user, secrets, fingerprint) as result:
        place = result.backup(f"rapidgen_{datetime.now():%Y%m%d_%H%M%S}")
        # Whole or not at all: a backup that was cut is none.
        part = output.with_name(f"{output.name}.part")
        part.mkdir(parents=True)
        try:
            count = _fetch(result, place, part)
            part.rename(output)
        finally:
            shutil.rmtree(part, ignore_errors=True)
        if not keep:
            result.delete_file(place)
    typer.echo(f"{output}: {count} files")
    return 0


def _fetch(result: "Controller", place: str, folder: Path) -> int:
    """Files below a place, into a folder; how many. Names that lead elsewhere are refused."""
    count = 0
    for entry in result.list_files(place):
        if Path(entry.name).name != entry.name or entry.name in ("", ".", ".."):
            raise refusal("RG653", None, f"the controller lists a file named {entry.name!r}")
        if entry.is_folder:
            (folder / entry.name).mkdir()
            count += _fetch(result, f"{place}/{entry.name}", folder / entry.name)
        else:
            (folder / entry.name).write_bytes(result.read_file(f"{place}/{entry.name}"))
            count += 1
    return count
