"""Lists of resources and their links, and a start in a wrong state, as controllers answer.

Bodies of `/rw` and of signals: RobotWare 6.05 [code: HslCommunication]; titles of modules:
RobotWare 6 and 7 [code: node-red-contrib-abb-gofa]; starts: [VC 6.16, real 7.21].
"""

from urllib.parse import urljoin, urlsplit

import pytest
from served import STARTED, Caller, code_of, make_application, make_runner

from rapidgen.wire.rws import media
from rapidgen.wire.rws.codes import CODES


@pytest.fixture(params=["one", "two", "eight"])
def caller(request):
    """A session of each generation."""
    return request.getfixturevalue(request.param)


def bodies(caller, target):
    """The body of a target in each syntax."""
    if caller.is_one:
        replies = [caller.send("GET", target), caller.send("GET", f"{target}?json=1")]
    else:
        replies = [caller.send("GET", target, accept=kind) for kind in (media.HAL, media.XHTML)]
    assert [reply.status for reply in replies] == [200, 200]
    return [media.read(reply.body, reply.header("content-type")) for reply in replies]


def followed(caller, base, href):
    """The reply to a link."""
    address = urlsplit(urljoin(base, href))
    return caller.send("GET", f"{address.path}?{address.query}" if address.query else address.path)


def test_services_are_listed_with_links(caller):
    for body in bodies(caller, "/rw"):
        assert body.base == f"{'http' if caller.is_one else 'https'}://h/"
        services = {item.title: item.links["self"] for item in body.all("rwservice-li")}
        assert services["panel"] == "rw/panel"
        assert {"cfg", "elog", "iosystem", "motionsystem", "rapid", "system"} <= set(services)
        assert followed(caller, body.base, services["system"]).status == 200
    assert caller.send("GET", "/rw/").status == 200


def test_signals_link_to_themselves(caller):
    for body in bodies(caller, "/rw/iosystem/signals"):
        for item in body.items:
            answer = followed(caller, body.base, item.links["self"])
            one = media.read(answer.body, answer.header("content-type")).items[0]
            assert (one.title, one.text("name")) == (item.title, item.text("name"))
        links = {item.title: item.links["self"].partition("?")[0] for item in body.items}
        assert links["Local/DRV_1/diStart"] == "signals/Local/DRV_1/diStart"
        assert links["do x;1"] == "signals/do%20x%3B1"


def test_found_signals_link_to_themselves(caller):
    name = "?action=signal-search" if caller.is_one else "/signal-search"
    reply = caller.send("POST", f"/rw/iosystem/signals{name}", {"name": "diStart"})
    body = media.read(reply.body, reply.header("content-type"))
    assert followed(caller, body.base, body.items[0].links["self"]).status == 200


def test_titles_of_modules_begin_with_the_task(caller):
    target = "/rw/rapid/tasks/T_ROB1/modules"
    reply = caller.send("GET", "/rw/rapid/modules?task=T_ROB1" if caller.is_one else target)
    items = media.read(reply.body, reply.header("content-type")).items
    assert {"T_ROB1/MainModule": "MainModule"}.items() <= {
        i.title: i.text("name") for i in items
    }.items()
    assert not any(item.links for item in items)  # [code: recorded bodies of RobotWare 6]


def test_start_with_motors_off(tmp_path, one, two):
    for caller in (one, two):
        caller.application.controller.set_motors(False)
    # RWS 2.0 accepts a start that has no effect [real 7.21, VC 7.21].
    assert two.post("/rw/rapid/execution/start", STARTED) == 204
    reply = one.send("POST", "/rw/rapid/execution?action=start", STARTED)
    assert (reply.status, code_of(reply)) == (400, CODES["E_EXEC_STATE"])
    for caller in (one, two):
        assert caller.get("/rw/rapid/execution")[0].text("ctrlexecstate") == "stopped"
        caller.application.controller.set_motors(True)
    assert one.post("/rw/rapid/execution?action=start", STARTED) == 204
    with make_runner(tmp_path) as runner:
        runner.controller.set_motors(False)
        lenient = Caller(make_application(runner, strict=False))
        assert lenient.post("/rw/rapid/execution?action=start", STARTED) == 204
