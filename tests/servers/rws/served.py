"""A controller with a small program, and RWS applications over it."""

from dataclasses import replace

from rapidgen.config import load_config
from rapidgen.controller.runner import ControllerRunner
from rapidgen.servers.rws.application import SESSION, Accounts, RwsApplication
from rapidgen.servers.rws.messages import HttpRequest
from rapidgen.system import read_files
from rapidgen.system.model import SignalSpec
from rapidgen.wire.rws import media
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.forms import form_type, write_form

MAIN = """MODULE MainModule
    PERS num x := 1;
    PERS string name := "a";
    PERS num list{3} := [1,2,3];
    PERS robtarget puck_target := [[0,0,600],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR num count := 0;
    CONST num c := 4;
    PROC main()
        WHILE TRUE DO
            count := count + x;
            WaitTime 0.1;
        ENDWHILE
    ENDPROC
ENDMODULE
"""
RELEASES = {Generation.ONE: (6, 15), Generation.TWO: (7, 6), Generation.EIGHT: (7, 6)}
SIGNALS = (
    SignalSpec("do x;1", "DO", access="All"),
    SignalSpec("doDefault", "DO"),
    SignalSpec("diStart", "DI", access="All", device="DRV_1"),
    SignalSpec("aoSpeed", "AO", access="All"),
)
STARTED = {
    "regain": "continue", "execmode": "continue", "cycle": "asis", "condition": "none",
    "stopatbp": "disabled", "alltaskbytsp": "false",
}  # fmt: skip


def make_runner(
    folder, generation=Generation.ONE, program=MAIN, tasks=(), **options
) -> ControllerRunner:
    """A controller with T_ROB1 and a main, and no driver: motors on, the program stands."""
    path = folder / "MainModule.mod"
    path.write_text(program)
    system = replace(read_files([path]), robotware=RELEASES[generation], signals=SIGNALS)
    system = replace(system, tasks=(*system.tasks, *tasks))
    chosen = {"robots": load_config("irb120").groups, "autostart": False, **options}
    return ControllerRunner(system, **chosen)


class Caller:
    """A session of an application: no network, the controller's own thread."""

    def __init__(self, app: RwsApplication, user: str = "Default User") -> None:
        self.application = app
        self.session = app.sessions.begin(user)
        self.accept = media.HAL

    @property
    def is_one(self):
        """True for RWS 1.0."""
        return self.application.generation is Generation.ONE

    def send(self, method, target, form=None, body=None, **headers):
        """A request of this session; its HttpResponse."""
        one = self.application.generation is Generation.ONE
        sent = {"host": "h"}
        if not one:
            sent["accept"] = self.accept
        if method in ("POST", "DELETE", "PUT"):
            sent["content-type"] = form_type(self.application.generation)
        data = body if body is not None else write_form(form or {})
        given = {name.replace("_", "-"): value for name, value in headers.items()}
        sent = {k: v for k, v in {**sent, **given}.items() if v is not None}
        cookies = {SESSION: self.session.key}
        return self.application.handle(HttpRequest(method, target, sent, data, cookies, 1))

    def get(self, target, **headers):
        """The items of a GET that succeeds."""
        reply = self.send("GET", target, **headers)
        assert reply.status == 200, reply
        return media.read(reply.body, reply.header("content-type")).items

    def post(self, target, form=None, **headers):
        """The status of a POST."""
        return self.send("POST", target, form, **headers).status


def code_of(reply):
    """ABB's code in a refusal."""
    return media.read(reply.body, reply.header("content-type")).fault.code


def make_application(
    controller_runner, generation=Generation.ONE, strict=True, **denied
) -> RwsApplication:
    """An application with ABB's own login."""
    accounts = Accounts({"Default User": "robotics", "Admin": "robotics"}, **denied)
    return RwsApplication(controller_runner, generation, accounts, strict=strict)
