"""Controllers with web services, one for each generation, on ports of this machine."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "servers" / "rws"))

from served import make_runner

from rapidgen.servers.rws.server import serve_rws
from rapidgen.wire.rws.bodies import Generation

SPEED = 60
"""Simulated seconds in a second: the controller's limit of requests is on its own clock."""


class Served:
    """A controller, its service and the client's arguments."""

    def __init__(self, controller_runner, service, generation, folder):
        self.runner = controller_runner
        self.service = service
        self.generation = generation
        self.pins = folder / "known"

    @property
    def address(self):
        return f"rws://{self.service.host}:{self.service.port}"

    @property
    def keywords(self):
        """How a client is made."""
        return {
            "password": self.service.password,
            "fingerprint": self.service.host_key,
            "pin_file": self.pins,
        }

    def on_controller(self, function):
        """The outcome of a function on the controller's thread."""
        import threading

        done, result = threading.Event(), []
        assert self.runner.post(lambda: (result.append(function()), done.set()))
        assert done.wait(60)
        return result[0]


@pytest.fixture(params=list(Generation), ids=lambda g: f"rws{g.value}")
def served(request, tmp_path):
    generation = request.param
    with make_runner(tmp_path, generation, clock="real", speed=SPEED) as controller_runner:
        controller_runner.start()
        service = serve_rws(controller_runner, generation)
        yield Served(controller_runner, service, generation, tmp_path)
        service.close()


@pytest.fixture
def served_two(tmp_path):
    with make_runner(tmp_path, Generation.TWO, clock="real", speed=SPEED) as controller_runner:
        controller_runner.start()
        service = serve_rws(controller_runner, Generation.TWO)
        yield Served(controller_runner, service, Generation.TWO, tmp_path)
        service.close()


ASKING = """MODULE MainModule
    VAR rmqslot sender;
    VAR rmqmessage message;
    VAR rmqheader header;
    PERS num key := 0;
    PERS num number := 0;
    PERS string text := "";
    PERS num got := 0;
    VAR num answer;
    PROC main()
        TPReadFK answer, "Which one?", "Left", "Right", "", "", "None";
        key := answer;
        TPReadNum answer, "How many?";
        number := answer;
        text := UIAlphaEntry(\\Message:="Who?");
        RMQReadWait message;
        RMQGetMsgHeader message \\Header:=header \\SenderId:=sender;
        RMQGetMsgData message, answer;
        got := answer;
        RMQSendMessage sender, "thanks";
    ENDPROC
ENDMODULE
"""


@pytest.fixture(params=list(Generation), ids=lambda g: f"rws{g.value}")
def asking(request, tmp_path):
    """A controller whose program asks."""
    with make_runner(
        tmp_path, request.param, program=ASKING, clock="real", speed=SPEED
    ) as controller_runner:
        controller_runner.start()
        service = serve_rws(controller_runner, request.param)
        yield Served(controller_runner, service, request.param, tmp_path)
        service.close()
