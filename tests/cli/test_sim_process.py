"""`rapidgen sim`: a process of its own, over real sockets."""

import signal
import socket
import struct
import subprocess
import sys

import pytest

from rapidgen.cli.app import main
from tests.ports import free_port

JOINT, STATUS = 10, 13
SIM = [sys.executable, "-m", "rapidgen.cli", "sim"]


def message(sock, comm=1, reply=0):
    """One message, by default of the state server: (type, data)."""
    length, kind, *head = struct.unpack("<4i", sock.recv(16, socket.MSG_WAITALL))
    assert head == [comm, reply]
    return kind, sock.recv(length - 12, socket.MSG_WAITALL)


def point(sequence, joints, duration):
    values = (*joints, *([0.0] * (10 - len(joints))), 0.0, duration)
    return struct.pack("<4ii12f", 64, 11, 1, 0, sequence, *values)


def test_a_shipped_robot_serves_moves_and_ends_cleanly(start):
    sim = start("irb120", "--ports", "auto")
    ports = sim.ready["ports"]["rob1"]
    assert sim.ready["name"] == "irb120"
    assert set(ports) == {"motion", "control", "state"}
    with sim.connect(ports["motion"]) as motion, sim.connect(ports["state"]) as state:
        assert {message(state)[0] for _ in range(4)} == {JOINT, STATUS}
        for sequence, angle in ((-1, 0.0), (1, 0.05), (-3, 0.1)):
            motion.sendall(point(sequence, [angle] + [0.0] * 5, 0.3))
        reached = 0.0
        while abs(reached - 0.1) > 1e-4:
            kind, data = message(state)
            if kind == JOINT:
                reached = struct.unpack_from("<i10f", data)[1]
    status = sim.control(do="status")["result"]
    assert status["groups"]["rob1"]["positions"][0] == pytest.approx(0.1, abs=1e-4)
    code, out, err = sim.end()
    assert (code, out) == (0, "")
    assert "Traceback" not in err


def test_the_control_socket_commands_the_controller(start):
    sim = start("irb120", "--ports", "auto")
    assert sim.control(do="status")["result"]["motors_on"] is True
    for token in ({"token": sim.ready["token"][:-1]}, {"token": ""}):
        refused = sim.control(do="e-stop", **token)
        assert not refused["ok"]
        assert "token" in refused["error"]
    assert sim.control(do="status")["result"]["e_stop"] is False
    assert sim.control(do="e-stop")["ok"]
    status = sim.control(do="status")["result"]
    assert (status["motors_on"], status["e_stop"]) == (False, True)
    codes = [event["code"] for event in sim.control(do="log")["result"]]
    assert 10_013 in codes
    assert sim.control(do="get", task="T_ROB1", name="nothing")["ok"] is False
    assert sim.control(do="override", value=101)["ok"] is False
    assert sim.control(do="mode", value="sleepy")["ok"] is False
    assert sim.end(signal.SIGTERM)[0] == 0


def test_servers_come_back_where_they_were_after_a_power_failure(start):
    sim = start("irb120", "--ports", "auto")
    port = sim.ready["ports"]["rob1"]["state"]
    with sim.connect(port) as state:
        message(state)
        sim.control(do="power-loss")
        while state.recv(65_536):
            pass
    status = sim.control(do="status")["result"]
    while "11002" not in status["listeners"]:
        status = sim.control(do="status")["result"]
    assert status["listeners"]["11002"] == port
    with sim.connect(port) as state:
        assert message(state)[0] in (JOINT, STATUS)


def test_cold(start):
    sim = start("irb120", "--ports", "auto", "--motors-off")
    status = sim.control(do="status")["result"]
    assert status["motors_on"] is False
    assert status["tasks"]["T_ROB1"] == "ready"
    sim.control(do="motors-on")
    sim.control(do="start")
    assert sim.control(do="status")["result"]["tasks"]["T_ROB1"] == "running"


SERVER = """MODULE echo
    VAR socketdev server;
    VAR socketdev client;
    PROC main()
        VAR string text;
        SocketCreate server;
        SocketBind server, "192.168.125.1", 5000;
        SocketListen server;
        SocketAccept server, client \\Time:=WAIT_MAX;
        WHILE TRUE DO
            SocketReceive client \\Str:=text \\Time:=WAIT_MAX;
            SocketSend client \\Str:=text + "!";
        ENDWHILE
    ENDPROC
ENDMODULE
""".replace("\\\\", "\\")
SYS = """SYS:CFG_1.0:6:0::
#
CAB_TASKS:

      -Name "T_ROB1" -Type "NORMAL" -Entry "main" -MotionTask
"""


def a_backup(folder, text):
    """A backup of one task with one module."""
    backup = folder / "cell_3"
    (backup / "RAPID" / "TASK1" / "PROGMOD").mkdir(parents=True)
    (backup / "SYSPAR").mkdir()
    (backup / "HOME").mkdir()
    (backup / "RAPID" / "TASK1" / "PROGMOD" / "echo.mod").write_text(text)
    (backup / "SYSPAR" / "SYS.cfg").write_text(SYS)
    return backup


def test_sim_boots_backup_of_foreign_program(start, tmp_path):
    """The address in it is the controller's own; here it is this machine, on any free port."""
    backup = a_backup(tmp_path, SERVER)
    sim = start(str(backup), "--ports", "auto")
    assert sim.ready["ports"] == {}
    with sim.connect(sim.ready["listeners"]["5000"]) as sock:
        sock.sendall(b"hello")
        assert sock.recv(100) == b"hello!"
    code, _, err = sim.end()
    assert code == 0
    assert "RG432" in err


def test_a_lone_module_is_ready_where_its_server_waits(start, tmp_path):
    """All tasks stand in SocketAccept then, and nothing else would ever happen."""
    module = tmp_path / "echo.mod"
    module.write_text(SERVER)
    sim = start(str(module), "--ports", "auto")
    with sim.connect(sim.ready["listeners"]["5000"]) as sock:
        sock.sendall(b"hello")
        assert sock.recv(100) == b"hello!"
    code, _, err = sim.end()
    assert code == 0
    assert "SocketAccept waits for a client on port 5000" in err


def test_a_server_that_an_error_stops_is_not_called_ready(tmp_path):
    module = tmp_path / "echo.mod"
    module.write_text(SERVER.replace("SocketCreate server", "TPWrite NumToStr(1/0,0)"))
    code, out, err = failing(str(module), "--ports", "auto")
    assert (code, out) == (1, "")
    assert "RG430" in err


def test_several_tasks_in_a_described_cell(start, tmp_path):
    (tmp_path / "echo.mod").write_text(SERVER)
    (tmp_path / "talk.mod").write_text(
        "MODULE talk\n PROC main()\n  WaitDI diGo, 1;\n  SetDO doGone, 1;\n ENDPROC\nENDMODULE\n"
    )
    (tmp_path / "cell.yaml").write_text("signals: {diGo: {kind: DI}, doGone: {kind: DO}}")
    tasks = ("--task", f"T_ECHO={tmp_path}/echo.mod", "--task", f"T_TALK={tmp_path}/talk.mod")
    cell = ("--cell", str(tmp_path / "cell.yaml"), "--robot", "irb1600")
    sim = start(*tasks, *cell, "--ports", "auto")
    assert "5000" in sim.ready["listeners"]
    sim.control(do="set-signal", name="diGo", value=1)
    while not sim.control(do="signals")["result"]["doGone"]:
        pass
    code, _, err = sim.end()
    assert code == 0
    assert "waits for diGo = 1; diGo is 0" in err


def test_faults_reach_real_sockets(start, tmp_path):
    plan = tmp_path / "plan.yaml"
    plan.write_text(
        "network:\n  - {do: silent, port: 11002, direction: out, after: 60}\n"
        "controller:\n  - {do: motors-off, at: 0.2}\n"
    )
    sim = start("irb120", "--ports", "auto", "--faults", str(plan))
    with sim.connect(sim.ready["ports"]["rob1"]["state"]) as state:
        data = b""
        while len(data) < 60:
            data += state.recv(1000)
        state.settimeout(0.5)
        with pytest.raises(TimeoutError):
            state.recv(1)
    assert len(data) == 60
    while sim.control(do="status")["result"]["motors_on"]:
        pass


EXPOSED = (
    *("--set", "signals.gripper={kind: DO, access: write}"),
    *("--set", "signals.part={kind: DI}"),
    *("--set", "signals.code={kind: GO, access: write}"),
    *("--set", "signals.flow={kind: AI}"),
)


def of_signal(sock, index, value=None):
    """Read or write a signal over a group's control connection; its value then."""
    write = value is not None
    sock.sendall(struct.pack("<4i2if", 24, 1307, 2, 0, index, write, value or 0.0))
    kind, data = message(sock, 3, 1)
    assert kind == 1307
    assert struct.unpack_from("<i", data)[0] == index
    return struct.unpack_from("<f", data, 4)[0]


@pytest.mark.parametrize("built", [False, True])
def test_signals_that_the_configuration_exposes_are_there(start, tmp_path, built):
    """They are the customer's, so that no generated EIO.cfg has them; here they are made."""
    target = ["irb120", *EXPOSED]
    if built:
        out = tmp_path / "out"
        assert main(["build", *target, "-o", str(out)]) == 0
        assert "gripper" not in (out / "EIO.cfg").read_text()
        target = [str(out)]
    sim = start(*target, "--ports", "auto")
    with sim.connect(sim.ready["ports"]["rob1"]["control"]) as own:
        assert of_signal(own, 0, 1) == 1
        assert sim.control(do="signals")["result"]["gripper"] == 1
        sim.control(do="set-signal", name="part", value=1)
        assert of_signal(own, 1) == 1
        assert of_signal(own, 2, 70_000) == 70_000
        sim.control(do="set-signal", name="flow", value=1.5)
        assert of_signal(own, 3) == 1.5


def test_unloadable_program_is_rejected_with_all_errors(tmp_path):
    """As `run` does it."""
    backup = a_backup(tmp_path, SERVER.replace("SocketListen", "text := 1;\n        SocketListen"))
    code, out, err = failing(str(backup), "--ports", "auto")
    assert (code, out) == (2, "")
    assert "RG307" in err
    code, out, err = failing(str(backup), "--ports", "auto", "--no-check")
    assert (code, out) == (1, "")
    assert "RG430" in err


def failing(*arguments):
    done = subprocess.run([*SIM, *arguments], capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout, done.stderr


def test_port_in_use_is_reported_before_boot():
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        offset = other.getsockname()[1] - 11_000
        code, out, err = failing("irb120", "--port-offset", str(offset))
    assert (code, out) == (1, "")
    assert "RG431" in err


@pytest.mark.parametrize("role", ["motion", "control", "state"])
def test_each_port_is_looked_at(role, capsys):
    # (Another user's simulator may run on the configuration's own ones.)
    ports = {name: free_port() for name in ("motion", "control", "state")}
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        in_use = ports[role] = other.getsockname()[1]
        text = [word for name, port in ports.items() for word in ("--set", f"ports.{name}={port}")]
        assert main(["sim", "irb120", *text]) == 1
    assert f"error[RG431]: port {in_use} of 127.0.0.1 is not available" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        (("irb999",), 2),
        (("irb120", "--host", "example.org"), 2),
        (("irb120", "--ports", "auto", "--port-offset", "1"), 2),
        (("irb120", "--port-offset", "60000"), 2),
        (("irb120", "--speed", "0"), 2),
        (("irb120", "--faults", "/no/such/file"), 2),
        ((__file__,), 2),
    ],
)
def test_bad_usage(arguments, code):
    got, out, err = failing(*arguments)
    assert (got, out) == (code, "")
    assert "Traceback" not in err
