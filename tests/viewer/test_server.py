"""The page's server without a browser: who is let in, and what is given out."""

import asyncio
import json
import threading
from functools import partial
from http.client import HTTPConnection
from urllib.parse import urlsplit

import aiohttp
import pytest

from rapidgen.diagnostics import DiagnosticError
from rapidgen.viewer import server as serving
from rapidgen.viewer.messages import PendantAction, Positions, Request, Scene
from rapidgen.viewer.server import serve_page


class Watched:
    """Something that is watched, on a thread of its own."""

    def __init__(self):
        self._queue, self.asked = [], []
        self.allowed = threading.Event()
        self.allowed.set()
        self.restarting = False
        self._ready = threading.Condition()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self):
        while True:
            with self._ready:
                self._ready.wait_for(lambda: self._queue)
                function = self._queue.pop(0)
            if function is None:
                return
            function()

    def end(self):
        self.post(None)
        self._thread.join(60)

    def post(self, function):
        if self.restarting and "again" in str(getattr(function, "args", "")):
            self.restarting = False
        if self.restarting and isinstance(function, partial):
            return False
        with self._ready:
            self._queue.append(function)
            self._ready.notify_all()
        return True

    def wait_for(self, word, count):
        """Wait until so many functions with a word in their arguments wait."""

        def waiting():
            arguments = [str(getattr(function, "args", "")) for function in self._queue]
            return sum(word in text for text in arguments) >= count

        with self._ready:
            assert self._ready.wait_for(waiting, 60)

    def aspects(self):
        return (self,)

    def whole(self):
        yield Scene(title="a robot", kind="simulation", may_command=True, groups=())

    def changes(self):
        yield Positions(time=1.0, groups=())

    def handlers(self):
        return {PendantAction: self._act}

    def _act(self, request: Request):
        self.allowed.wait(60)
        self.asked.append(request)
        return "done"


@pytest.fixture
def page(tmp_path, monkeypatch):
    (tmp_path / "index.html").write_text("<!doctype html><title>page</title>")
    (tmp_path / "page.js").write_text("0")
    (tmp_path / "secret.py").write_text("no")
    monkeypatch.setattr(serving, "ASSETS", tmp_path)
    watched = Watched()
    (tmp_path / "outside.stl").write_text("secret")
    page = serve_page(watched, files={"mesh-1.stl": b"solid"})
    page_parts = urlsplit(page.url)
    yield page_parts.port, page_parts.fragment.removeprefix("token="), watched
    page.close()
    watched.end()


def ask(port, method, path, body=None, **headers):
    """Status and headers; the path goes out as it is."""
    connection = HTTPConnection("127.0.0.1", port, timeout=30)
    connection.putrequest(method, path, skip_host="Host" in headers)
    data = (body or "").encode()
    for name, value in {**headers, "Content-Length": str(len(data))}.items():
        connection.putheader(name, value)
    connection.endheaders(data)
    response = connection.getresponse()
    result = response.status, response.headers, response.read()
    connection.close()
    return result


def enter(port, token):
    origin = f"http://127.0.0.1:{port}"
    status, headers, _ = ask(port, "POST", "/session", token, Origin=origin)
    return status, headers.get("Set-Cookie", "")


def test_the_token_buys_a_cookie(page):
    port, token, _ = page
    status, cookie = enter(port, token)
    assert status == 204
    assert "SameSite=Strict" in cookie
    assert "HttpOnly" in cookie
    assert token not in cookie
    assert enter(port, token + "x") == (403, "")
    assert enter(port, "") == (403, "")
    own = cookie.partition(";")[0]
    assert ask(port, "GET", "/session", Cookie=own)[0] == 204
    assert ask(port, "GET", "/session", Cookie=own[:-1] + "-")[0] == 403
    assert ask(port, "GET", "/session")[0] == 403


@pytest.mark.parametrize("charset", ["nonsense", "hex", "utf-16", "unicode_escape", "a\x01b"])
def test_token_in_an_undecodable_charset_is_refused(page, charset):
    port, _, _ = page
    origin = f"http://127.0.0.1:{port}"
    kind = {"Content-Type": f"text/plain; charset={charset}", "Origin": origin}
    # Not UTF-16, and a lone surrogate for Python.
    assert ask(port, "POST", "/session", "\\ud800a", **kind)[0] == 400


@pytest.mark.parametrize("name", ["Cookie", "Origin", "Host"])
def test_headers_outside_ascii_are_refused(page, name):
    port, token, _ = page
    value = f"rapidgen-view-{port}=\xe9".encode("latin-1")
    for method, path in (("GET", "/session"), ("POST", "/session"), ("GET", "/link"), ("GET", "/")):
        assert ask(port, method, path, token, **{name: value})[0] == 400


def test_long_port_of_a_host_is_refused(page):
    port, _, _ = page
    assert ask(port, "GET", "/", Host=f"127.0.0.1:{'9' * 5000}")[0] == 421


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "https://127.0.0.1:{port}", ""])
def test_other_pages_do_not_enter(page, origin):
    port, token, _ = page
    headers = {"Origin": origin.format(port=port)} if origin else {}
    assert ask(port, "POST", "/session", token, **headers)[0] == 403


@pytest.mark.parametrize(
    "host",
    [
        "evil.example:{port}",
        "127.0.0.1",
        "127.0.0.1:1",
        "localhost.evil.example:{port}",
        "",
        ":{port}",
    ],
)
def test_other_names_of_this_machine_are_refused(page, host):
    port, _, _ = page
    assert ask(port, "GET", "/", Host=host.format(port=port))[0] in (400, 421)
    assert ask(port, "GET", "/", Host=f"localhost:{port}")[0] == 200


@pytest.mark.parametrize(
    "path",
    [
        "/../server.py",
        "/..%2fserver.py",
        "/%2e%2e/server.py",
        "/assets/../../server.py",
        "//etc/passwd",
        "/secret.py",
        "/page.js%00.html",
        "/..\\server.py",
        "/nothing",
    ],
)
def test_no_path_leaves_the_page(page, path):
    port, _, _ = page
    status, headers, body = ask(port, "GET", path)
    assert status in (400, 404)
    assert b"import" not in body
    assert b"root:" not in body
    assert "Content-Security-Policy" in headers or status == 400


@pytest.mark.parametrize(
    "name",
    [
        "",
        ".",
        "..",
        "../index.html",
        "..%2findex.html",
        "..%2Fsecret.py",
        "%2e%2e/secret.py",
        "..%5csecret.py",
        "%2fetc%2fpasswd",
        "/etc/passwd",
        "%252e%252e%252fsecret.py",
        "outside.stl",
        "./outside.stl",
        "mesh-1.stl%00",
        "mesh-1.stl%00.html",
        "mesh-1.stl/",
        "mesh-1.stl/..%2foutside.stl",
        "MESH-1.STL",
        "mesh-1.stl%0d%0aSet-Cookie:%20a=b",
        "file:%2f%2f%2fetc%2fpasswd",
        "%ff%fe",
    ],
)
def test_meshes_are_given_out_by_their_names_alone(page, name):
    port, token, _ = page
    own = enter(port, token)[1].partition(";")[0]
    status, headers, body = ask(port, "GET", f"/files/{name}", Cookie=own)
    assert status in (400, 403, 404)
    assert b"secret" not in body
    assert b"root:" not in body
    assert "Set-Cookie" not in headers
    assert ask(port, "GET", "/files/mesh-1.stl")[0] == 403
    status, headers, body = ask(port, "GET", "/files/mesh-1.stl", Cookie=own)
    assert (status, body) == (200, b"solid")
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert headers["Content-Type"].startswith("application/octet-stream")


def test_every_answer_has_the_policy(page):
    port, _, _ = page
    for path, status in (("/", 200), ("/page.js", 200), ("/nothing", 404), ("/link", 403)):
        result, headers, _ = ask(port, "GET", path)
        assert result == status
        policy = headers["Content-Security-Policy"]
        assert "script-src 'self'" in policy
        assert "unsafe" not in policy
        assert headers["X-Content-Type-Options"] == "nosniff"


def talk(port, token, message, count, **headers):
    """Send messages; return `count` replies, or the refusal."""
    origin = f"http://127.0.0.1:{port}"

    async def run():
        async with aiohttp.ClientSession(cookie_jar=aiohttp.CookieJar(unsafe=True)) as session:
            await session.post(f"{origin}/session", data=token, headers={"Origin": origin})
            async with session.ws_connect(
                f"{origin}/link", headers={"Origin": origin, **headers}
            ) as socket:
                for text in message:
                    await socket.send_str(text)
                got = []
                while sum(m["type"] == "reply" for m in got) < count:
                    got += json.loads((await socket.receive(30)).data)
                return got

    return asyncio.run(run())


def test_a_link_needs_the_cookie_and_the_origin(page):
    port, token, _ = page
    with pytest.raises(aiohttp.WSServerHandshakeError, match="403"):
        talk(port, token + "x", [], 0)
    with pytest.raises(aiohttp.WSServerHandshakeError, match="403"):
        talk(port, token, [], 0, Origin="http://evil.example")


def test_requests_are_answered_by_number_and_nonsense_is_refused(page):
    port, token, watched = page
    message = [
        '{"id": 1, "request": {"do": "act", "action": "start"}}',
        '{"id": 2, "request": {"do": "act", "action": "explode"}}',
        '{"id": 3, "request": {"do": "mode", "mode": "auto"}}',
        '{"id": 4, "request": {"do": "override", "value": NaN}}',
        "[" * 5000,
        "null",
    ]
    got = talk(port, token, message, len(message))
    assert got[0]["type"] == "scene"
    replies = [m for m in got if m["type"] == "reply"]
    assert replies[0] == {"type": "reply", "id": 1, "error": "", "text": "done"}
    assert replies[2]["id"] == 3
    assert "accepts no such request" in replies[2]["error"]
    assert all(reply["error"] for reply in replies[1:])
    assert [requested.action for requested in watched.asked] == ["start"]


def test_a_viewer_that_floods_does_not_starve_the_others(page):
    port, token, watched = page
    origin = f"http://127.0.0.1:{port}"
    flood, crowd = 1000, 50

    def request(number, action):
        return json.dumps({"id": number, "request": {"do": "act", "action": action}})

    async def replies(socket, count):
        result = []
        while len(result) < count:
            messages = json.loads((await socket.receive(60)).data)
            result += [m["id"] for m in messages if m["type"] == "reply"]
        return result

    async def run():
        async with aiohttp.ClientSession(cookie_jar=aiohttp.CookieJar(unsafe=True)) as session:
            await session.post(f"{origin}/session", data=token, headers={"Origin": origin})
            sockets = [
                await session.ws_connect(f"{origin}/link", headers={"Origin": origin})
                for _ in range(crowd + 1)
            ]
            flooding, *others = sockets
            # Nothing is carried out until all have asked: what is before them was let in first.
            watched.allowed.clear()
            for number in range(flood):
                await flooding.send_str(request(number, "stop"))
            for socket in others:
                await socket.send_str(request(1, "start"))
            await asyncio.to_thread(watched.wait_for, "start", crowd)
            watched.allowed.set()
            for socket in others:
                assert await replies(socket, 1) == [1]
            assert await replies(flooding, flood) == [*range(flood)]
            for socket in sockets:
                await socket.close()

    asyncio.run(run())
    requested = [request.action for request in watched.asked]
    assert (requested.count("start"), requested.count("stop")) == (crowd, flood)
    assert requested[: crowd + 50].count("start") == crowd


def test_requests_that_are_not_taken_do_not_use_up_the_places(page):
    port, token, watched = page
    watched.restarting = True
    act = {"id": 1, "request": {"do": "act", "action": "start"}}
    message = [json.dumps(act)] * 40 + ["again"] + [json.dumps({**act, "id": 2})]
    got = talk(port, token, message, 2)
    assert [m["id"] for m in got if m["type"] == "reply"] == [0, 2]


def test_unbuilt_page_is_reported(tmp_path, monkeypatch):
    monkeypatch.setattr(serving, "ASSETS", tmp_path)
    with pytest.raises(DiagnosticError, match="has not been built"):
        serve_page(Watched())


def test_a_weak_token_is_refused(page, monkeypatch):
    monkeypatch.setenv("RAPIDGEN_VIEW_TOKEN", "secret")
    with pytest.raises(DiagnosticError, match="not a token"):
        serve_page(Watched())


def test_used_port_is_reported(page):
    with pytest.raises(DiagnosticError, match="cannot serve the page"):
        serve_page(Watched(), port=page[0])
