"""A success is true: it shows in the running task, in a backup, after a restart."""

from dataclasses import replace

import pytest
from served import STARTED, Caller, code_of, make_application, make_runner

from rapidgen.config import load_config
from rapidgen.controller.runner import ControllerRunner
from rapidgen.system import read_backup, read_files
from rapidgen.wire.rws import media
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.codes import CODES

BACK = b"""MODULE Back
    PERS num k := 0;
    PROC main()
        WHILE TRUE DO
            k := k + 1;
            WaitTime 1;
        ENDWHILE
    ENDPROC
ENDMODULE
"""
TASK = """SYS:CFG_1.0:{0}:0::
#
CAB_TASKS:

      -Name "T_BACK" -Type "SEMISTATIC" -Entry "main"
#
CAB_TASK_MODULES:

      -File "HOME:/{1}.mod" -ModName "Back" -Task "T_BACK"
"""
SIGNAL = 'EIO:CFG_1.0::\n#\nEIO_SIGNAL:\n\n      -Name "doNew" -SignalType "DO" -Access "All"\n'


def restart(caller):
    """A warm start on the virtual clock; a new session of the same application."""
    one = caller.application.generation is Generation.ONE
    target = "/rw/panel?action=restart" if one else "/ctrl/restart?mastership=implicit"
    if one:
        caller.post("/rw/mastership/cfg?action=request")
    assert caller.post(target, {"restart-mode": "restart"}) == 204
    controller_runner = caller.application.runner
    before = controller_runner.restarts
    controller_runner.run(lambda: controller_runner.restarts > before)
    assert caller.send("GET", "/rw/panel/opmode").status == 401
    controller_runner.controller.run_for(1.1)
    return Caller(caller.application)


def put(caller, path, data):
    dollar = "$" if caller.application.generation is Generation.ONE else ""
    kind = None if dollar else "text/plain;v=2.0"
    reply = caller.send("PUT", f"/fileservice/{dollar}{path}", body=data, content_type=kind)
    assert reply.status in (200, 201)


def test_what_is_written_is_what_the_running_task_sees(one):
    controller = one.application.controller
    assert one.post("/rw/rapid/execution?action=start", STARTED) == 204
    controller.run_for(1.0)
    first = controller.tasks["T_ROB1"]["MainModule:count"]
    assert first == pytest.approx(10, abs=1)
    path = "/rw/rapid/symbol/data/RAPID/T_ROB1/MainModule"
    assert one.post(f"{path}/x?action=set", {"value": "100"}) == 204
    controller.run_for(1.0)
    assert controller.tasks["T_ROB1"]["MainModule:count"] > first + 900
    assert one.post(f"{path}/list%7B2%7D?action=set", {"value": "7"}) == 204
    assert one.get(f"{path}/list?json=1")[0].text("value") == "[1,7,3]"
    assert one.get(f"{path}/list%7B2%7D;value?json=1")[0].text("value") == "7"
    for bad, value in (("list", "[1,2]"), ("x", "TRUE"), ("name", "a"), ("list%7B4%7D", "1")):
        assert one.post(f"{path}/{bad}?action=set", {"value": value}) == 400
    assert one.post(f"{path}/c?action=set", {"value": "5"}) == 403
    assert one.get(f"{path}/list?json=1")[0].text("value") == "[1,7,3]"


def test_signals_have_names_with_blanks_and_semicolons_and_levels_of_access(one):
    controller = one.application.controller
    assert one.post("/rw/iosystem/signals/do%20x%3B1?action=set", {"lvalue": "1"}) == 204
    assert controller.signals["do x;1"] == 1
    refused = one.send("POST", "/rw/iosystem/signals/doDefault?action=set", {"lvalue": "1"})
    assert (refused.status, code_of(refused)) == (403, CODES["E_REJECT"])
    assert one.post("/rw/iosystem/signals/Local/DRV_1/diStart?action=set", {"lvalue": "1"}) == 204
    assert one.post("/rw/iosystem/signals/aoSpeed?action=set", {"lvalue": "2.5"}) == 204
    assert [s.text("lvalue") for s in one.get("/rw/iosystem/signals")] == ["1", "0", "1", "2.5"]
    assert one.post("/rw/iosystem/signals/diStart?action=set", {"lvalue": "2"}) == 400
    assert one.send("GET", "/rw/iosystem/signals/none").status == 404


def test_motors_speed_and_stops_are_those_of_the_controller(two):
    controller = two.application.controller
    assert two.post("/rw/panel/ctrl-state", {"ctrl-state": "motoroff"}) == 204
    assert not controller.motors_on
    assert two.post("/rw/rapid/execution/start", STARTED) == 204  # and it does not run
    assert two.get("/rw/rapid/execution")[0].text("ctrlexecstate") == "stopped"
    assert two.post("/rw/panel/ctrl-state", {"ctrl-state": "motoron"}) == 204
    speed = "/rw/panel/speedratio?action=setspeedratio&mastership=implicit"
    assert two.post(speed, {"speed-ratio": "25"}) == 204
    assert {group.override for group in controller.motion.groups.values()} == {0.25}
    assert two.post("/rw/rapid/execution/start", STARTED) == 204
    assert controller.tasks["T_ROB1"].state == "running"
    assert two.post("/rw/rapid/execution/stop", {"stopmode": "stop", "usetsp": "alltsk"}) == 204
    assert controller.tasks["T_ROB1"].state == "stopped"


def test_a_module_is_loaded_replaced_and_taken_out(one):
    tasks = "/rw/rapid/tasks/T_ROB1"
    put(one, "HOME/a.mod", b"MODULE Helper\n    PERS num h := 5;\nENDMODULE\n")
    form = {"modulepath": "$HOME/a.mod", "replace": "false"}
    assert one.post(f"{tasks}?action=loadmod", form) == 403  # mastership
    one.post("/rw/mastership/rapid?action=request")
    assert one.post(f"{tasks}?action=loadmod", form) == 204
    assert one.get("/rw/rapid/symbol/data/RAPID/T_ROB1/Helper/h?json=1")[0].text("value") == "5"
    assert one.post(f"{tasks}?action=loadmod", form) == 400
    put(one, "HOME/a.mod", b"MODULE Helper\n    PERS num h := 6;\nENDMODULE\n")
    assert one.post(f"{tasks}?action=loadmod", {**form, "replace": "true"}) == 204
    assert one.get("/rw/rapid/symbol/data/RAPID/T_ROB1/h?json=1")[0].text("value") == "6"
    one.application.controller.run_for(1.1)
    names = [i.text("name") for i in one.get("/rw/rapid/modules?task=T_ROB1")]
    assert names == ["MainModule", "Helper"]
    one.application.controller.start_program()
    running = one.send("POST", f"{tasks}?action=unloadmod", {"module": "Helper"})
    assert (running.status, code_of(running)) == (400, CODES["E_EXEC_STATE"])
    one.application.controller.stop_program()
    assert one.post(f"{tasks}?action=unloadmod", {"module": "Helper"}) == 204
    assert one.post(f"{tasks}?action=unloadmod", {"module": "Helper"}) == 400


def test_load_broken_module_reports_build_errors_on_request(two):
    put(two, "HOME/a.mod", b"MODULE Bad\n    PROC p()\n        x := ;\n    ENDPROC\nENDMODULE\n")
    load = "/rw/rapid/tasks/T_ROB1/loadmod?mastership=implicit"
    assert two.post(load, {"modulepath": "HOME/a.mod"}) == 200
    fault = two.get("/rw/rapid/tasks/T_ROB1/program/builderror")[0]
    assert (fault.text("ModuleName"), fault.text("row")) == ("Bad", "3")
    pp = two.send("POST", "/rw/rapid/execution/resetpp?mastership=implicit")
    assert (pp.status, code_of(pp)) == (403, CODES["E_RAPID_SYNTAX_ERROR"])
    assert two.post("/rw/rapid/execution/start", STARTED) == 403
    # A second main: reported at PP to main, as on a controller.
    put(two, "HOME/b.mod", b"MODULE Two\n    PROC main()\n    ENDPROC\nENDMODULE\n")
    unload = "/rw/rapid/tasks/T_ROB1/unloadmod?mastership=implicit"
    assert two.post(unload, {"module": "Bad"}) == 204
    assert two.post(load, {"modulepath": "HOME/b.mod"}) == 200
    pp = two.send("POST", "/rw/rapid/execution/resetpp?mastership=implicit")
    assert (pp.status, code_of(pp)) == (403, CODES["E_RAPID_SEMANTIC_ERROR"])
    assert two.post(unload, {"module": "Two"}) == 204
    assert two.post("/rw/rapid/execution/resetpp?mastership=implicit") == 204


@pytest.mark.parametrize("generation", [Generation.ONE, Generation.TWO])
def test_cfg_counts_after_a_restart_which_keeps_persistents(tmp_path, generation):
    with make_runner(tmp_path, generation) as controller_runner:
        caller = Caller(make_application(controller_runner, generation))
        one = generation is Generation.ONE
        put(caller, "HOME/Back.mod", BACK)
        put(caller, "TEMP/a.cfg", TASK.format(6 if one else 7, "Back").encode())
        form = {"filepath": f"{'$' if one else ''}TEMP/a.cfg", "action-type": "add"}
        load = "/rw/cfg?action=load" if one else "/rw/cfg/load?mastership=implicit"
        if one:
            caller.post("/rw/mastership/cfg?action=request")
        reply = caller.send("POST", load, form)
        assert reply.status == (204 if one else 202)
        controller_runner.controller.tasks["T_ROB1"]["MainModule:x"] = 42
        controller_runner.controller.motion.group("rob1").jump((0.1, 0.2, 0, 0, 0.3, 0))
        assert list(controller_runner.controller.tasks) == ["T_ROB1"]
        again = caller.send("POST", load, form)
        if one:
            assert (again.status, code_of(again)) == (400, CODES["E_CFG_NAME_EXIST"])
        else:
            notify = caller.get(again.header("location"))[0]
            assert notify.text("code") == str(CODES["E_CFG_NAME_EXIST"])
        caller = restart(caller)
        controller = controller_runner.controller
        assert {t.name: t.state for t in controller.tasks.values()} == {
            "T_ROB1": "ready",
            "T_BACK": "running",
        }
        assert controller.tasks["T_ROB1"]["MainModule:x"] == 42
        assert controller.motion.group("rob1").positions() == (0.1, 0.2, 0, 0, 0.3, 0)
        assert not controller.motors_on
        assert not controller.failed
        controller.run_for(3)
        assert controller.tasks["T_BACK"]["Back:k"] >= 3


def test_missing_module_is_sysfail_until_restart(one):
    controller_runner = one.application.runner
    put(one, "TEMP/a.cfg", TASK.format(6, "Back").encode())
    one.post("/rw/mastership/cfg?action=request")
    load = {"filepath": "$TEMP/a.cfg", "action-type": "add"}
    assert one.post("/rw/cfg?action=load", load) == 204
    one.post("/rw/mastership/cfg?action=release")
    caller = restart(one)
    assert caller.get("/rw/panel/ctrlstate")[0].text("ctrlstate") == "sysfail"
    titles = [e.text("title") for e in caller.get("/rw/elog/0?lang=en&json=1")]
    assert {"System failure", "Module not loaded"} <= set(titles)
    assert caller.post("/rw/panel/ctrlstate?action=setctrlstate", {"ctrl-state": "motoron"}) == 403
    put(caller, "HOME/Back.mod", BACK.replace(b"k + 1", b"k + "))
    caller = restart(caller)
    assert controller_runner.controller.failed
    assert any(e.text("code") == "40160" for e in caller.get("/rw/elog/0?lang=en"))
    put(caller, "HOME/Back.mod", BACK)
    caller = restart(caller)
    assert not controller_runner.controller.failed
    assert controller_runner.controller.tasks["T_BACK"].state == "running"


def test_single_instances_are_made_changed_and_deleted(two):
    instances = "/rw/cfg/EIO/EIO_SIGNAL/instances"
    edit = "?mastership=implicit"
    assert two.post(f"{instances}/create-default{edit}", {"name": "doNew"}) == 201
    assert two.post(f"{instances}/create-default{edit}", {"name": "doNew"}) == 400
    raw = two.send("POST", f"{instances}/doNew{edit}", body=b"SignalType=[DO,1]&Access=[All,1]")
    assert raw.status == 204
    assert two.post(f"{instances}/doNew{edit}", {"Access": "All"}) == 400
    notify = two.get(f"{instances}/doNew")[0]
    values = {i.title: i.text("value") for i in notify.within}
    assert (values["Name"], values["SignalType"], values["Access"]) == ("doNew", "DO", "All")
    # Attributes that are left out have their defaults.
    assert (values["SafeLevel"], values["Default"]) == ("DefaultSafeLevel", "0")
    assert two.application.controller.io.get("doNew") is None
    caller = restart(two)
    assert caller.post("/rw/iosystem/signals/doNew/set-value", {"lvalue": "1"}) == 204
    assert caller.send("DELETE", f"{instances}/doNew{edit}").status == 204
    assert caller.send("GET", f"{instances}/doNew").status == 404
    caller = restart(caller)
    assert caller.send("GET", "/rw/iosystem/signals/doNew").status == 404


def test_add_with_reset_wipes_a_domain_and_replace_only_what_has_the_name(one):
    one.post("/rw/mastership/cfg?action=request")
    put(one, "TEMP/e.cfg", SIGNAL.encode())
    form = {"filepath": "$TEMP/e.cfg", "action-type": "add"}
    assert one.post("/rw/cfg?action=load", form) == 204
    assert one.post("/rw/cfg?action=load", {**form, "action-type": "replace"}) == 204
    names = [i.title for i in one.get("/rw/cfg/EIO/EIO_SIGNAL/instances")]
    assert names == ["do x;1", "doDefault", "diStart", "aoSpeed", "doNew"]
    assert one.post("/rw/cfg?action=load", {**form, "action-type": "add-with-reset"}) == 204
    assert [i.title for i in one.get("/rw/cfg/EIO/EIO_SIGNAL/instances")] == ["doNew"]
    for bad in ("/fileservice/$TEMP/e.cfg", "$TEMP/none.cfg", "$HOME/../e.cfg"):
        assert one.post("/rw/cfg?action=load", {**form, "filepath": bad}) == 400


def test_a_backup_holds_what_the_controller_is_and_boots(one):
    controller = one.application.controller
    put(one, "HOME/notes.txt", b"n")
    controller.tasks["T_ROB1"]["MainModule:x"] = 7
    form = {"backup": "/fileservice/$BACKUP/b"}
    reply = one.send("POST", "/ctrl/backup?action=backup", form)
    assert reply.status == 202
    assert one.get(f"{reply.header('location')}?json=1")[0].text("state") == "ready"
    assert one.post("/ctrl/backup?action=backup", form) == 400
    system = read_backup(controller.files.path("BACKUP:b"))
    assert [task.name for task in system.tasks] == ["T_ROB1"]
    assert b"PERS num x := 7;" in system.tasks[0].modules[0].data
    assert [signal.name for signal in system.signals] == [
        "do x;1",
        "doDefault",
        "diStart",
        "aoSpeed",
    ]
    assert (system.home / "notes.txt").read_bytes() == b"n"
    assert system.robotware == (6, 15)


def test_files_stay_within_their_volumes(one):
    put(one, "HOME/a%20b.mod", b"x")
    assert one.send("GET", "/fileservice/$HOME/a%20b.mod").body == b"x"
    assert one.post("/fileservice/$HOME", {"fs-action": "create", "fs-newname": "d"}) == 201
    assert one.post("/fileservice/$HOME", {"fs-action": "create", "fs-newname": "../d"}) == 400
    copy = {"fs-action": "copy", "fs-newname": "c.mod"}
    assert one.post("/fileservice/$HOME/a%20b.mod", copy) == 204
    assert one.post("/fileservice/$HOME/a%20b.mod", copy) == 403
    assert one.post("/fileservice/$HOME/c.mod", {"fs-action": "rename", "fs-newname": "r"}) == 204
    entries = {i.title: i.kind for i in one.get("/fileservice/$home")}
    entries.pop("MainModule.mod", None)
    assert entries == {"a b.mod": "fs-file", "d": "fs-dir", "r": "fs-file"}
    for path in (
        "$HOME/../../etc/passwd",
        "$HOME/%2e%2e/%2e%2e/x",
        "none/x",
        "C:/x",
        "$HOME/a/../../..",
    ):
        assert one.send("GET", f"/fileservice/{path}").status in (400, 404)
    one.application.controller.run_for(1.1)
    assert one.send("DELETE", "/fileservice/$HOME").status == 403
    assert one.send("DELETE", "/fileservice/$HOME/d").status == 204
    assert one.send("DELETE", "/fileservice/$HOME/d").status == 404


def test_collections_come_by_the_page_on_robotware_7(tmp_path):
    with make_runner(tmp_path, Generation.TWO) as controller_runner:
        two = Caller(make_application(controller_runner, Generation.TWO))
        for number in range(120):
            controller_runner.controller.log.info(80_001, f"event {number}")
        reply = two.send("GET", "/rw/elog/0?lang=en&limit=500")
        body = media.read(reply.body, reply.header("content-type"))
        assert len(body.items) == 50
        assert body.next == "0?start=50&limit=50"
        assert body.items[0].text("title") == "event 119"
        reply = two.send("GET", "/rw/elog/0?start=100&limit=50")
        assert 0 < len(media.read(reply.body, "").items) < 50
        assert two.send("GET", "/rw/elog/0?start=-1").status == 400


RECORDS = """MODULE {name}
    LOCAL RECORD MySettings
        num a;
    ENDRECORD
    LOCAL VAR MySettings settings := [{value}];
    {main}
ENDMODULE
"""


def test_properties_name_the_type_as_its_record_and_the_datum_of_the_module(tmp_path):
    """abb_librws compares dattyp with case before it reads a record [code]."""
    files = []
    for name, main in (("First", "PROC main()\nENDPROC"), ("Second", "")):
        files.append(tmp_path / f"{name}.mod")
        text = RECORDS.replace("{name}", name).replace("{main}", main).replace("{value}", "1")
        files[-1].write_text(text)
    system = replace(read_files(files), robotware=(6, 15))
    with ControllerRunner(system, robots=load_config("irb120").groups, autostart=False) as runner:
        caller = Caller(make_application(runner))
        for name in ("First", "Second"):
            path = f"RAPID/T_ROB1/{name}"
            (item,) = caller.get(f"/rw/rapid/symbol/properties/{path}/settings")
            assert (item.text("dattyp"), item.text("symburl")) == ("MySettings", f"{path}/settings")
            assert item.text("typurl") == f"{path}/MySettings"


def test_a_changed_axis_limit_holds_after_a_restart(two):
    """The mechanics read the cfg database, too."""
    edit = "?mastership=implicit"
    path = "/rw/cfg/MOC/ARM/instances/rob1_1"
    before = next(iter(two.application.controller.motion.groups.values())).config.joints
    raw = two.send("POST", f"{path}{edit}", body=b"upper_joint_bound=[1.5,1]")
    assert raw.status == 204
    caller = restart(two)
    after = next(iter(caller.application.controller.motion.groups.values())).config.joints
    assert after[0].upper == pytest.approx(1.5, rel=1e-5)
    assert (after[0].lower, after[1:]) == (before[0].lower, before[1:])
