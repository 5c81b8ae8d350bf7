"""Malicious requests: each is answered and has no other effect.

`campaign.py` has the long, random form.
"""

import os

import pytest
from served import Caller, make_application, make_runner

from rapidgen.wire.rws import media
from rapidgen.wire.rws.bodies import Generation

LONG = "9" * 5000
"""More digits than Python makes a number of."""


@pytest.fixture(params=list(Generation), ids=lambda g: f"rws{g.value}")
def caller(request, tmp_path):
    """A session of each generation; whatever RAPID wants to be left alone stands."""
    with make_runner(tmp_path, request.param) as runner:
        yield Caller(make_application(runner, request.param))


def spelled(caller, one, two):
    """A request's target by generation."""
    return one if caller.is_one else two


def edit(caller):
    """Take what changes to programs want."""
    if caller.application.generation is Generation.EIGHT:
        station = {"control-station-name": "t", "pincode": "1"}
        station["control-station-id"] = "{01234567-89AB-CDEF-0123-456789ABCDEF}"
        caller.post("/rw/controlstation/register/remote", station)
        assert caller.post("/rw/controlstation/writeaccess/request") == 204
    else:
        target = spelled(caller, "rapid?action=request", "edit/request")
        assert caller.post(f"/rw/mastership/{target}") == 204


@pytest.mark.parametrize(
    ("one", "two"),
    [
        ("motionsystem/checkchangecount?changecount=", "motionsystem/checkchangecount/"),
        ("motionsystem/mechunits/ROB_1/axes/",) * 2,
        ("elog/0?elogseqnum=",) * 2,
        ("elog/0?limit=",) * 2,
        (
            "rapid/tasks/T_ROB1?resource=activation-record&stackframe=",
            "rapid/tasks/T_ROB1/activation-record?stackframe=",
        ),
        ("retcode?code=",) * 2,
    ],
)
@pytest.mark.parametrize("number", [LONG, "-1", "\u0663", "1_0", ""])
def test_numbers_of_any_length(caller, one, two, number):
    target = f"/rw/{spelled(caller, one, two)}"
    assert caller.send("GET", f"{target}{number}").status in (200, 400, 404)


def test_long_numbers_of_groups_elements_and_percents(caller):
    assert caller.send("GET", f"/subscription/{LONG}").status == 404
    symbol = f"T_ROB1/MainModule/list{{{LONG}}}"
    one, two = f"/rw/rapid/symbol/data/RAPID/{symbol}", f"/rw/rapid/symbol/RAPID/{symbol}/data"
    assert caller.send("GET", spelled(caller, one, two)).status in (400, 404)
    edit(caller)
    speed = "/rw/panel/speedratio?action=setspeedratio"
    assert caller.post(speed, {"speed-ratio": LONG}) == 400


@pytest.mark.parametrize("target", ["/fileservice/HOME/\udcff", "/rw/\udcff", "/rw/cfg?a=\udcff"])
def test_bytes_that_are_no_text(caller, target):
    """As a server reads a request line that is no UTF-8."""
    assert caller.send("GET", target).status == 400


def test_a_host_that_is_no_text(caller):
    assert caller.send("GET", "/rw/system", host="h\udcff").status == 400


def test_a_file_whose_name_is_no_text(caller):
    """HOME of a backup that was unpacked on another system."""
    home = caller.application.controller.files.path("HOME:")
    os.close(os.open(os.fsencode(home) + b"/a\xff.mod", os.O_CREAT))
    for accept in (media.HAL, media.XHTML):
        caller.accept = accept
        assert len(caller.get("/fileservice/HOME")) == 1


# -- files ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("root", ["HOME/.", "HOME/a/..", "$HOME/./", "HOME/./.", "home"])
def test_a_volume_is_neither_deleted_nor_renamed(caller, root):
    caller.send("PUT", "/fileservice/HOME/kept", body=b"x", content_type="text/plain;v=2.0")
    assert caller.send("DELETE", f"/fileservice/{root}").status == 403
    form = {"fs-action": "rename", "fs-newname": "b"}
    target = spelled(caller, f"/fileservice/{root}", f"/fileservice/{root}/rename")
    assert caller.post(target, form) == 403
    assert caller.send("GET", "/fileservice/HOME/kept").body == b"x"


def test_a_backup_into_home_is_without_itself(caller):
    caller.send("PUT", "/fileservice/HOME/a", body=b"x", content_type="text/plain;v=2.0")
    target = spelled(caller, "/ctrl/backup?action=backup", "/ctrl/backup/create")
    assert caller.post(target, {"backup": "/fileservice/HOME/b"}) == 202
    assert [item.title for item in caller.get("/fileservice/HOME/b/HOME")] == ["a"]


@pytest.mark.parametrize("name", ["a\0b", "n" * 300, "..", "a/b"])
def test_names_of_saved_programs(caller, name):
    edit(caller)
    target = "/rw/rapid/tasks/T_ROB1/program"
    target += spelled(caller, "?action=save", "/save")
    assert caller.post(target, {"path": "$HOME/p", "name": name}) in (204, 400)
    assert not [i for i in caller.get("/fileservice/HOME") if i.title != "p"]


def test_a_program_file_does_not_lead_out(caller, tmp_path):
    """A link in a HOME that the user gave."""
    outside = tmp_path / "outside.mod"
    outside.write_text("MODULE Outside\nENDMODULE\n")
    home = caller.application.controller.files.path("HOME:")
    (home / "a.mod").symlink_to(outside)
    (home / "p.pgf").write_text("<Program><Module>a.mod</Module></Program>")
    edit(caller)
    target = "/rw/rapid/tasks/T_ROB1/program"
    target += spelled(caller, "?action=loadprog", "/load")
    assert caller.post(target, {"progpath": "$HOME/p.pgf", "loadmode": "add"}) == 400


# -- what is asked for comes true, or is refused -------------------------------------------------


def text_of(caller, module="MainModule"):
    """The source of a module; None: it is not there."""
    one = f"/rw/rapid/modules/{module}?resource=module-text&task=T_ROB1"
    two = f"/rw/rapid/tasks/T_ROB1/modules/{module}/text"
    reply = caller.send("GET", spelled(caller, one, two))
    if reply.status != 200:
        return None
    return media.read(reply.body, reply.header("content-type")).items[0].text("module-text")


def set_text(caller, text):
    """The status of another source for MainModule."""
    one = "/rw/rapid/modules/MainModule?action=set-module-text&task=T_ROB1"
    return caller.post(
        spelled(caller, one, "/rw/rapid/tasks/T_ROB1/modules/MainModule/text"), {"text": text}
    )


@pytest.mark.parametrize("comment", ["\u20ac", "\u00e9", "\u00c3\u00a9"])
@pytest.mark.parametrize("wrong", ["", "PROC"])
def test_a_text_is_kept_letter_by_letter(caller, comment, wrong):
    edit(caller)
    text = f"MODULE MainModule\n! {comment}\nPROC main()\nENDPROC\n{wrong}\nENDMODULE\n"
    assert set_text(caller, text) == 204
    assert text_of(caller) == text


def test_a_text_that_names_its_module_anew_takes_no_other_ones_place(caller):
    edit(caller)
    body = b"MODULE Other\nENDMODULE\n"
    caller.send("PUT", "/fileservice/$HOME/o.mod", body=body, content_type="text/plain;v=2.0")
    load = "/rw/rapid/tasks/T_ROB1" + spelled(caller, "?action=loadmod", "/loadmod")
    assert caller.post(load, {"modulepath": "$HOME/o.mod"}) in (200, 204)
    assert set_text(caller, "MODULE Other\nPROC main()\nENDPROC\nENDMODULE\n") == 400
    assert "main" not in text_of(caller, "Other")
    assert text_of(caller) is not None


def test_a_text_that_names_its_module_anew_keeps_main(caller):
    edit(caller)
    assert set_text(caller, "MODULE Renamed\nPROC main()\nENDPROC\nENDMODULE\n") == 204
    assert text_of(caller) is None
    assert text_of(caller, "Renamed") is not None
    assert caller.get("/rw/rapid/tasks/T_ROB1/program/builderror") == ()


@pytest.mark.parametrize("number", ["nan", "inf", "1e400", "0.5", LONG])
def test_a_message_to_a_task_has_a_whole_number(caller, number):
    target = "/rw/dipc/RMQ_T_ROB1" + spelled(caller, "?action=dipc-send", "")
    assert caller.post(target, {"dipc-data": "num;1", "dipc-userdef": number}) == 400
    assert not caller.application.controller.queues.queue("T_ROB1").messages


@pytest.mark.parametrize(
    "joints", ["[0]", "[0,0,0,0,0]", "[0,0,0,0,0,0,0]", "[]", "[nan,0,0,0,0,0]"]
)
def test_a_place_to_be_put_to_has_all_joints(caller, joints):
    unit = "/rw/motionsystem/mechunits/ROB_1"
    target = spelled(caller, f"{unit}?action=mechunit-position", f"{unit}/position")
    before = caller.get(f"{unit}/jointtarget")
    assert caller.post(target, {"rob_joint": joints, "ext_joint": "[0]"}) == 400
    assert caller.get(f"{unit}/jointtarget") == before


@pytest.mark.parametrize("value", ["nan", "inf", "1_000", "0x10", "1" * 400])
def test_a_value_of_cfg_stays_what_it_is(caller, value):
    cfg = "/rw/cfg/EIO/EIO_SIGNAL/instances"
    edit(caller)
    create = spelled(caller, f"{cfg}?action=create-default", f"{cfg}/create-default")
    assert caller.post(create, {"name": "s"}) == 201
    assert (
        caller.post(
            spelled(caller, f"{cfg}/s?action=set", f"{cfg}/s"),
            {"Label": spelled(caller, value, f"[{value},1]")},
        )
        == 204
    )
    (item,) = caller.get(f"{cfg}/s")
    assert {i.title: i.text("value") for i in item.within}["Label"] == value


PROGRAM = f"MODULE MainModule\nVAR num {'a' * 32};\nPROC main()\nENDPROC\nENDMODULE\n"


@pytest.mark.parametrize("pattern", ["(a+)+!", "(a|a)*!", ".*" * 30 + "!", "(a{1,9}){1,9}!", "(a"])
def test_a_pattern_that_takes_for_ever_is_refused(tmp_path, pattern):
    with make_runner(tmp_path, Generation.ONE, PROGRAM) as runner:
        caller = Caller(make_application(runner))
        form = {"blockurl": "RAPID/T_ROB1", "regexp": pattern}
        assert caller.post("/rw/rapid/symbols?action=search-symbols", form) == 400
        for form["regexp"] in ("a.*|main", "[[a]*"):
            assert caller.post("/rw/rapid/symbols?action=search-symbols", form) == 200
