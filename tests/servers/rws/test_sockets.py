"""Websockets as controllers have them, over the network [VC 6.16, VC 7.21]."""

import base64
import http.client
import os
import socket
import ssl
import threading

import pytest
from served import make_runner
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from rapidgen.servers.rws import server
from rapidgen.servers.rws.application import CONNECTION, SESSION
from rapidgen.servers.rws.server import serve_rws
from rapidgen.wire.rws import media
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.events import WantedResource, read_events, write_wanted
from rapidgen.wire.rws.forms import form_type, write_form

BASIC = "Basic " + base64.b64encode(b"Default User:robotics").decode()


def trusting():
    """TLS to any server.

    Not 1.3: these websockets read in a thread of their own, and while a ticket is read a concurrent
    request is lost (transport.py).
    """
    context = ssl.create_default_context()
    context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
    context.maximum_version = ssl.TLSVersion.TLSv1_2
    return context


@pytest.fixture
def cell(tmp_path):
    """A controller and its server."""
    with make_runner(tmp_path, Generation.TWO, clock="real") as runner:
        runner.start()
        service = serve_rws(runner, Generation.TWO)
        yield runner, service
        service.close()


@pytest.fixture
def port(cell):
    return cell[1].port


@pytest.fixture
def subscribe(port):
    """Opens a subscription; the websocket's keywords, and a function that asks for more."""
    context = trusting()
    link = http.client.HTTPSConnection("127.0.0.1", port, context=context)

    def ask(*resources):
        form = write_form(
            write_wanted([WantedResource(r, 2 if "signals" in r else 1) for r in resources])
        )
        headers = {"Authorization": BASIC, "Accept": media.HAL}
        link.request(
            "POST", "/subscription", form, {**headers, "Content-Type": form_type(Generation.TWO)}
        )
        answer = link.getresponse()
        body = answer.read()
        assert answer.status == 201, body
        cookies = dict(c.split(";")[0].split("=") for c in answer.headers.get_all("Set-Cookie"))
        headers = {"Cookie": f"{SESSION}={cookies[SESSION]}"}
        path = "/poll/" + answer.headers["Location"].rpartition("/")[2]
        return {
            "uri": f"wss://127.0.0.1:{port}{path}", "ssl": context, "additional_headers": headers,
            "subprotocols": ["rws_subscription"], "proxy": None, "ping_interval": None,
        }  # fmt: skip

    yield ask
    link.close()


def test_events_come_and_the_address_is_good_once(subscribe):
    wanted = subscribe("/rw/panel/opmode", "/rw/iosystem/signals/do%20x%3B1;state")
    with connect(**wanted) as socket:
        other = subscribe("/rw/panel/opmode")
        assert other["uri"] != wanted["uri"]
        with pytest.raises(InvalidStatus) as caught, connect(**wanted):
            pass
        assert caught.value.response.status_code == 404
        assert socket.subprotocol == "rws_subscription"


def test_a_client_that_sends_is_cut_off(subscribe):
    with connect(**subscribe("/rw/panel/opmode")) as socket:
        socket.send("anything")
        with pytest.raises(ConnectionClosed) as caught:
            socket.recv(60)
    assert caught.value.rcvd.code == 1008


@pytest.mark.parametrize(
    ("changed", "status"),
    [({"subprotocols": ["robapi2_subscription"]}, 400), ({"additional_headers": {}}, 403)],
)
def test_websocket_of_unknown_client_is_refused(subscribe, changed, status):
    wanted = {**subscribe("/rw/panel/opmode"), **changed}
    with pytest.raises(InvalidStatus) as caught, connect(**wanted):
        pass
    assert caught.value.response.status_code == status


def test_cookies_are_not_sent_to_pages_of_others(port):
    link = http.client.HTTPSConnection("127.0.0.1", port, context=trusting())
    link.request("GET", "/rw/system", headers={"Authorization": BASIC, "Accept": media.HAL})
    cookies = link.getresponse().headers.get_all("Set-Cookie")
    link.close()
    assert [c.partition("=")[0] for c in cookies] == [SESSION, CONNECTION]
    assert all(c.endswith("; path=/; httponly; samesite=strict") for c in cookies)


def test_pages_of_other_servers_get_no_events(subscribe):
    wanted = subscribe("/rw/panel/opmode")
    headers = {**wanted["additional_headers"], "Origin": "https://other"}
    with pytest.raises(InvalidStatus) as refused:
        connect(**{**wanted, "additional_headers": headers})
    assert refused.value.response.status_code == 403
    host = wanted["uri"].split("/")[2]
    headers["Origin"] = f"https://{host}"
    with connect(**{**wanted, "additional_headers": headers}) as events:
        assert events.subprotocol == "rws_subscription"


def test_nothing_is_lost_between_the_answer_and_the_upgrade(tmp_path):
    with make_runner(tmp_path, Generation.TWO, clock="real") as runner:
        runner.start()
        service = serve_rws(runner, Generation.TWO)
        context = trusting()
        link = http.client.HTTPSConnection("127.0.0.1", service.port, context=context)
        form = write_form(write_wanted([WantedResource("/rw/iosystem/signals/diStart;state", 2)]))
        headers = {"Accept": media.HAL, "Content-Type": form_type(Generation.TWO)}
        link.request("POST", "/subscription", form, {**headers, "Authorization": BASIC})
        answer = link.getresponse()
        answer.read()
        cookies = "; ".join(c.split(";")[0] for c in answer.headers.get_all("Set-Cookie"))
        headers |= {"Cookie": cookies}
        for value in (b"lvalue=1", b"lvalue=0", b"lvalue=1"):
            target = "/rw/iosystem/signals/diStart/set-value"
            link.request("POST", target, value, headers)
            assert link.getresponse().read() == b""
        number = answer.headers["Location"].rpartition("/")[2]
        with connect(
            f"wss://127.0.0.1:{service.port}/poll/{number}",
            ssl=context, additional_headers={"Cookie": cookies},
            subprotocols=["rws_subscription"], proxy=None,
        ) as socket:  # fmt: skip
            notify = [read_events(socket.recv(60).encode())[0].text("lvalue") for _ in range(3)]
        assert notify == ["1", "0", "1"]
        link.close()
        service.close()


def test_a_client_that_does_not_read_is_disconnected(cell, subscribe, monkeypatch):
    """Events for it would fill the memory. Here the server's loop waits, in place of the client."""
    monkeypatch.setattr(server, "_UNREAD", 3)
    runner, service = cell
    changed, goes_on = threading.Event(), threading.Event()
    with connect(**subscribe("/rw/iosystem/signals/do%20x%3B1;state")) as socket:
        service._stop.__self__.thread.loop.call_soon_threadsafe(goes_on.wait)

        def change():
            for value in (1, 0, 1, 0):
                runner.controller.signals["do x;1"] = value
            changed.set()

        def read():
            while socket.recv(60):
                pass

        runner.post(change)
        assert changed.wait(60)
        goes_on.set()
        with pytest.raises(ConnectionClosed):
            read()


def test_who_leaves_late_takes_nothing_from_who_came_since(one):
    """A poll URL of RWS 1.0 can be opened again while the old websocket is still closing."""
    form = {"resources": "1", "1": "/rw/iosystem/signals/aoSpeed;state", "1-p": "2"}
    assert one.post("/subscription", form) == 201
    groups, old, new = one.application.groups, [], []
    group = groups.find("1", one.session)
    groups.listen("1", one.session, old.append)
    first = group.send
    groups.listen("1", one.session, new.append)
    groups.leave("1", first)
    assert one.post("/rw/iosystem/signals/aoSpeed?action=set", {"lvalue": "2"}) == 204
    assert len(new) == 1
    assert old == [None]  # it is closed


def test_what_public_clients_subscribe_to_can_be(one, two):
    """[code: abb-rws-client]: all in one group; one that is refused leaves it without events."""
    for caller, state in ((one, "ctrlstate"), (two, "ctrl-state")):
        paths = (
            f"/rw/panel/{state}",
            "/rw/panel/opmode",
            "/rw/panel/speedratio",
            "/rw/rapid/execution;ctrlexecstate",
            "/rw/panel/coldetstate",
            "/rw/elog/0",
        )
        form = {"resources": str(len(paths))}
        for number, path in enumerate(paths, 1):
            form |= {str(number): path, f"{number}-p": "1"}
        assert caller.post("/subscription", form) == 201


def test_a_stop_leaves_no_connection_open(tmp_path):
    with make_runner(tmp_path, Generation.TWO, clock="real") as runner:
        runner.start()
        service = serve_rws(runner, Generation.TWO)
        raw = socket.create_connection(("127.0.0.1", service.port))
        with trusting().wrap_socket(raw) as silent:  # does not answer the end of TLS
            silent.sendall(b"GET / HTTP/1.1\r\nHost: here\r\n\r\n")
            assert silent.recv(8) == b"HTTP/1.1"
            service.close()
            with socket.socket(fileno=os.dup(silent.fileno())) as below:
                below.settimeout(10)
                while below.recv(4096):
                    pass


@pytest.mark.parametrize(
    "request_",
    [
        b"GET /rw HTTP/9\r\n\r\n",
        b"GET /rw HTTP/1.1\r\nHost: \0\r\n\r\n",
        b"GET /rw HTTP/1.1\r\nX: " + b"a" * 9000 + b"\r\n\r\n",
    ],
)
def test_what_is_no_http_is_rejected_without_a_traceback(tmp_path, caplog, request_):
    with make_runner(tmp_path, clock="real") as runner:
        runner.start()
        service = serve_rws(runner, Generation.ONE)
        with socket.create_connection(("127.0.0.1", service.port)) as sender:
            sender.sendall(request_)
            assert sender.recv(12) == b"HTTP/1.0 400"
        service.close()
    assert not [r for r in caplog.records if r.name.startswith("aiohttp")]
