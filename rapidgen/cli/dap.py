"""The command `dap`: a debug adapter for editors."""

from contextlib import contextmanager
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rapidgen.controller.boot_targets import Bootable
    from rapidgen.controller.runner import ControllerRunner
    from rapidgen.dap.launch import Launch


def dap(
    tcp: Annotated[
        int | None,
        typer.Option(
            help="Loopback port to listen on; 0: any free port.", min=0, max=65_535, metavar="PORT"
        ),
    ] = None,
) -> None:
    """Debug RAPID in an editor: a debug adapter on stdio.

    Editors start it themselves. It speaks the Debug Adapter Protocol on stdin and stdout, or with
    --tcp on a port of this computer, for one client after another until Ctrl-C.
    """
    from rapidgen._message_streams import listening, standard_stream
    from rapidgen.dap.adapter import Adapter
    from rapidgen.diagnostics import refusal

    if tcp is None:
        with standard_stream() as stream:
            Adapter(stream, _load, _page).run()
        return
    try:
        with listening(tcp) as (port, clients):
            typer.echo(f"listening on 127.0.0.1:{port}", err=True)
            for stream in clients:
                Adapter(stream, _load, _page).run()
    except OSError as fault:
        help = "name another port, or 0 for any free one"
        message = f"cannot listen on 127.0.0.1:{tcp}: {fault.strerror or fault}"
        raise refusal("RG941", None, message, help, exit_code=1) from fault


def _load(launch: "Launch") -> "Bootable":
    from rapidgen.cli.boot_options import load_boot_target

    return load_boot_target(
        launch.targets,
        tasks=[f"{task}={','.join(files)}" for task, files in launch.tasks.items()],
        robot=launch.robot,
        robotware=launch.robotware,
        entry=launch.entry,
        cell=launch.cell,
        start=launch.start,
        backup=launch.backup,
        overrides=launch.overrides,
        check=launch.check,
    )


@contextmanager
def _page(runner: "ControllerRunner", target: "Bootable") -> "Iterator[str]":
    """Serve the page that shows the robot; yield its address."""
    from rapidgen.viewer.appearance import appearance
    from rapidgen.viewer.server import serve_page
    from rapidgen.viewer.simulator.simulation import Simulation

    look = appearance(target.groups, target.described, target.overrides, target.cell)
    page = serve_page(Simulation(runner, look), "127.0.0.1", 0, look.files)
    runner.on_boot.append(page.renew)
    try:
        yield page.url
    finally:
        page.close()
