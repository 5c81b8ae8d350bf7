"""Logins and cookies: a login is valid once, for its own request [RFC 7616, 3.4, 5.5]."""

import hashlib
import urllib.error
import urllib.request

import pytest
from served import Caller, make_runner

from rapidgen.servers.rws.application import Accounts
from rapidgen.servers.rws.messages import HttpRequest
from rapidgen.servers.rws.server import serve_rws
from rapidgen.wire.rws import login
from rapidgen.wire.rws.bodies import Generation


def md5(text):
    return hashlib.md5(text.encode()).hexdigest()


def nonce_of(reply):
    return reply.header("www-authenticate").partition('nonce="')[2].partition('"')[0]


def digest(nonce, uri, /, nc="00000001", method="GET", **changed):
    """An Authorization header; `changed` are fields sent in place of the right ones."""
    ha1, ha2 = md5(f"Default User:{login.REALM}:robotics"), md5(f"{method}:{uri}")
    fields = {
        "username": "Default User", "realm": login.REALM, "nonce": nonce, "uri": uri, "cnonce": "c",
        "response": md5(f"{ha1}:{nonce}:{nc}:c:auth:{ha2}"), **changed,
    }  # fmt: skip
    text = ", ".join(f'{name}="{value}"' for name, value in fields.items())
    return {"authorization": f"Digest {text}, qop=auth, nc={nc}", "host": "h"}


@pytest.fixture
def send(one):
    """Requests of a target with these headers; a nonce of the server."""

    def request(target="/rw/system", headers=None, method="GET"):
        return one.application.handle(HttpRequest(method, target, headers or {"host": "h"}))

    request.nonce = nonce_of(request())
    return request


def test_digest_is_accepted_once(send):
    headers = digest(send.nonce, "/rw/system")
    assert send(headers=headers).status == 200
    replayed = send(headers=headers)
    assert replayed.status == 401
    assert "stale=true" in replayed.header("www-authenticate")
    # Requests on several connections may arrive in another order.
    assert send(headers=digest(send.nonce, "/rw/system", "00000003")).status == 200
    assert send(headers=digest(send.nonce, "/rw/system", "00000002")).status == 200
    assert send(headers=digest(send.nonce, "/rw/system", "00000003")).status == 401


def test_digest_of_another_request_is_rejected(send):
    for signed in ("/rw/panel/opmode", "/rw/system?json=1", "/", ""):
        assert send(headers=digest(send.nonce, signed)).status == 401
    assert send(headers=digest(send.nonce, "/rw/system", method="POST")).status == 401
    assert send("/rw/system?json=1", digest(send.nonce, "/rw/system")).status == 401
    # The complete address is the same request, and so is another spelling of it.
    assert send(headers=digest(send.nonce, "http://h/rw/system")).status == 200
    assert send("/rw/%73ystem", digest(send.nonce, "/rw/system", "00000002")).status == 200


@pytest.mark.parametrize("count", ["1", "0x000001", "-0000001", "0000000g"])
def test_digest_without_a_count_is_rejected(send, count):
    assert send(headers=digest(send.nonce, "/rw/system", count)).status == 401


@pytest.mark.parametrize("name", ["uri", "cnonce", "response", "username", "nonce"])
def test_digest_with_undecodable_bytes_is_rejected(send, name):
    headers = digest(send.nonce, "/rw/system", **{name: "\udcff"})
    assert send(headers=headers).status == 401


def test_right_password_with_old_nonce_is_stale(send):
    answer = send(headers=digest("old", "/rw/system"))
    assert "stale=true" in answer.header("www-authenticate")
    wrong = send(headers=digest("old", "/rw/system", response="0" * 32))
    assert "stale" not in wrong.header("www-authenticate")


@pytest.mark.parametrize(
    ("origin", "status"),
    [(None, 204), ("http://h", 204), ("http://H", 204), ("http://other", 403), ("null", 403)],
)
def test_pages_of_other_servers_change_nothing(one, origin, status):
    form = {"ctrl-state": "motoroff"}
    target = "/rw/panel/ctrlstate?action=setctrlstate"
    assert one.post(target, form, origin=origin) == status
    assert one.application.controller.motors_on == (status == 403)


def test_session_without_login_begins_none(one):
    before = len(one.application.sessions)
    assert one.application.handle(HttpRequest("GET", "/rw/system", {"host": "h"})).status == 401
    assert len(one.application.sessions) == before
    assert Caller(one.application).get("/rw/system")


def status_of(opener, address):
    try:
        with opener.open(address, timeout=20) as reply:
            return reply.status
    except urllib.error.HTTPError as error:
        return error.code


@pytest.mark.parametrize(
    ("given", "user", "password", "status"),
    [
        (None, "Default User", "robotics", 200),
        ({"me": "secret"}, "me", "secret", 200),
        ({"me": "secret"}, "Default User", "robotics", 401),
    ],
    ids=["public", "given", "public beside given"],
)
def test_given_accounts_replace_the_public_ones(tmp_path, given, user, password, status):
    with make_runner(tmp_path, clock="real") as runner:
        runner.start()
        service = serve_rws(runner, Generation.ONE, accounts=Accounts(given) if given else None)
        try:
            address = f"http://{service.host}:{service.port}/rw/system"
            passwords = urllib.request.HTTPPasswordMgrWithDefaultRealm()
            passwords.add_password(None, address, user, password)
            no_proxy = urllib.request.ProxyHandler({})
            opener = urllib.request.build_opener(
                no_proxy, urllib.request.HTTPDigestAuthHandler(passwords)
            )
            assert status_of(opener, address) == status
        finally:
            service.close()
