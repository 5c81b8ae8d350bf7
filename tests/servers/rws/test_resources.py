"""Less common resources that public clients request.

They show the actual state, and a success shows elsewhere. Spellings: RWS manual 3HAC050973, [VC
6.16], [VC 7.21].
"""

import json
from datetime import datetime

import pytest
from served import STARTED, Caller, code_of, make_application, make_runner

from rapidgen.wire.rws import media
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.codes import CODES

EDIT = {Generation.ONE: "rapid?action=request", Generation.TWO: "edit/request"}


@pytest.fixture(params=[Generation.ONE, Generation.TWO], ids=["one", "two"])
def caller(request, tmp_path):
    with make_runner(tmp_path, request.param) as controller_runner:
        yield Caller(make_application(controller_runner, request.param))


def edit(caller):
    assert caller.post(f"/rw/mastership/{EDIT[caller.application.generation]}") == 204


def act(caller, path, name, form=None, two=""):
    """The status of an action, as each generation spells it."""
    path += f"?action={name}" if caller.is_one else f"/{two or name}"
    return caller.post(path, form)


def stop(caller):
    caller.application.runner.controller.run_for(0.1)
    assert act(caller, "/rw/rapid/execution", "stop", {"stopmode": "stop"}) == 204
    caller.application.runner.controller.run_for(0.5)


# -- positions -----------------------------------------------------------------------------------


def test_positions_by_task_are_those_of_its_robot(caller):
    (joints,) = caller.get("/rw/rapid/tasks/T_ROB1/motion?resource=jointtarget")
    (unit,) = caller.get("/rw/motionsystem/mechunits/ROB_1/jointtarget")
    assert [joints.text(f"j{i}") for i in range(1, 7)] == [
        unit.text(f"rax_{i}") for i in range(1, 7)
    ]
    (target,) = caller.get("/rw/rapid/tasks/T_ROB1/motion?resource=robtarget&tool=tool0&wobj=wobj0")
    (cartesian,) = caller.get("/rw/motionsystem/mechunits/ROB_1/robtarget")
    assert (target.kind, target.text("ej1")) == ("rapid-robtarget", "9e+09")
    assert [target.text(n) for n in ("x", "q1", "cf6")] == [
        cartesian.text(n) for n in ("x", "q1", "cf6")
    ]
    assert len(caller.get("/rw/rapid/tasks/T_ROB1/motion")) == 3
    assert caller.send("GET", "/rw/rapid/tasks/T_ROB1/motion?resource=else").status == 400


def test_a_robot_is_put_elsewhere_within_its_limits(caller):
    form = {"rob_joint": "[10,0,0,0,20,0]", "ext_joint": "[0,0,0,0,0,0]"}
    unit = "/rw/motionsystem/mechunits/ROB_1"
    assert act(caller, unit, "mechunit-position", form, "position") == 204
    (joints,) = caller.get(f"{unit}/jointtarget")
    assert float(joints.text("rax_1")) == pytest.approx(10)
    assert float(joints.text("rax_5")) == pytest.approx(20)
    form["rob_joint"] = "[400,0,0,0,20,0]"
    path = unit + ("?action=mechunit-position" if caller.is_one else "/position")
    assert code_of(caller.send("POST", path, form)) == CODES["E_MECHPOS_NOT_IN_LIMIT"]
    for wrong in ("", "a,b", "[1,nan]"):
        assert caller.post(path, {**form, "rob_joint": wrong}) == 400


def test_what_is_chosen_for_jogging_is_shown(caller):
    unit = "/rw/motionsystem/mechunits/ROB_1"
    path = f"{unit}?action=set" if caller.is_one else unit
    if caller.is_one:
        assert caller.post("/rw/mastership/motion?action=request") == 204
    assert caller.post(path, {"jog-mode": "AxisGroup1"}) == 204
    (item,) = caller.get(unit)
    assert (item.text("jog-mode"), item.text("status")) == ("AxisGroup1", "Synchronized")
    assert code_of(caller.send("POST", path, {"tool": "tNowhere"})) == CODES["E_TOOL_ERROR"]
    assert caller.post(path, {"else": "1"}) == 400


def test_axes_and_the_motion_system(caller):
    assert len(caller.get("/rw/motionsystem/mechunits/ROB_1/axes")) == 7
    status, logical = caller.get("/rw/motionsystem/mechunits/ROB_1/axes/3")
    assert (status.text("axis-status"), logical.text("logical-axis")) == ("Synchronized", "3")
    assert caller.send("GET", "/rw/motionsystem/mechunits/ROB_1/axes/7").status == 400
    (base,) = caller.get("/rw/motionsystem/mechunits/ROB_1/baseframe")
    assert (base.text("x"), base.text("q1")) == ("0", "1")
    (system, *_) = caller.get("/rw/motionsystem")
    assert system.text("mechunit-name") == "ROB_1"
    (count,) = caller.get("/rw/motionsystem?resource=change-count")
    assert dict(count.fields) == {"change-count": "0"}
    form = {"jogmode": "AxisGroup1", "mechunit": "ROB_1", "ccount": "0"}
    assert act(caller, "/rw/motionsystem", "jog", form) == 403


def test_leading_by_hand_takes_a_standing_program(two):
    """The success alone says nothing [real 7.21]."""
    path = "/rw/motionsystem/mechunits/ROB_1/lead-through"
    assert two.get(path)[0].text("status") == "Inactive"
    assert two.post(path, {"status": "active"}) == 204
    assert two.get(path)[0].text("status") == "Active"
    assert two.post(path, {"status": "inactive"}) == 204
    assert two.post("/rw/rapid/execution/start", STARTED) == 204
    two.application.runner.controller.run_for(0.1)
    assert two.post(path, {"status": "active"}) == 204
    assert two.get(path)[0].text("status") == "Inactive"


# -- programs ------------------------------------------------------------------------------------


def module(caller, remaining):
    one, two = "/rw/rapid/modules/MainModule", "/rw/rapid/tasks/T_ROB1/modules/MainModule"
    return f"{one}?task=T_ROB1&{remaining[0]}" if caller.is_one else f"{two}/{remaining[1]}"


def test_a_text_that_is_written_is_what_runs(caller):
    controller = caller.application.runner.controller
    (read,) = caller.get(module(caller, ("resource=module-text", "text")))
    text = read.text("module-text").replace("WaitTime 0.1", 'name := "new"; WaitTime 0.1')
    target = module(caller, ("action=set-module-text", "text"))
    assert caller.post(target, {"text": text}) == 403, "without mastership"
    edit(caller)
    assert caller.post(target, {"text": text}) == 204
    assert act(caller, "/rw/rapid/execution", "resetpp") == 204
    released = "rapid?action=release" if caller.is_one else "edit/release"
    assert caller.post(f"/rw/mastership/{released}") == 204
    assert act(caller, "/rw/rapid/execution", "start", STARTED) == 204
    controller.run_for(0.5)
    assert controller.tasks["T_ROB1"]["name"] == "new"


def test_a_piece_of_a_text_is_read_found_and_replaced(two):
    base = "/rw/rapid/tasks/T_ROB1/modules/MainModule/text"
    (row,) = two.get(f"{base}/range?startrow=2&startcol=5&endrow=2&endcol=-1")
    assert row.text("text") == "PERS num x := 1;"
    (place,) = two.get(f"{base}/search?text=WAITTIME")
    assert (place.text("row"), place.text("column")) == ("11", "13")
    edit(two)
    place = {"startrow": "2", "startcol": "19", "endrow": "2", "endcol": "19"}
    form = {**place, "replace-mode": "Replace", "query-mode": "Force", "text": "3"}
    assert two.post(f"{base}/range", form) == 204
    (row,) = two.get(f"{base}/range?startrow=2&startcol=5&endrow=2&endcol=-1")
    assert row.text("text") == "PERS num x := 3;"
    for wrong in ("startrow=0", "endrow=99", "startrow=2&startcol=200", "startrow=a"):
        assert two.send("GET", f"{base}/range?{wrong}").status == 400


def test_a_program_is_saved_taken_out_and_loaded(caller):
    volume = "$TEMP" if caller.is_one else "TEMP"
    program = "/rw/rapid/tasks/T_ROB1/program"
    assert act(caller, program, "save", {"path": f"{volume}/mine"}) == 204
    edit(caller)
    assert act(caller, program, "unloadprog", None, "unload") == 204
    assert caller.send("GET", program).status == 204
    form = {"progpath": f"{volume}/mine/T_ROB1.pgf", "loadmode": "replace"}
    assert act(caller, program, "loadprog", form, "load") == 204
    (loaded,) = caller.get(program)
    assert loaded.text("name") == "T_ROB1"
    assert caller.application.runner.controller.tasks["T_ROB1"]["x"] == 1
    missing = {"progpath": f"{volume}/else.pgf"}
    assert act(caller, program, "loadprog", missing, "load") in (400, 404)


def test_load_program_replaces_or_adds_modules(caller):
    """System modules are no part of a program."""
    programs = caller.application.runner.programs
    task = caller.application.controller.rapid_tasks["T_ROB1"]
    home = caller.application.controller.files.path("HOME:")
    edit(caller)
    for name, attributes in (("Own", ""), ("Sys", "(SYSMODULE)")):
        (home / f"{name}.mod").write_text(f"MODULE {name}{attributes}\nENDMODULE\n")
        form = {"modulepath": f"$HOME/{name}.mod"}
        assert act(caller, "/rw/rapid/tasks/T_ROB1", "loadmod", form) in (200, 204)
    (home / "More.mod").write_text("MODULE More\nENDMODULE\n")
    (home / "more.pgf").write_text("<Program><Module>More.mod</Module></Program>")
    program, path = "/rw/rapid/tasks/T_ROB1/program", {"progpath": "$HOME/more.pgf"}
    assert act(caller, program, "loadprog", {**path, "loadmode": "add"}, "load") == 204
    assert {m.name for m in programs.modules(task)} >= {"MainModule", "Own", "Sys", "More"}
    assert act(caller, program, "loadprog", {**path, "loadmode": "replace"}, "load") == 204
    assert {m.name for m in programs.modules(task)} & {"MainModule", "Own", "Sys", "More"} == {
        "Sys",
        "More",
    }
    assert act(caller, program, "loadprog", {**path, "loadmode": "other"}, "load") == 400


def test_a_pointer_is_not_put_while_the_program_runs(caller):
    assert act(caller, "/rw/rapid/execution", "start", STARTED) == 204
    caller.application.controller.run_for(0.15)
    edit(caller)
    form = {"module": "MainModule", "routine": "main", "userlevel": "FALSE"}
    where = caller.get("/rw/rapid/tasks/T_ROB1/pcp")
    put = "/rw/rapid/tasks/T_ROB1/pcp" + ("?action=set-pp-routine" if caller.is_one else "/routine")
    assert code_of(caller.send("POST", put, form)) == CODES["E_EXEC_STATE"]
    assert caller.get("/rw/rapid/tasks/T_ROB1/pcp") == where


def test_mastership_is_given_back_by_its_number_alone(two):
    reply = two.send("POST", "/rw/mastership/edit/request-with-id")
    (item,) = media.read(reply.body, reply.header("content-type")).items
    number = item.text("mastership-id")
    other = Caller(two.application)
    release = "/rw/mastership/edit/release-with-id"
    assert other.post(release, {"mastershipid": f"{number}0"}) == 403
    assert two.get("/rw/mastership/edit")[0].text("mastership") == "remote"
    assert other.post(release, {"mastershipid": number}) == 204
    assert two.get("/rw/mastership/edit")[0].text("mastership") == "nomaster"


def test_the_stack_and_the_pointer_of_a_stopped_program(caller):
    start = {**STARTED, "cycle": "forever"}
    frame = "?resource=activation-record" if caller.is_one else "/activation-record"
    path = f"/rw/rapid/tasks/T_ROB1{frame}"
    assert caller.send("GET", path).status == 400, "idle [VC 6.16]"
    assert act(caller, "/rw/rapid/execution", "start", start) == 204
    stop(caller)
    (result,) = caller.get(path)
    assert result.text("routine-url") == "RAPID/T_ROB1/MainModule/main"
    pointer, motion = caller.get("/rw/rapid/tasks/T_ROB1/pcp")
    assert (pointer.title, motion.title) == ("progpointer", "motionpointer")
    assert pointer.text("beginposition").partition(",")[0] == result.text("beg-row")
    edit(caller)
    row = {"line": "10", "column": "1"} if caller.is_one else {"begin-position-row": "10"}
    form = {"module": "MainModule", "routine": "main", **row}
    assert act(caller, "/rw/rapid/tasks/T_ROB1/pcp", "set-pp-cursor", form, "cursor") == 204
    assert caller.get("/rw/rapid/tasks/T_ROB1/pcp")[0].text("beginposition").startswith("10,")


def test_a_step_is_for_manual_mode(caller):
    controller = caller.application.runner.controller
    form = {**STARTED, "execmode": "stepover"}
    assert act(caller, "/rw/rapid/execution", "start", form) == 403
    controller.set_mode("manual_reduced")
    controller.set_motors(True)
    lenient = Caller(
        make_application(caller.application.runner, caller.application.generation, strict=False)
    )
    for _ in range(2):
        assert act(lenient, "/rw/rapid/execution", "start", form) == 204
        controller.run_for(0.2)
    assert controller.tasks["T_ROB1"]["count"] == 1
    assert controller.tasks["T_ROB1"].state == "stopped"


# -- the rest ------------------------------------------------------------------------------------


def test_sessions_are_listed_one_by_one_and_in_two_by_user(caller):
    before = len(caller.get("/users"))
    form = {"username": "me", "application": "app", "location": "here"}
    assert caller.post("/users" if caller.is_one else "/users/register", form) == 201
    other = Caller(caller.application)
    match = other.get("/users")
    assert len(match) == (before + 1 if caller.is_one else before)
    assert match[0].text("application") == "app"
    admin = Caller(caller.application, "Admin")
    assert len(caller.get("/users")) == len(match) + 1
    admin.send("GET", "/logout")
    other.send("GET", "/logout")
    assert len(caller.get("/users")) == before


def test_set_locale_local_is_refused(one):
    target = "/users?action=set-locale"
    assert [one.post(target, {"type": t}) for t in ("local", "remote", "here")] == [403, 204, 400]


def test_energy_lists_axes(caller):
    """As in a body of a RobotWare 6: `mechunits`, in each of them `axes`."""
    if caller.is_one:
        reply = caller.send("GET", "/rw/system/energy?json=1")
        (state,) = json.loads(reply.body)["_embedded"]["_state"]
    else:
        (state,) = json.loads(caller.send("GET", "/rw/system/energy").body)["state"]
    (unit,) = state["mechunits"]
    assert (unit["_title"], [axis["interval-energy"] for axis in unit["axes"]]) == (
        "ROB_1",
        ["0"] * 6,
    )
    datetime.strptime(state["time-stamp"], "%Y-%m-%d T %H:%M:%S")


def test_impersonation_does_not_extend_grants(tmp_path):
    with make_runner(tmp_path, Generation.TWO) as controller_runner:
        application = make_application(
            controller_runner, Generation.TWO, denied=frozenset(["UAS_IO_WRITE"])
        )
        caller, admin = Caller(application), Caller(application, "Admin")
        more = {"uid": str(admin.session.number)}
        assert code_of(caller.send("POST", "/users/impersonate", more)) == CODES["E_UAS_REJECT"]
        assert admin.post("/users/impersonate", {"uid": str(caller.session.number)}) == 204
        assert admin.post("/rw/iosystem/signals/aoSpeed/set-value", {"lvalue": "1"}) == 403
        assert admin.post("/users/impersonate", {"uid": "99"}) == 400


def test_networks_and_devices_one_by_one(caller):
    (network,) = caller.get("/rw/iosystem/networks")
    assert caller.get(f"/rw/iosystem/networks/{network.title}")[0].text("lstate") == "started"
    (device,) = caller.get("/rw/iosystem/devices")
    assert (device.title, caller.get(f"/rw/iosystem/devices/{device.title}")[0].text("name")) == (
        "Local/DRV_1",
        "DRV_1",
    )
    result = caller.send("POST", "/rw/iosystem/devices?action=search", {"name": "drv"})
    assert result.status == 200
    assert caller.post("/rw/iosystem/devices?action=search", {"network": "Local"}) == 400
    assert caller.send("GET", "/rw/iosystem/networks/Else").status == 404


@pytest.mark.parametrize(
    ("sought", "found"),
    [
        ({"name": ""}, None),
        ({"name": "LOC"}, 1),
        ({"name": "else"}, 0),
        ({"state": "running"}, 1),
        ({"state": "stopped"}, 0),
        ({"name": "else", "state": "running"}, 0),
        ({"name": "local", "state": "stopped"}, 0),
    ],
    ids=str,
)
def test_networks_are_sought_by_name_and_state(one, sought, found):
    reply = one.send("POST", "/rw/iosystem/networks?action=search", sought)
    if found is None:
        assert reply.status == 400
    else:
        assert len(media.read(reply.body, reply.header("content-type")).items) == found


def test_a_locked_mode_cannot_be_changed(caller):
    path, man = "/rw/panel/opmode", {"opmode": "man"}
    setting = f"{path}?action=setopmode" if caller.is_one else path
    assert act(caller, path, "lock", {"pin": "12", "permanent": "0"}) == 400
    assert act(caller, path, "lock", {"pin": "1234", "permanent": "0"}) == 204
    assert caller.post(setting, man) == 403
    assert act(caller, path, "unlock") == 204
    assert caller.post(setting, man) == 204


@pytest.mark.parametrize(
    ("mode", "result"),
    [
        ("Before", "PERS num 3x := 1;"),
        ("After", "PERS num x3 := 1;"),
        ("Replace", "PERS num 3 := 1;"),
    ],
)
def test_set_range_inserts_or_replaces_text(two, mode, result):
    base = "/rw/rapid/tasks/T_ROB1/modules/MainModule/text/range"
    edit(two)
    place = {"startrow": "2", "startcol": "14", "endrow": "2", "endcol": "14"}
    assert two.post(base, {**place, "replace-mode": mode, "text": "3"}) == 204
    (row,) = two.get(f"{base}?startrow=2&startcol=5&endrow=2&endcol=-1")
    assert row.text("text") == result
    back = {**place, "startrow": "3", "replace-mode": mode, "text": "3"}
    assert two.post(base, back) == 400, "it ends before it begins"
    assert two.post(base, {**place, "replace-mode": "Beside", "text": "3"}) == 400


def test_devices_are_those_of_a_network(caller):
    assert [item.text("name") for item in caller.get("/rw/iosystem/devices?network=Local")] == [
        "DRV_1"
    ]
    assert caller.get("/rw/iosystem/devices?network=Nowhere") == ()
    search = "/rw/iosystem/devices?action=search"
    assert caller.post(search, {"network": "Local"}) == 400  # name or state is required
    assert caller.post(search, {"name": "drv"}) == 200
    if caller.is_one:
        search = "/rw/iosystem/networks?action=search"
        assert (caller.post(search), caller.post(search, {"name": "loc"})) == (400, 200)


def test_jogging_is_refused_with_its_reason(caller):
    jog = "/rw/motionsystem" + ("?action=jog" if caller.is_one else "/jog")
    form = {"jogmode": "AxisGroup1", "mechunit": "ROB_1", "ccount": "0"}
    assert code_of(caller.send("POST", jog, form)) == CODES["E_MODE_REJECT"]
    caller.application.controller.set_mode("manual_reduced")
    assert code_of(caller.send("POST", jog, form)) == CODES["E_REJECT"]
    assert caller.post(jog, {"jogmode": "AxisGroup1"}) == 400


def test_what_is_chosen_for_jogging_wants_mastership_of_rws_1(caller):
    target = "/rw/motionsystem/mechunits/ROB_1" + ("?action=set" if caller.is_one else "")
    assert caller.post(target, {"tool": "tool0"}) == (403 if caller.is_one else 204)


def test_backup_existing_name_or_broken_folder_is_refused(caller):
    form = {"backup": "/fileservice/BACKUP/first"}
    assert act(caller, "/ctrl/backup", "backup", form, "create") == 202
    again = "/ctrl/backup" + ("?action=backup" if caller.is_one else "/create")
    assert code_of(caller.send("POST", again, form)) == CODES["E_DIR_EXIST"]
    if caller.is_one:
        return
    folder = caller.application.controller.files.path("BACKUP:/first")
    for broken, wanted in ((False, 0), (True, CODES["E_FAIL"])):
        if broken:
            (folder / "SYSPAR" / "SYS.cfg").write_text("nothing\n")
        reply = caller.send("POST", "/ctrl/backup/check-restore", form)
        (job,) = caller.get(reply.header("location"))
        assert (reply.status, min(job.whole("code"), 0)) == (202, wanted)


def test_the_emergency_stop_of_a_virtual_controller(two):
    """`off` presses it [VC 7.21]."""
    assert two.post("/rw/panel/emergency-stop", {"state": "off"}) == 204
    assert two.get("/rw/panel/ctrl-state")[0].text("ctrlstate") == "emergencystop"
    assert two.post("/rw/panel/emergency-stop", {"state": "on"}) == 204
    assert two.get("/rw/panel/ctrl-state")[0].text("ctrlstate") != "emergencystop"


def test_a_literal_is_judged(caller):
    two = "/rw/rapid/symbol/RAPID/T_ROB1/data?action=validate"
    path = "/rw/rapid/symbol/data?action=validate" if caller.is_one else two
    kind = "datatype" if caller.is_one else "dattyp"
    form = {"task": "T_ROB1", kind: "robtarget"}
    good = "[[0,0,600],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
    assert caller.post(path, {**form, "value": good}) == 204
    assert caller.post(path, {**form, "value": "[0,0,600]"}) == 400
    assert caller.post(path, {**form, kind: "nothing", "value": "1"}) == 400


def test_a_backup_is_restored_with_modules_and_files(caller):
    controller_runner = caller.application.runner
    volume = "$BACKUP" if caller.is_one else "BACKUP"
    saved = controller_runner.controller.files.path("HOME:") / "kept.txt"
    saved.write_text("kept")
    form = {"backup": f"/fileservice/{volume}/first"}
    assert act(caller, "/ctrl/backup", "backup", form, "create") == 202
    saved.unlink()
    edit(caller)
    assert act(caller, "/rw/rapid/tasks/T_ROB1", "unloadmod", {"module": "MainModule"}) == 204
    assert act(caller, "/ctrl/backup", "restore", {"backup": f"/fileservice/{volume}/no"}) == (
        400 if not caller.is_one else 403
    )
    if caller.is_one:
        assert caller.post("/rw/mastership/cfg?action=request") == 204
    assert act(caller, "/ctrl/backup", "restore", form) == 202
    controller_runner.run(lambda: controller_runner.restarts == 1)
    assert controller_runner.controller.tasks["T_ROB1"]["x"] == 1
    assert (controller_runner.controller.files.path("HOME:") / "kept.txt").read_text() == "kept"
    assert not controller_runner.controller.failed


def test_groups_of_a_session_and_what_they_watch(caller):
    form = {"resources": "1", "1": "/rw/panel/opmode", "1-p": "1"}
    assert caller.post("/subscription", form) == 201
    assert [i.title for i in caller.get("/subscription")] == ["1"]
    assert [i.title for i in caller.get("/subscription/1")] == ["/rw/panel/opmode"]
    assert Caller(caller.application).get("/subscription") == ()


@pytest.mark.parametrize(
    ("resource", "kind"),
    [
        ("/rw/rapid/tasks/T_ROB1;excstate", b"pgmtaskexec-state"),
        ("/rw/rapid/tasks/T_ROB1/pcp;programpointerchange", b"BegPosLine"),
        ("/rw/mastership/motion", b"holdmastership"),
        ("/rw/rapid/tasks/T_ROB1;taskchange", b"changetype"),
        ("/rw/rapid/tasks;buildlogchange", b"rap-buildlog-ev"),
    ],
)
def test_events_have_the_manuals_fields(caller, resource, kind):
    """RWS manual 3HAC050973; [code: App SDK] reads `pgmtaskexec-state`."""
    form = {"resources": "1", "1": resource, "1-p": "1"}
    reply = caller.send("POST", "/subscription", form)
    assert reply.status == 201
    assert kind in reply.body
    events = []
    caller.application.groups.listen("1", caller.session, events.append)
    motion = "motion?action=request" if caller.is_one else "motion/request"
    assert caller.post(f"/rw/mastership/{motion}") == 204
    edit(caller)
    text = {"text": "MODULE MainModule\nPROC main()\nWaitTime 5;\nENDPROC\nENDMODULE\n"}
    assert caller.post(module(caller, ("action=set-module-text", "text")), text) == 204
    released = "rapid?action=release" if caller.is_one else "edit/release"
    assert caller.post(f"/rw/mastership/{released}") == 204
    assert act(caller, "/rw/rapid/execution", "start", STARTED) == 204
    stop(caller)
    assert events
    assert all(kind in event for event in events)


@pytest.mark.parametrize(
    ("path", "name"),
    [
        ("/rw/system/energy", "energy-state"), ("/rw/system/license", "license"),
        ("/rw/vision", "number-of-cameras"), ("/ctrl/clock/timezone", "timezone"),
        ("/ctrl/virtualtime/vtspeed", "vtcurrspeed"), ("/ctrl/virtualtime/vttime", "vtcounter"),
        ("/rw/motionsystem/errorstate", "err-state"), ("/rw/system/options", "option"),
    ],
)  # fmt: skip
def test_controller_resources_have_expected_fields(caller, path, name):
    assert caller.get(path)[0].text(name)


def test_the_log_is_saved_and_cleared(caller):
    volume = "$TEMP" if caller.is_one else "TEMP"
    log = caller.application.controller.log
    log.info(10_000, "a title of its own")
    assert act(caller, "/rw/elog", "saveraw", {"path": f"/fileservice/{volume}/log.txt"}) == 202
    assert b"a title of its own" in caller.send("GET", f"/fileservice/{volume}/log.txt").body
    assert act(caller, "/rw/elog", "clearall") == 204
    assert not list(log)


def test_options_and_mechanics_are_in_the_cfg_of_every_controller(caller):
    """[code: abb_librws]: names and read-only attributes that it reads."""

    def first(path):
        item = caller.get(f"/rw/cfg/{path}/instances")[0]
        return {one.title.lower(): one.text("value") for one in item.within}

    assert [i.title for i in caller.get("/rw/cfg")] == ["EIO", "MMC", "MOC", "PROC", "SIO", "SYS"]
    assert first("sys/present_options")["desc"] == "PC Interface"
    assert first("sys/mechanical_unit_group") == {"name": "rob1", "robot": "ROB_1"}
    assert first("moc/mechanical_unit")["use_robot"] == "ROB_1"
    assert float(first("moc/arm")["upper_joint_bound"]) > 1
    assert first("MOC/JOINT")["use_arm"] == "rob1_1"
    assert caller.get("/rw/cfg/MMC") == ()


def test_the_joints_of_a_robot_cannot_be_changed_its_limits_can(caller):
    """JOINT of a robot model is in no backup: the controller has it and does not save it."""
    edit(caller)
    for section, attribute, reply in (
        ("JOINT", "logical_axis", 403),
        ("ARM", "upper_joint_bound", 204),
    ):
        path = f"/rw/cfg/MOC/{section}/instances/rob1_1"
        form = {attribute: "2" if caller.is_one else "[2,1]"}
        assert caller.post(f"{path}?action=set" if caller.is_one else path, form) == reply
    database = caller.application.controller.cfg
    joint, arm = (database.instance("MOC", kind, "rob1_1") for kind in ("JOINT", "ARM"))
    assert (joint.text("logical_axis"), arm.text("upper_joint_bound")) == ("1", "2")
    assert "JOINT" not in database.text("MOC")


def test_opmode_links_to_its_lock(two):
    """rws2 takes the first of several [code: rws2, run on a GoFa]."""
    mode, lock = two.get("/rw/panel/opmode")
    assert (mode.text("opmode"), lock.kind) == ("AUTO", "pnl-opmode-lockstate-li")
    assert two.get("/rw/panel/opmode/lock-state")[0].text("lockstate") == "Unlocked"


UNIT = "/rw/motionsystem/mechunits/ROB_1"
STATIC = {
    "type": "TCPRobot", "task-name": "T_ROB1", "axes": "6", "axes-total": "6",
    "is-integrated-unit": "NoIntegratedUnit", "has-integrated-unit": "NoIntegratedUnit",
}  # fmt: skip
DYNAMIC = {
    "tool-name": "tool0", "wobj-name": "wobj0", "payload-name": "load0",
    "total-payload-name": "load0", "status": "Synchronized", "mode": "Activated",
    "jog-mode": "Cartesian", "coord-system": "World",
}  # fmt: skip


@pytest.mark.parametrize(
    ("query", "names"),
    [
        ("", [*DYNAMIC, *STATIC]),
        ("static", [*STATIC]),
        ("dynamic", [*DYNAMIC]),
        ("tool", ["tool-name"]),
        ("axes;mode", ["mode", "axes"]),
        ("static;coord-system", ["coord-system", *STATIC]),
        ("is-integrated", ["is-integrated-unit"]),
    ],
)
def test_a_robot_for_which_nothing_is_chosen(caller, query, names):
    (item,) = caller.get(f"{UNIT}?resource={query}" if query else UNIT)
    assert dict(item.fields) == {name: (DYNAMIC | STATIC)[name] for name in names}


def test_each_choice_for_jogging_is_shown_under_its_own_name(caller):
    chosen = {"mode": "Deactivated", "jog-mode": "AxisGroup2", "coord-system": "Base"}
    if caller.is_one:
        assert caller.post("/rw/mastership/motion?action=request") == 204
    path = f"{UNIT}?action=set" if caller.is_one else UNIT
    for name, value in chosen.items():
        assert caller.post(path, {name: value}) == 204
    (item,) = caller.get(UNIT)
    assert dict(item.fields) == DYNAMIC | STATIC | chosen


@pytest.mark.parametrize(
    ("generation", "folder", "target"),
    [
        (Generation.ONE, "$HOME", ""),
        (Generation.ONE, "HOME:", ""),
        (Generation.ONE, "$HOME/sub/", "sub/"),
        (Generation.ONE, "ELSE:", None),
        # The root of a volume only, as [VC 7.21] has it.
        (Generation.TWO, "HOME:", ""),
        (Generation.TWO, "HOME", None),
        (Generation.TWO, "HOME:/sub", None),
        (Generation.TWO, "ELSE:", None),
    ],
)
def test_a_module_is_saved_with_present_values(generation, folder, target, tmp_path):
    with make_runner(tmp_path, generation) as controller_runner:
        caller = Caller(make_application(controller_runner, generation))
        home = controller_runner.controller.files.path("HOME:")
        (home / "sub").mkdir()
        controller_runner.controller.tasks["T_ROB1"]["x"] = 7
        form = {"name": "kept", "path": folder}
        status = caller.post(module(caller, ("action=save", "save")), form)
        saved = [path for path in home.rglob("*") if path.is_file()]
        if target is None:
            assert (status, saved) == (404 if caller.is_one else 400, [])
        else:
            assert (status, saved) == (
                204,
                [home / f"{target}kept.mod{'' if caller.is_one else 'x'}"],
            )
            assert "PERS num x := 7;" in saved[0].read_text()
        missing = module(caller, ("action=save", "save")).replace("MainModule", "Nowhere")
        assert code_of(caller.send("POST", missing, form)) == CODES["E_NO_SUCH_SYMBOL"]
