"""Attach to a simulator: its token, a shared debugger, and what is left when the client goes."""

import json
import socket
import subprocess
import sys
import threading
import time
from contextlib import contextmanager

import pytest

from rapidgen._message_streams import MessageStream
from rapidgen.controller.boot_targets import load_target
from rapidgen.controller.debugger import Breakpoint
from rapidgen.controller.runner import ControllerRunner
from rapidgen.dap.attach import Endpoint
from rapidgen.servers.control_commands import READABLE, commands, subscribe
from rapidgen.servers.control_socket import ControlSocket
from tests.dap.own_client import Refused

LOOP = """MODULE m
  PERS num total := 0;
  PROC main()
    WHILE TRUE DO
      total := total + 1;
      WaitTime 0.01;
    ENDWHILE
  ENDPROC
ENDMODULE
"""


@contextmanager
def simulator(path):
    """A running controller with the control socket of `sim`."""
    with ControllerRunner.boot(load_target([str(path)]), clock="real", cycle="forever") as runner:
        control = ControlSocket(
            runner.controller.scheduler,
            {**commands(runner.controller), "debug": Endpoint(runner).open},
            lambda listener, trusted: subscribe(runner.controller, listener, trusted),
            readable=READABLE,
        )
        runner.on_restart.append(control.close)
        runner.start()
        try:
            yield runner, control
        finally:
            runner.stop()
            if not runner.restarts:
                control.close()


def attach(client, control, token=None):
    client.ask("initialize", adapterID="rapidgen", linesStartAt1=False)
    client.ask("attach", control=control.address[1], token=token or control.token)
    client.event("initialized")


def _posted(runner, function):
    done, result = threading.Event(), []

    def run():
        result.append(function())
        done.set()

    assert runner.post(run)
    assert done.wait(10)
    return result[0]


def test_session_on_a_simulator_leaves_it_running(client, program):
    path = program(LOOP)
    with simulator(path) as (runner, control):
        attach(client, control)
        (placed,) = client.set_lines(path, 4)  # lines of this client begin at 0
        assert placed["verified"]
        client.ask("configurationDone")
        _, frame = client.stopped()
        assert frame["line"] == 4
        assert int(client.value("total", frame)) > 0
        client.ask("disconnect")
        client.event("terminated")
        before = _posted(runner, lambda: runner.controller.now)
        assert _posted(runner, lambda: runner.debugger.placed) == {}
        end = time.monotonic() + 10
        while _posted(runner, lambda: runner.controller.now) <= before:
            assert time.monotonic() < end


def test_breakpoints_and_pauses_of_others_are_seen(client, program):
    path = program(LOOP)
    with simulator(path) as (runner, control):
        attach(client, control)
        client.ask("configurationDone")
        # As the page of the simulator does.
        number = _posted(runner, lambda: runner.debugger.add(Breakpoint("m", 5)).number)
        new = client.event("breakpoint")
        assert (new["reason"], new["breakpoint"]["line"]) == ("new", 4)
        client.stopped()
        _posted(runner, lambda: runner.debugger.remove(number))
        assert client.event("breakpoint")["reason"] == "removed"
        _posted(runner, runner.debugger.resume)
        client.event("continued")


def test_restart_of_the_controller_keeps_breakpoints(client, program):
    path = program(LOOP)
    with simulator(path) as (runner, control):
        attach(client, control)
        client.set_lines(path, 4)
        client.ask("configurationDone")
        client.stopped()
        client.ask("restart")
        client.event("invalidated")
        _posted(runner, lambda: runner.controller.perform("motors-on"))
        client.value(":start", context="repl")
        assert client.stopped()[1]["line"] == 4
        assert runner.restarts == 1


@pytest.mark.parametrize("token", ["wrong", "\ud800"])
def test_wrong_token_is_rejected(client, program, token):
    with simulator(program(LOOP)) as (_, control), pytest.raises(Refused, match="RG940"):
        attach(client, control, token)


def test_wrong_port_is_rejected(client):
    with socket.create_server(("127.0.0.1", 0)) as closed:
        port = closed.getsockname()[1]
    client.ask("initialize")
    with pytest.raises(Refused, match="no simulator"):
        client.ask("attach", control=port, token="x")
    with pytest.raises(Refused):
        client.ask("attach", control=10**9, token="x")


def test_endpoint_admits_its_key_only(program):
    with simulator(program(LOOP)) as (runner, _):
        answer = Endpoint(runner).open({})
        with socket.create_connection(("127.0.0.1", answer["port"]), timeout=10) as own:
            stream = MessageStream(own.recv, own.sendall)
            stream.write({"key": "wrong"})
            assert own.recv(1) == b""  # the connection is closed at once; 10 s are not awaited


@pytest.mark.long
def test_command_sim_serves_debug_sessions(client, program):
    path = program(LOOP)
    with subprocess.Popen(
        [sys.executable, "-m", "rapidgen", "sim", str(path)], stdout=subprocess.PIPE, text=True
    ) as process:
        try:
            ready = json.loads(process.stdout.readline().removeprefix("ready "))
            client.ask("initialize")
            client.ask("attach", control=ready["control"], token=ready["token"])
            client.event("initialized")
            client.set_lines(path, 5)
            client.ask("configurationDone")
            assert client.stopped()[1]["line"] == 5
        finally:
            process.terminate()
