import sys
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from in_process import PASSWORD, Line, connect, pass_time

from rapidgen.config import load_config
from rapidgen.controller.runner import ControllerRunner
from rapidgen.deploy import apply, make_plan
from rapidgen.deploy.command_run import desired_set
from rapidgen.deploy.online.apply import OnlineOptions
from rapidgen.servers.rws.messages import HttpResponse
from rapidgen.system import read_files, write_cfg
from rapidgen.system.base import Robot, base_system
from rapidgen.wire.rws.bodies import Generation

MAIN = """MODULE MainModule
    PERS num x := 1;
    PROC main()
        x := x + 1;
        WaitTime 0.1;
    ENDPROC
ENDMODULE
"""
RELEASES = {Generation.ONE: (6, 15), Generation.TWO: (7, 6), Generation.EIGHT: (7, 6)}


def empty_runner(folder, generation, **options):
    """T_ROB1 with a MainModule that has `main`, and no driver."""
    path = folder / "MainModule.mod"
    path.write_text(MAIN)
    system = replace(read_files([path]), robotware=RELEASES[generation], name="cell")
    cfg = base_system(system.robotware, [Robot("T_ROB1", "ROB_1")])
    chosen = {"robots": load_config("irb120").groups, "autostart": False, **options}
    return ControllerRunner(replace(system, cfg=cfg), **chosen)


def overrides_of(generation):
    """Overrides of an irb120 for a controller of this generation."""
    major, minor = RELEASES[generation]
    ware = f"controller.robotware={major}.{minor:02d}"
    return [ware, "controller.type=omnicore"] if major > 6 else [ware]


@cache
def build(generation, *overrides):
    """The driver of an irb120."""
    return desired_set("irb120", [*overrides_of(generation), *overrides])


def model(generation):
    """Its configuration."""
    return load_config("irb120", overrides=tuple(overrides_of(generation)))


def home_of(controller_runner):
    """All files of HOME."""
    root = controller_runner.controller.files.path("HOME:")
    return {p.relative_to(root).as_posix(): p.read_bytes() for p in root.rglob("*") if p.is_file()}


def cfg_of(controller_runner):
    """The whole database as text."""
    texts = sorted(controller_runner.cfg.domains, key=lambda text: text.domain)
    return [write_cfg(text) for text in texts]


def run(transport, wanted, verb="deploy", *, overwrite=True, message=None, restart=True, **live):
    """Plan and carry out; the plan."""
    plan = make_plan(transport, wanted, verb=verb)
    say = (message if message is not None else []).append
    apply(transport, plan, overwrite=overwrite, live=OnlineOptions(restart, **live), say=say)
    return plan


class Kit:
    """The functions above, for tests."""

    empty_runner = staticmethod(empty_runner)
    build = staticmethod(build)
    model = staticmethod(model)
    home_of = staticmethod(home_of)
    cfg_of = staticmethod(cfg_of)
    run = staticmethod(run)
    connect = staticmethod(connect)
    Line = Line
    PASSWORD = PASSWORD
    busy = HttpResponse(503)
    apply = staticmethod(apply)
    pass_time = staticmethod(pass_time)


@pytest.fixture(scope="session")
def rws():
    return Kit


@pytest.fixture(params=list(Generation), ids=lambda g: f"rws{g.value}")
def generation(request):
    return request.param
