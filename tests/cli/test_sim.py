"""`rapidgen sim` before it is ready: the ports that it needs, all of them."""

import json
import socket
import subprocess
import sys

import pytest

from rapidgen.cli.app import main


@pytest.fixture
def taken():
    with socket.socket() as held:
        held.bind(("127.0.0.1", 0))
        held.listen()
        yield held.getsockname()[1]


@pytest.mark.parametrize("role", ["motion", "control", "state"])
def test_a_port_that_is_taken_is_said_at_once(taken, role, capsys):
    assert main(["sim", "irb120", "--set", f"ports.{role}={taken}"]) == 1
    err = capsys.readouterr().err
    assert f"error[RG431]: port {taken} of 127.0.0.1 cannot be had" in err


def test_ready_tells_every_port_of_the_driver():
    command = [sys.executable, "-m", "rapidgen.cli", "sim", "irb120", "--ports", "auto"]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as server:
        try:
            ready = json.loads(server.stdout.readline().removeprefix("ready "))
        finally:
            server.terminate()
        assert set(ready["ports"]["rob1"]) == {"motion", "control", "state"}
    assert server.returncode == 0


@pytest.mark.parametrize("name", ["irb120", "cell.yaml"])
def test_run_does_not_take_a_configuration(tmp_path, monkeypatch, capsys, name):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cell.yaml").write_text("model: irb120\n")
    assert main(["run", name]) == 2
    assert f"rapidgen sim {name}" in capsys.readouterr().err
