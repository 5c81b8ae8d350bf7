"""Refusals by status and code of each generation, without effects.

Sources of the answers that differ between generations: the handlers name them.
"""

import re

import pytest
from served import Caller, make_application, make_runner

from rapidgen.wire.rws import media
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.codes import CODES

TASK, UNIT = "/rw/rapid/tasks/T_ROB1", "/rw/motionsystem/mechunits/ROB_1"
REASONS = {"E_REJECT": {-2}, "E_EXEC_STATE": {-508}, "E_UNEXPECTED": {-517}}
"""`icode` after the words; mostly -1, -517 if a symbol is missing."""
CFG, ELOG = "/rw/cfg/EIO/EIO_SIGNAL/instances", "/rw/elog"
SYMBOL_ONE, SYMBOL_TWO = "/rw/rapid/symbol/data/RAPID", "/rw/rapid/symbol/RAPID"

# The path of each generation, then status and code, of each where they differ.
READ = [
    (f"{UNIT}x", f"{UNIT}x", 404, "E_NO_SUCH_MECHUNIT"),
    (f"{UNIT}/robtarget?coordinate=moon", f"{UNIT}/robtarget?coordinate=moon", 400, "E_INVALIDARG"),
    (f"{UNIT}/robtarget?tool=nowhere", f"{UNIT}/robtarget?tool=nowhere", 400, "E_NO_SUCH_SYMBOL"),
    (f"{UNIT}/robtarget?tool=x", f"{UNIT}/robtarget?tool=x", 400, "E_INVALIDARG"),
    (f"{UNIT}/cartesian?wobj=x&coordinate=wobj", f"{UNIT}/cartesian?wobj=x&coordinate=wobj",
     400, "E_INVALIDARG"),
    ("/rw/motionsystem?resource=moon", "/rw/motionsystem?resource=moon", 400, "E_INVALIDARG"),
    ("/rw/iosystem/devices/none", "/rw/iosystem/devices/none", 404, "E_UNRESOLVED_URL"),
    ("/rw/iosystem/signals/none", "/rw/iosystem/signals/none", 404, "E_UNRESOLVED_URL"),
    ("/rw/iosystem/signals/a/diStart", "/rw/iosystem/signals/a/diStart", 404, "E_UNRESOLVED_URL"),
    ("/rw/iosystem/signals/Local/OTHER/diStart", "/rw/iosystem/signals/Local/OTHER/diStart",
     404, "E_UNRESOLVED_URL"),
    ("/rw/cfg/NONE", "/rw/cfg/NONE", (400, 404), "E_CFG_DOMAIN_INVALID"),
    (f"{CFG}/none", f"{CFG}/none", (400, 404), "E_CFG_INSTANCE_INVALID"),
    (f"{ELOG}/99", f"{ELOG}/99", 404, "E_UNRESOLVED_URL"),
    (f"{ELOG}/0/999999", f"{ELOG}/0/999999", 404, "E_UNRESOLVED_URL"),
    ("/rw/mastership/none", "/rw/mastership/none", 404, "E_UNRESOLVED_URL"),
    ("/ctrl/NONE", "/ctrl/$NONE", 404, "E_UNRESOLVED_URL"),
    ("/progress/9", "/progress/9", 404, "E_UNRESOLVED_URL"),
    ("/fileservice/$HOME/none", "/fileservice/$HOME/none", 404, ("E_FAIL", "E_DIR_NOT_EXIST")),
    ("/fileservice/none/a", "/fileservice/none/a", (404, 400), ("E_FAIL", "E_INVALID_PATH")),
    (f"{TASK}x", f"{TASK}x", (400, 404), "E_INVALIDARG"),
    ("/rw/rapid/modules/none?task=T_ROB1", f"{TASK}/modules/none", (400, 404), "E_NO_SUCH_SYMBOL"),
    (f"{SYMBOL_ONE}/T_ROB1/none", f"{SYMBOL_TWO}/T_ROB1/none/data",
     (400, 404), ("E_UNEXPECTED", "E_NO_SUCH_SYMBOL")),
    (f"{SYMBOL_ONE}/x", f"{SYMBOL_TWO}/x/data",
     (400, 404), ("E_UNEXPECTED", "E_NO_SUCH_SYMBOL")),
    (f"{SYMBOL_ONE}/T_ROB1/list%7B4%7D", f"{SYMBOL_TWO}/T_ROB1/list%7B4%7D/data",
     (400, 404), ("E_UNEXPECTED", "E_NO_SUCH_SYMBOL")),
    (f"{SYMBOL_ONE}/T_ROB1/list%7B1,1%7D", f"{SYMBOL_TWO}/T_ROB1/list%7B1,1%7D/data",
     (400, 404), ("E_UNEXPECTED", "E_NO_SUCH_SYMBOL")),
]  # fmt: skip

HOME = "/fileservice/$HOME"
WRITE = [
    ("/rw/panel/speedratio?action=setspeedratio", "/rw/panel/speedratio?action=setspeedratio",
     {"speed-ratio": "101"}, 400, "E_INVALIDARG"),
    ("/rw/rapid/execution?action=stop", "/rw/rapid/execution/stop",
     {"stopmode": "stop", "usetsp": "none"}, 400, "E_INVALIDARG"),
    ("/rw/rapid/execution?action=stop", "/rw/rapid/execution/stop",
     {"stopmode": "none"}, 400, "E_INVALIDARG"),
    ("/rw/cfg/EIO?action=saveas", "/rw/cfg/EIO/saveas", {"filepath": "HOME/a.cfg"},
     400, "E_INVALID_PATH"),
    ("/rw/cfg?action=load", "/rw/cfg/load",
     {"action-type": "add", "filepath": f"{HOME}/a.cfg"}, 400, "E_INVALID_PATH"),
    ("/rw/cfg?action=load", "/rw/cfg/load",
     {"action-type": "add", "filepath": "$HOME/a.cfg"}, (400, 404), "E_FILE_NOT_FOUND"),
    ("/rw/cfg?action=load", "/rw/cfg/load",
     {"action-type": "add", "filepath": "$HOME/none.pgf"}, 400, "E_CFG_DATA_INCORRECT"),
    ("/rw/elog?action=saveraw", "/rw/elog/saveraw", {"path": "HOME/log"}, 400, "E_INVALID_PATH"),
    ("/ctrl/backup?action=backup", "/ctrl/backup/create", {"backup": "HOME/b"},
     400, "E_INVALID_PATH"),
    ("/ctrl/backup?action=backup", "/ctrl/backup/create", {"backup": HOME}, 400, "E_DIR_EXIST"),
    ("/ctrl/backup?action=restore", "/ctrl/backup/restore", {"backup": "HOME/b"},
     400, "E_INVALID_PATH"),
    ("/ctrl/backup?action=restore", "/ctrl/backup/restore", {"backup": f"{HOME}/none"},
     400, "E_DIR_NOT_EXIST"),
    ("/rw/panel?action=restart", "/ctrl/restart", {"restart-mode": "istart"}, 403, "E_REJECT"),
    ("/rw/iosystem/signals/aoSpeed?action=set", "/rw/iosystem/signals/aoSpeed/set-value",
     {"lvalue": "1", "mode": "none"}, 400, "E_INVALIDARG"),
    ("/rw/iosystem/signals/aoSpeed?action=set", "/rw/iosystem/signals/aoSpeed/set-value",
     {"lvalue": "a"}, 400, "E_INVALIDARG"),
    ("/rw/iosystem/signals/doDefault?action=set", "/rw/iosystem/signals/doDefault/set-value",
     {"lvalue": "1"}, 403, "E_REJECT"),
    (f"{SYMBOL_ONE}/T_ROB1/c?action=set", f"{SYMBOL_TWO}/T_ROB1/c/data", {"value": "1"},
     403, "E_REJECT"),
    (f"{SYMBOL_ONE}/T_ROB1/x?action=set", f"{SYMBOL_TWO}/T_ROB1/x/data", {"value": "a"},
     400, "E_INVALIDARG"),
    ("/rw/rapid/symbol/data?action=validate", f"{SYMBOL_TWO}/T_ROB1/data?action=validate",
     {"task": "T_ROB1", "datatype": "none", "dattyp": "none", "value": "1"}, 400, "E_INVALIDARG"),
    (f"{TASK}/program?action=loadprog", f"{TASK}/program/load",
     {"progpath": "$HOME/nowhere.pgf"}, (400, 404), "E_FILE_NOT_FOUND"),
    (f"{TASK}/program?action=loadprog", f"{TASK}/program/load",
     {"progpath": "$HOME/lists.pgf"}, (400, 404), "E_FILE_NOT_FOUND"),
    (f"{TASK}/program?action=loadprog", f"{TASK}/program/load",
     {"progpath": "$HOME/none.pgf"}, 400, "E_INVALID_PROGRAMFILE"),
    (f"{TASK}/program?action=loadprog", f"{TASK}/program/load",
     {"progpath": "$HOME/empty.pgf"}, 400, "E_INVALID_PROGRAMFILE"),
    (f"{TASK}/program?action=loadprog", f"{TASK}/program/load",
     {"progpath": "$HOME/out.pgf"}, 400, "E_INVALID_PROGRAMFILE"),
    (f"{TASK}/program?action=loadprog", f"{TASK}/program/load",
     {"progpath": "$HOME/lists.pgf", "loadmode": "none"}, 400, "E_INVALIDARG"),
    (f"{TASK}/program?action=save", f"{TASK}/program/save", {"path": "$HOME/p", "name": "a/b"},
     400, "E_INVALID_PATH"),
    (f"{TASK}/program?action=save", f"{TASK}/program/save", {"path": "$HOME/no/p"},
     404, "E_DIR_NOT_EXIST"),
    (f"{TASK}/pcp?action=set-pp-routine", f"{TASK}/pcp/routine",
     {"module": "MainModule", "routine": "none", "userlevel": "FALSE"},
     400, "E_ILLEGAL_ENTRYPOINT"),
    ("/rw/dipc?action=dipc-create", "/rw/dipc",
     {"dipc-queue-name": "a/b", "dipc-queue-size": "2", "dipc-max-msg-size": "10"},
     400, "E_INVALIDARG"),
    ("/rw/dipc/RMQ_NONE?action=dipc-send", "/rw/dipc/RMQ_NONE",
     {"dipc-data": "num;1", "dipc-userdef": "1"}, 404, "E_INVALIDSLOTID"),
    (f"{HOME}/folder", f"{HOME}/create", {"fs-action": "create", "fs-newname": "a/b"},
     400, "E_INVALID_PATH"),
    (HOME, f"{HOME}/create", {"fs-action": "create", "fs-newname": "folder"}, 400, "E_DIR_EXIST"),
    (f"{HOME}/lists.pgf", f"{HOME}/lists.pgf/copy", {"fs-action": "copy", "fs-newname": "out.pgf"},
     403, "E_ALREADY_EXISTS"),
    (f"{HOME}/none", f"{HOME}/none/copy", {"fs-action": "copy", "fs-newname": "new"},
     404, ("E_FAIL", "E_DIR_NOT_EXIST")),
    (f"{HOME}/lists.pgf", f"{HOME}/lists.pgf/rename",
     {"fs-action": "rename", "fs-newname": "out.pgf"}, 403, "E_ALREADY_EXISTS"),
    (f"{HOME}/none", f"{HOME}/none/rename", {"fs-action": "rename", "fs-newname": "new"},
     404, ("E_FAIL", "E_DIR_NOT_EXIST")),
    ("/subscription", "/subscription", {"resources": "1", "1": "/rw/none", "1-p": "1"},
     400, "E_INVALIDARG"),
    ("/subscription", "/subscription", {"resources": "1", "1": "/rw/panel/opmode;none", "1-p": "1"},
     400, "E_INVALIDARG"),
    ("/subscription", "/subscription", {"resources": "1", "1": "/rw/panel/opmode", "1-p": "2"},
     400, "E_INVALIDARG"),
]  # fmt: skip


@pytest.fixture(scope="module", params=[Generation.ONE, Generation.TWO], ids=["one", "two"])
def caller(request, tmp_path_factory):
    """A session with every mastership, and program files in HOME that are none."""
    with make_runner(tmp_path_factory.mktemp("program"), request.param) as controller_runner:
        home = controller_runner.controller.files.path("HOME:")
        (home / "folder").mkdir()
        for name, text in (
            ("lists", "<Program><Module>gone.mod</Module></Program>"),
            ("none", "no program"),
            ("empty", "<Program></Program>"),
            ("out", "<Program><Module>../a.mod</Module></Program>"),
        ):
            (home / f"{name}.pgf").write_text(text)
        result = Caller(make_application(controller_runner, request.param))
        one = result.is_one
        for domain in ("rapid", "cfg", "motion") if one else ("edit", "motion"):
            path = f"/rw/mastership/{domain}{'?action=request' if one else '/request'}"
            assert result.post(path) == 204
        yield result


def state_of(caller):
    """State that a request could have changed."""
    controller = caller.application.controller
    home = controller.files.path("HOME:")
    return (
        sorted(str(path) for path in home.rglob("*")),
        controller.tasks["T_ROB1"]["x"],
        [signal.value for signal in controller.io.signals.values()],
        [module.name for module in caller.application.runner.programs.modules(
            controller.rapid_tasks["T_ROB1"])],
        caller.application.runner.cfg,
        len(caller.get("/subscription")),
    )  # fmt: skip


def refused(caller, method, path, form, status, code):
    # RobotWare 6 takes twenty requests a second.
    caller.application.runner.controller.run_for(1.0)
    before = state_of(caller)
    reply = caller.send(method, path, form)
    fault = media.read(reply.body, reply.header("content-type")).fault
    assert (reply.status, fault.code) == (status, CODES[code])
    text = re.fullmatch(r"rapidgen\[1\] .*\S code:(-?\d+) icode:(-\d+)", fault.message)
    assert (int(text[1]), int(text[2]) in REASONS.get(code, {-1, -517})) == (fault.code, True)
    assert state_of(caller) == before


def own(caller, *values):
    """Of pairs what the caller's generation has."""
    return [v[0 if caller.is_one else 1] if isinstance(v, tuple) else v for v in values]


@pytest.mark.parametrize(("one", "two", "status", "code"), READ)
def test_what_is_not_there_is_not_read(caller, one, two, status, code):
    path, *wanted = own(caller, (one, two), status, code)
    refused(caller, "GET", path, None, *wanted)


@pytest.mark.parametrize(("one", "two", "form", "status", "code"), WRITE)
def test_what_does_not_fit_is_not_written(caller, one, two, form, status, code):
    path, *wanted = own(caller, (one, two), status, code)
    refused(caller, "POST", path, form, *wanted)


@pytest.mark.parametrize(
    ("method", "path"),
    [
        ("GET", f"{TASK}/modules/MainModule/text/search?text="),
        ("POST", "/rw/panel/speedratio"),
    ],
)
def test_what_rws_2_alone_has(two, method, path):
    refused(two, method, path, {"speed-ratio": "50"}, 400, "E_INVALIDARG")
