"""Robots and controllers at the address that the documentation writes, for its commands.

ABB's service port has 192.168.125.1. Here an address of loopback that is this process's own stands
for it, with the ports that a configuration has, whatever runs beside.
"""

import os
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace

from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.controller.runner import ControllerRunner
from rapidgen.servers.rws.server import KNOWN, serve_rws
from rapidgen.system import read_files
from rapidgen.system.base import Robot, base_system
from rapidgen.wire.rws.bodies import Generation

WRITTEN = "192.168.125.1"
HOST = f"127.{os.getpid() >> 16 & 63 | 64}.{os.getpid() >> 8 & 255}.{os.getpid() & 255}"
PASSWORD = KNOWN
# What stands there, by page: a controller without a driver, or a driver that runs.
EMPTY = {
    "deploy-web-services.md": ("irb120", Generation.ONE, (6, 15)),
    "omnicore.md": ("crb15000", Generation.TWO, (7, 6)),
    "web-services.md": ("irb120", Generation.ONE, (6, 15)),
}
RUNNING = {"view.md": "irb120"}
USER = "MODULE user(SYSMODULE)\nENDMODULE\n"


@contextmanager
def standing(page, folder) -> Iterator[dict[str, str]]:
    """What a page's texts are to be replaced by, longest first, while it is there."""
    with ExitStack() as stack:
        if page in RUNNING:
            controller = stack.enter_context(
                VirtualController.from_config(RUNNING[page], clock="real", host=HOST)
            )
            controller.start()
            controller.address(timeout=60)
        services = _empty(stack, folder, *EMPTY[page]) if page in EMPTY else HOST
        yield {f"rwss://{WRITTEN}": services, f"rws://{WRITTEN}": services, WRITTEN: HOST}


def _empty(stack, folder, model, generation, release) -> str:
    """As from the box, with the module `user` alone, and Robot Web Services; their URL."""
    path = folder / "user.sys"
    path.write_text(USER)
    system = replace(read_files([path]), robotware=release, name="cell")
    path.unlink()
    cfg = base_system(release, [Robot("T_ROB1", "ROB_1")])
    robots = load_config(model).groups
    options = {"autostart": False, "entry_needed": False, "clock": "real", "host": HOST}
    runner = stack.enter_context(
        ControllerRunner(replace(system, cfg=cfg), robots=robots, **options)
    )
    runner.start()
    service = serve_rws(runner, generation, HOST)
    stack.callback(service.close)
    return f"{'rws' if generation is Generation.ONE else 'rwss'}://{HOST}:{service.port}"
