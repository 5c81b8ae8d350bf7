"""Refusals of a controller: statuses, codes and limits.

Statuses and codes as observed [VC 6.16, VC 7.21, real 7.21, VC 8.1.1], limits as in the manuals.
"""

import base64

import pytest
from hypothesis import given
from hypothesis import strategies as st
from served import STARTED, Caller, code_of, make_application, make_runner

from rapidgen.servers.rws.application import IDLE, MOST_SESSIONS, RATE
from rapidgen.servers.rws.messages import HttpRequest
from rapidgen.wire.rws import media
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.codes import CODES


def test_request_without_login_is_refused(one, two):
    challenge = one.application.handle(HttpRequest("GET", "/rw/system"))
    assert (challenge.status, challenge.header("www-authenticate")[:6]) == (401, "Digest")
    challenge = two.application.handle(HttpRequest("GET", "/rw/system"))
    assert (challenge.status, challenge.header("www-authenticate")[:5]) == (401, "Basic")
    wrong = base64.b64encode(b"Default User:wrong").decode()
    reply = two.application.handle(
        HttpRequest("GET", "/rw/system", {"authorization": f"Basic {wrong}"})
    )
    assert (reply.status, reply.body) == (401, b"")


@pytest.mark.parametrize("accept", ["*/*", "application/xhtml+xml", "application/json", None])
def test_a_type_without_its_version_is_not_acceptable(two, accept):
    assert two.send("GET", "/rw/system", accept=accept).status == 406
    # Files are given whatever is asked for [real 7.21].
    assert (
        two.send("PUT", "/fileservice/HOME/a", body=b"x", content_type="text/plain;v=2.0").status
        == 201
    )
    assert two.send("GET", "/fileservice/HOME/a", accept=accept).body == b"x"


def test_a_trailing_semicolon_is_tolerated(two):
    assert two.send("GET", "/rw/system", accept="application/hal+json;v=2.0;").status == 200


@pytest.mark.parametrize("kind", [None, "application/x-www-form-urlencoded", "text/plain"])
def test_a_request_without_the_form_type_is_not_acceptable(two, kind):
    assert (
        two.send("POST", "/rw/rapid/execution/stop", {"stopmode": "stop"}, content_type=kind).status
        == 406
    )
    assert two.send("DELETE", "/fileservice/HOME/a", content_type=kind).status == 406


def test_a_file_of_another_type_is_unsupported(two):
    reply = two.send("PUT", "/fileservice/HOME/a", body=b"x", content_type="text/plain")
    assert reply.status == 415


def test_verbs_of_another_generation_are_refused(one, two):
    assert two.post("/rw/rapid/execution?action=stop", {"stopmode": "stop"}) == 405
    assert one.post("/rw/rapid/execution/stop", {"stopmode": "stop"}) == 404
    # One keeps its old form [VC 7.21].
    form = {"speed-ratio": "50"}
    assert two.post("/rw/mastership/edit/request") == 204
    assert two.post("/rw/panel/speedratio?action=setspeedratio", form) == 204
    assert two.post("/rw/panel/speedratio", form) == 400
    assert one.send("GET", "/uas").status == 404


def test_there_are_seventy_sessions_which_end_when_they_are_idle(one):
    app = one.application
    for _ in range(MOST_SESSIONS - len(app.sessions)):
        assert app.sessions.begin("Admin") is not None
    login = {"authorization": f"Basic {base64.b64encode(b'Admin:robotics').decode()}"}
    assert app.sessions.begin("Admin") is None
    app.runner.controller.run_for(IDLE + 1)
    assert app.sessions.begin("Admin") is not None
    assert len(app.sessions) == 1
    assert app.handle(HttpRequest("GET", "/rw/system", login)).status == 401


def test_a_session_that_logs_out_is_gone_with_what_it_held(one):
    assert one.post("/rw/mastership/rapid?action=request") == 204
    assert one.send("GET", "/logout").status == 200
    assert one.send("GET", "/rw/system").status == 401
    other = Caller(one.application)
    assert other.get("/rw/mastership/rapid")[0].text("mastership") == "nomaster"


def test_twenty_requests_a_second_of_the_controllers_clock_are_the_most(one, two):
    statuses = [one.send("GET", "/rw/panel/opmode").status for _ in range(RATE + 1)]
    assert statuses == [200] * RATE + [503]
    # [RWS 1.0 manual]; public clients of RobotWare 7 ask faster [code: abb-rws-client].
    assert {two.send("GET", "/rw/panel/opmode").status for _ in range(2 * RATE)} == {200}
    one.application.runner.controller.run_for(1.01)
    assert one.send("GET", "/rw/panel/opmode").status == 200


def test_mastership_belongs_to_one_session(two):
    other = Caller(two.application, "Admin")
    pp = "/rw/rapid/execution/resetpp"
    missing = two.send("POST", pp)
    assert (missing.status, code_of(missing)) == (403, CODES["E_MASTER_REJECT"])
    assert two.post("/rw/mastership/edit/request") == 204
    assert two.post("/rw/mastership/edit/request") == 204
    held = other.send("POST", pp)
    assert (held.status, code_of(held)) == (403, CODES["E_RESOURCE_HELD"])
    assert other.post("/rw/mastership/edit/request") == 403
    assert two.post(pp) == 204
    assert two.post("/rw/mastership/rapid/request") == 404  # RobotWare 7 has edit and motion
    assert two.get("/rw/mastership/edit")[0].text("mastershipheldbyme") == "TRUE"
    assert two.post("/rw/mastership/edit/release") == 204
    assert two.post("/rw/mastership/edit/release") == 403
    assert other.post(f"{pp}?mastership=implicit") == 204


def test_who_holds_mastership_keeps_rapid_from_running(two):
    two.post("/rw/mastership/edit/request")
    assert two.post("/rw/rapid/execution/start", STARTED) == 403
    two.post("/rw/mastership/edit/release")
    assert two.post("/rw/rapid/execution/start", STARTED) == 204


def test_robotware_8_has_write_access_of_a_control_station(eight):
    assert eight.send("GET", "/rw/mastership").status == 410
    assert eight.post("/rw/mastership/edit/request") == 410
    refused = eight.send("POST", "/rw/rapid/execution/resetpp")
    assert (refused.status, code_of(refused)) == (403, CODES["E_NO_WRITE_ACCESS"])
    assert eight.post("/rw/controlstation/writeaccess/request") == 403
    station = {"control-station-name": "s", "pincode": "1", "control-station-id": "no braces"}
    register = "/rw/controlstation/register/remote"
    assert eight.post(register, station) == 400
    station["control-station-id"] = "{01234567-89AB-CDEF-0123-456789ABCDEF}"
    assert eight.post(register, station) == 204
    assert eight.post("/rw/controlstation/writeaccess/request") == 204
    assert eight.post("/rw/rapid/execution/resetpp") == 204
    start = "/rw/rapid/execution/start"
    assert eight.post(start, STARTED) == 403
    assert (
        eight.post("/rw/controlstation/allowmotioncontrol", {"allow-motion-control": "true"}) == 204
    )
    assert eight.post(start, STARTED) == 204
    # Not given back by a logout: another run of the same station can.
    eight.send("GET", "/logout")
    again, other = Caller(eight.application), Caller(eight.application)
    other_session = "{11111111-1111-1111-1111-111111111111}"
    other.post(register, {**station, "control-station-id": other_session})
    assert other.post("/rw/controlstation/writeaccess/request") == 403
    assert again.post(register, station) == 204
    assert again.post("/rw/controlstation/writeaccess/release") == 204
    assert other.post("/rw/controlstation/writeaccess/request") == 204
    assert eight.application.handle(HttpRequest("GET", "/users/rmmp")).status == 401


def test_modes_and_grants_are_held(one):
    controller = one.application.controller
    controller.set_mode("manual_reduced")
    assert one.post("/rw/panel/ctrlstate?action=setctrlstate", {"ctrl-state": "motoron"}) == 403
    assert one.post("/rw/rapid/execution?action=start", STARTED) == 403
    assert one.post("/rw/mastership/rapid?action=request") == 403
    controller.set_mode("auto")
    controller.set_e_stop(True)
    refused = one.send("POST", "/rw/panel/ctrlstate?action=setctrlstate", {"ctrl-state": "motoron"})
    assert (refused.status, code_of(refused)) == (403, CODES["E_REJECT"])
    assert one.get("/rw/panel/ctrlstate?json=1")[0].text("ctrlstate") == "emergencystop"


def test_lenient_is_another_mode(tmp_path):
    with make_runner(tmp_path, Generation.TWO) as controller_runner:
        caller = Caller(make_application(controller_runner, Generation.TWO, strict=False))
        assert [caller.send("GET", "/rw/system", accept="*/*").status for _ in range(50)] == [
            200
        ] * 50
        assert caller.post("/rw/rapid/execution/resetpp") == 204


PATHS = st.sampled_from(
    ["/rw/system", "/rw/cfg/SYS/CAB_TASKS/instances", "/fileservice/$HOME/../../etc/passwd",
     "/rw/rapid/symbol/data/RAPID/T_ROB1/x", "/rw/iosystem/signals/do%20x%3B1", "/subscription",
     "/rw/rapid/modules/MainModule?task=T_ROB1", "/rw/elog/0", "/ctrl/$HOME", "/poll/1"]
)  # fmt: skip


@given(
    st.sampled_from(["GET", "POST", "PUT", "DELETE", "OPTIONS", "X"]),
    st.one_of(PATHS, st.text(max_size=30).map(lambda text: f"/{text}")),
    st.text(max_size=20),
    st.binary(max_size=60),
)
def test_hostile_requests_are_answered(hostile, method, path, query, body):
    for caller in hostile:
        reply = caller.send(method, f"{path}?{query}" if query else path, body=body)
        assert 200 <= reply.status < 500
        reply = caller.application.handle(HttpRequest(method, path, {"authorization": query}, body))
        assert reply.status in (400, 401)
    assert media.read(hostile[0].send("GET", "/rw/system").body, "").items


@pytest.fixture(scope="module")
def hostile(tmp_path_factory):
    with (
        make_runner(tmp_path_factory.mktemp("one")) as first,
        make_runner(tmp_path_factory.mktemp("two"), Generation.TWO) as second,
    ):
        callers = [
            Caller(make_application(first)),
            Caller(make_application(second, Generation.TWO)),
        ]
        for caller in callers:
            caller.application.sessions.is_too_fast = lambda: False
        yield callers


def test_robotware_6_takes_mastership_for_a_program_pointer_by_itself(one):
    """[code: abb_librws, abb_robot_client]: both set it so, and ask for nothing before."""
    other = Caller(one.application, "Admin")
    pp = "/rw/rapid/execution?action=resetpp"
    assert one.post(pp) == 204
    assert other.post("/rw/mastership/rapid?action=request") == 204
    held = one.send("POST", pp)
    assert (held.status, code_of(held)) == (403, CODES["E_RESOURCE_HELD"])


@pytest.mark.parametrize(
    ("part", "name"),
    [
        ("dynamic", "total-payload-name"), ("dynamic", "jog-mode"), ("dynamic", "coord-system"),
        ("static", "is-integrated-unit"), ("static", "axes-total"), ("static", "task-name"),
        ("static;tool", "tool-name"),
    ],
)  # fmt: skip
def test_a_mechanical_unit_tells_what_public_clients_want(one, part, name):
    """[code: abb_librws]: static and dynamic information are none without. Parts add up [RWS
    manual]."""
    (item,) = one.get(f"/rw/motionsystem/mechunits/ROB_1?resource={part}")
    assert item.text(name)
    assert ("jog-mode" in item.fields) == (part == "dynamic")


def test_the_head_of_a_file_is_asked_for_alone(one):
    """[code: abb-lib-rws]"""
    assert one.send("PUT", "/fileservice/$HOME/a", body=b"text").status == 201
    assert one.send("HEAD", "/fileservice/$HOME/a").status == 200
    assert one.send("HEAD", "/fileservice/$HOME/b").status == 404
