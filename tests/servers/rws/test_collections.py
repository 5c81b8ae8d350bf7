"""Which answers of RWS 2.0 are collections: in HAL they are embedded as `resources`, others as
`state` [VC 7.21]."""

import pytest
from served import Caller, make_application, make_runner

from rapidgen.wire.rws import media
from rapidgen.wire.rws.bodies import Generation

TASK, UNITS = "/rw/rapid/tasks/T_ROB1", "/rw/motionsystem/mechunits"
COLLECTIONS = (
    "/uas/grants", "/uas/user/grants", "/rw/retcode", "/rw/mastership", "/rw/elog", "/rw/elog/0",
    "/rw/system/options", "/rw/system/products", f"{TASK}/modules/MainModule/text/search?text=x",
    "/subscription", "/rw/iosystem/networks", "/rw/iosystem/devices", "/rw/iosystem/signals",
    "/fileservice", "/fileservice/$HOME", "/rw/cfg", "/rw/cfg/EIO",
    "/rw/cfg/EIO/EIO_SIGNAL/attributes", "/rw/cfg/EIO/EIO_SIGNAL/instances", UNITS, "/rw/dipc",
    "/rw/rapid/tasks", "/rw/rapid/taskselection",
)  # fmt: skip
SINGLE = (
    "/rw/mastership/edit", "/rw/panel", "/rw/panel/ctrl-state", "/rw/panel/opmode",
    "/rw/rapid/execution", TASK, f"{TASK}/modules", f"{TASK}/modules/MainModule", f"{TASK}/pcp",
    f"{TASK}/motion", f"{TASK}/program", f"{UNITS}/ROB_1", f"{UNITS}/ROB_1/axes/1",
    f"{UNITS}/ROB_1/robtarget", "/rw/iosystem/signals/diStart", "/rw/iosystem/devices/DRV_1",
    "/rw/system", "/rw/system/robottype", "/rw/system/energy", "/ctrl", "/ctrl/identity",
    "/ctrl/clock", "/users/rmmp", "/rw/rapid/symbol/RAPID/T_ROB1/x/data",
)  # fmt: skip


@pytest.fixture(scope="module")
def two(tmp_path_factory):
    with make_runner(tmp_path_factory.mktemp("program"), Generation.TWO) as controller_runner:
        yield Caller(make_application(controller_runner, Generation.TWO))


@pytest.mark.parametrize(
    ("path", "is_one"),
    [*((path, True) for path in COLLECTIONS), *((path, False) for path in SINGLE)],
)
def test_what_is_many_is_a_collection(two, path, is_one):
    two.application.runner.controller.run_for(1.0)
    reply = two.send("GET", path)
    assert reply.status == 200
    assert media.read(reply.body, reply.header("content-type")).collection is is_one
