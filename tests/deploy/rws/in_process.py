"""A client of a virtual controller in process, with interruptions.

It sends every request without a network.
"""

import base64
import hashlib
import threading

from rapidgen.client.errors import ConnectionLost
from rapidgen.client.rws import Controller
from rapidgen.client.rws.effects import (
    DropConnections,
    Exchange,
    FetchCertificate,
    LogIn,
    Pause,
    Response,
    UseEndpoint,
    resume,
)
from rapidgen.deploy.transports.rws import RwsTransport
from rapidgen.servers.rws.application import SESSION, Accounts, RwsApplication
from rapidgen.servers.rws.messages import HttpRequest, HttpResponse
from rapidgen.wire.rws.bodies import Generation

PASSWORD = "a-word-of-its-own"
CERTIFICATE = b"certificate"


class Line:
    """Where a client's requests go. `cut(number, got)` says how one is cut: "before" or "after" it
    was done; None: not at all."""

    def __init__(
        self,
        controller_runner,
        generation,
        *,
        strict=True,
        on_thread=False,
        cut=lambda number, got: None,
    ):
        self.runner, self.generation = controller_runner, generation
        accounts = Accounts({"Default User": PASSWORD})
        self.app = RwsApplication(controller_runner, generation, accounts, strict=strict)
        self.on_thread, self.cut = on_thread, cut
        self.count, self.log, self.dead = 0, [], False

    def request(self, got):
        if self.dead:
            raise _lost()
        self.count += 1
        self.log.append((got.method, got.target))
        if how := self.cut(self.count, got):
            self.dead = True
            if how == "after":
                self.handle(got)
            raise _lost()
        return self.handle(got)

    def handle(self, got):
        if not self.on_thread:
            pass_time(self.runner, 0.06)  # 20 requests a second are let through
            return self.app.handle(got)
        done, result, restarts = threading.Event(), [], self.runner.restarts
        if not self.runner.post(lambda: (result.append(self.app.handle(got)), done.set())):
            return HttpResponse(503)
        while not done.wait(0.05):
            if self.runner.restarts > restarts:
                return HttpResponse(503)  # no answer arrives any more
        return result[0]

    def pause(self, seconds):
        if self.on_thread:
            threading.Event().wait(seconds / self.runner.controller.scheduler.speed)
        else:
            pass_time(self.runner, seconds)


def _lost():
    return ConnectionLost.because("RG601", "the line is cut")


def pass_time(controller_runner, seconds):
    """Simulated time, over restarts."""
    due = controller_runner.now + seconds
    while controller_runner.now < due - 1e-9:
        restarts = controller_runner.restarts
        controller_runner.controller.scheduler.after(
            round((due - controller_runner.now) * 1e9), lambda: None
        )
        controller_runner.run(
            lambda n=restarts: controller_runner.now >= due - 1e-9 or controller_runner.restarts > n
        )


class AtDesk:
    """The carrier."""

    line: Line

    def __init__(self, core, timeout):
        self.core, self.cookies, self.way = core, {}, None

    def run(self, flow):
        outcome, failure = None, None
        while True:
            try:
                effect = resume(flow, outcome, failure)
            except StopIteration as end:
                return end.value
            outcome, failure = Response(0), None
            try:
                outcome = self.perform(effect)
            except BaseException as raised:  # noqa: BLE001
                failure = raised

    def perform(self, effect):
        match effect:
            case Exchange():
                return self.exchange(effect)
            case Pause():
                self.line.pause(effect.seconds)
            case FetchCertificate():
                is_one = self.line.generation is Generation.ONE
                return Response(0 if is_one else 200, body=CERTIFICATE)
            case UseEndpoint():
                self.way = None
                self.cookies.clear()
            case LogIn():
                self.way = effect.way
            case DropConnections():
                self.cookies.clear()
        return Response(0)

    def exchange(self, effect):
        headers = {"host": "h", **{k.lower(): v for k, v in effect.headers.items()}}
        if self.way and SESSION not in self.cookies:
            if self.way == "basic":
                word = base64.b64encode(f"{self.core.user}:{self.core.login.password}".encode())
                headers["authorization"] = f"Basic {word.decode()}"
            else:
                session = self.line.app.sessions.begin(self.core.user)
                self.cookies[SESSION] = session.key
        reply = self.line.request(
            HttpRequest(effect.method, effect.target, headers, effect.body, dict(self.cookies), 1)
        )
        self.cookies |= reply.cookies
        if reply.status == 401:
            self.cookies.pop(SESSION, None)
        text = {name.lower(): value for name, value in reply.headers}
        return Response(reply.status, text, reply.body)

    def close(self):
        pass


def connect(line) -> RwsTransport:
    """A transport over a line, logged in."""
    carrier = type("AtThisDesk", (AtDesk,), {"line": line})
    kind = type("ControllerAtDesk", (Controller,), {"_runner_type": carrier})
    fingerprint = (
        "" if line.generation is Generation.ONE else hashlib.sha256(CERTIFICATE).hexdigest()
    )
    controller = kind(
        "rws://cell",
        password=PASSWORD,
        fingerprint=fingerprint,
        pin_file=line.runner.folder / "known_controllers",
    )
    if not line.on_thread:
        controller._core.clock = lambda: line.runner.now
    controller.connect()
    return RwsTransport(controller, "rws://cell")
