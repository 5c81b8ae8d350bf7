"""`rapidgen view`: a recording in the browser."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from rapidgen.view.recording.reader import RecordingFile


def view(
    file: Annotated[Path, typer.Argument(help="What `rapidgen sim --record` has written.")],
    port: Annotated[
        int, typer.Option(help="Port of the page; 0: any free port.", min=0, max=65_535)
    ] = 0,
    csv: Annotated[
        Path | None, typer.Option(help="Write the positions of a robot, and no page.")
    ] = None,
    robot: Annotated[str, typer.Option(help="Whose, with --csv; default: the first.")] = "",
) -> int:
    """Look at a recording: everything as it was at any moment.

    Prints the link of a page that this process serves until Ctrl-C. A recording that was cut off is
    shown up to there.
    """
    from rapidgen.view.recording.reader import RecordingFile

    with RecordingFile(file) as recording:
        if csv is not None:
            try:
                recording.write_csv(csv, robot)
            except KeyError as error:
                known = ", ".join(group.name for group in recording.robots)
                raise typer.BadParameter(f"--robot is one of {known}") from error
            typer.echo(csv)
            return 0
        return _serve(recording, port)


def _serve(recording: "RecordingFile", port: int) -> int:
    import signal
    import threading

    from rapidgen.view.recording.viewing import RecordingSubject
    from rapidgen.view.server import serve_page

    ended = threading.Event()
    before = {s: signal.signal(s, lambda *_: ended.set()) for s in (signal.SIGINT, signal.SIGTERM)}
    page = serve_page(RecordingSubject(recording), "127.0.0.1", port)
    try:
        typer.echo(page.url)
        ended.wait()
    finally:
        page.close()
        for number, handler in before.items():
            signal.signal(number, handler)
    return 0
