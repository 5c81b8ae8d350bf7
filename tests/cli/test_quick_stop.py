"""`rapidgen stop` before anything heavy is imported: what it sends, and where."""

import socket
import subprocess
import sys
from contextlib import ExitStack
from pathlib import Path

import pytest

from rapidgen._data import data_folder
from rapidgen.cli import send_stop
from rapidgen.cli.send_stop import STOP, addresses, control_addresses, group_ports, motion_ports
from rapidgen.client.address import parse_address
from rapidgen.client.core.robot import STOP_FRAME
from rapidgen.config import load_config, shipped_names
from rapidgen.diagnostics import DiagnosticError

ROBOTS = data_folder("robots")
EXAMPLES = sorted(Path(ROBOTS, "examples").glob("*.yaml"))


def test_it_is_the_codecs_stop():
    assert STOP == STOP_FRAME


@pytest.mark.parametrize(
    "target", [*shipped_names(), *map(str, EXAMPLES)], ids=lambda t: t.rpartition("/")[2]
)
def test_ports_are_those_of_the_configuration(target):
    path = target if "/" in target else f"{ROBOTS}/{target}.yaml"
    complete = {group.name: group.ports.motion for group in load_config(target).groups}
    assert motion_ports(path) == complete


@pytest.mark.parametrize(
    "text",
    [
        "model: irb120\nports: {motion: 12000, state: 12002}\n",
        "model: irb120 # mine\nports:\n  state: 12002\n  motion: 12000  # free\nname: cell\n",
        "model: irb14000\ngroups:\n  rob_r:\n    ports: {motion: 12000}\n",
        "groups:\n  a:\n    model: irb120\n  b:\n    model: irb1200\n    ports: {motion: 12000}\n",
        "model: irb120\ndescription: |\n  ports: {motion: 1}\n  more, and more\n",
        "model: irb120\ntool: {name: t,\n  load: {mass: 1, centre: [0,\n  0, 1]}}\n",
    ],
)
def test_files_of_a_users_own(tmp_path, text):
    path = tmp_path / "cell.yaml"
    path.write_text(text)
    complete = {group.name: group.ports.motion for group in load_config(path).groups}
    assert motion_ports(str(path)) == complete


@pytest.mark.parametrize(
    "text",
    [
        "{model: irb120, ports: {motion: 12000}}\n",
        "model: irb120\nports: &own {motion: 12000}\n",
        "model: irb120\nports: {motion: 12000,\n  state: 12002}\n",
        'model: irb120\n"ports": {motion: 12000}\n',
        "model: irb120\nports: {motion: 12000}\nports: {motion: 13000}\n",
        "model: irb120\ngroups: {rob1: {ports: {motion: 12000}}}\n",
        "model: irb14000\nports: {motion: 12000}\n",
        "model: irb14000\ngroups:\n  rob_r: *other\n",
        "model: irb120\nports: {motion: 0x2EE0}\n",
    ],
)
def test_ambiguous_arguments_send_no_early_stop(tmp_path, text):
    path = tmp_path / "cell.yaml"
    path.write_text(text)
    assert motion_ports(str(path)) == {}
    assert addresses([str(path)]) == []


@pytest.mark.parametrize(
    ("text", "places"),
    [
        (["10.0.0.1"], [("10.0.0.1", 11000)]),
        (["robot.lab:12000,12002,12001"], [("robot.lab", 12000)]),
        (["[::1]:12000"], [("::1", 12000)]),
        (["irb120"], [("127.0.0.1", 11000)]),
        (["irb120", "--to", "10.0.0.1"], [("10.0.0.1", 11000)]),
        (["--to=10.0.0.1:12000,12002", "irb120", "--json"], [("10.0.0.1", 12000)]),
        (["irb14000", "--to", "10.0.0.1"], [("10.0.0.1", 11000), ("10.0.0.1", 11010)]),
        (["irb14000", "--group", "rob_r"], [("127.0.0.1", 11010)]),
        (["irb14000", "--group", "rob_x"], []),
        (["--help"], []),
        (["irb120", "--help"], []),
        (["irb120", "irb1200"], []),
        (["irb120", "--grup", "rob1"], []),
        (["irb120x", "--to", "10.0.0.1"], []),
        (["nowhere.yaml"], []),
        (["10.0.0.1:70000"], []),
        (["a b"], []),
        ([], []),
    ],
)
def test_where_it_goes(text, places):
    assert addresses(text) == places
    assert control_addresses(text) == [
        (host, 12001 if port == 12000 else port + 1) for host, port in places
    ]


@pytest.mark.parametrize(
    "text",
    [
        "model: irb120\n",
        "model: irb120\nports: {control: 0}\n",
        "model: irb120\nports: {motion: 12000, control: 12005}\n",
        "model: irb120\nports:\n  state: 12002\n  motion: 12000\n  control: 0\n",
        "model: irb14000\ngroups:\n  rob_r:\n    ports: {control: 12000}\n",
    ],
)
@pytest.mark.parametrize(
    "address",
    [
        "10.0.0.1",
        "10.0.0.1:12000",
        "10.0.0.1:12000,12002",
        "10.0.0.1:12000,12003",
        "10.0.0.1:12000,12002,0",
        "10.0.0.1:12000,12002,500",
        "10.0.0.1:65535",
    ],
)
def test_early_stop_uses_control_port_of_client(tmp_path, text, address):
    path = tmp_path / "cell.yaml"
    path.write_text(text)
    groups = {group.name: group.ports for group in load_config(path).groups}
    assert group_ports(str(path)) == {n: (p.motion, p.state, p.control) for n, p in groups.items()}
    for name, ports in groups.items():
        try:
            control = parse_address(address, ports).control
        except DiagnosticError:
            continue
        words = [str(path), "--group", name, "--to", address]
        assert control_addresses(words) == ([("10.0.0.1", control)] if control else [])


def test_the_first_bytes_of_the_command_are_stop():
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(60)
        process = subprocess.Popen(
            [sys.executable, "-m", "rapidgen.cli", "stop", f"127.0.0.1:{server.getsockname()[1]}"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            link, _ = server.accept()
            with link:
                link.settimeout(60)
                assert link.makefile("rb").read(len(STOP)) == STOP
        finally:
            process.kill()
            process.wait()


def test_stop_goes_to_both_ports_at_once():
    with ExitStack() as stack:
        servers = [stack.enter_context(socket.create_server(("127.0.0.1", 0))) for _ in range(2)]
        motion, control = (server.getsockname()[1] for server in servers)
        # Neither answers, and the state port is another's: neither waits for anything else.
        send_stop.send([f"127.0.0.1:{motion},1,{control}"])
        for server in servers:
            server.settimeout(60)
            link = stack.enter_context(server.accept()[0])
            assert link.makefile("rb").read() == STOP


@pytest.mark.parametrize("refused", [0, 1])
def test_refused_port_does_not_delay_the_other(refused):
    with socket.create_server(("127.0.0.1", 0)) as server:
        with socket.create_server(("127.0.0.1", 0)) as gone:
            free = gone.getsockname()[1]
        ports = [server.getsockname()[1], free]
        motion, control = reversed(ports) if refused == 0 else ports
        send_stop.send([f"127.0.0.1:{motion},1,{control}"])
        server.settimeout(60)
        with server.accept()[0] as link:
            assert link.makefile("rb").read() == STOP


def test_a_name_with_several_addresses_is_tried_at_all(monkeypatch):
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
        wrong = (socket.AF_INET, socket.SOCK_STREAM, 0, "", ("127.0.0.3", port))
        right = (socket.AF_INET, socket.SOCK_STREAM, 0, "", ("127.0.0.1", port))
        monkeypatch.setattr(socket, "getaddrinfo", lambda *_, **__: [wrong, right])
        send_stop.send([f"robot.lab:{port},1"])
        server.settimeout(60)
        with server.accept()[0] as link:
            assert link.makefile("rb").read() == STOP


def test_no_group_waits_for_the_answer_of_another(monkeypatch):
    servers = [socket.create_server(("127.0.0.1", 0)) for _ in range(2)]
    places = [("127.0.0.1", server.getsockname()[1]) for server in servers]
    monkeypatch.setattr(send_stop, "addresses", lambda _: places)
    # No server answers; what was sent waits in the backlogs.
    send_stop.send([])
    for server in servers:
        server.settimeout(60)
        with server, server.accept()[0] as link:
            assert link.makefile("rb").read(len(STOP)) == STOP


def test_nothing_heavy_is_imported_before_it():
    script = (
        "import sys\n"
        "from rapidgen.cli import entry, send_stop\n"
        "assert send_stop.addresses(['irb14000']) == "
        "[('127.0.0.1', 11000), ('127.0.0.1', 11010)]\n"
        "own = {n for n in sys.modules if n.startswith('rapidgen')}\n"
        "heavy = {'typer', 'numpy', 'ruamel', 'asyncio', 'threading', 'json', 'dataclasses'}\n"
        "print(sorted(own), sorted(heavy & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.stdout == (
        "['rapidgen', 'rapidgen._data', 'rapidgen._reading', 'rapidgen.cli', "
        "'rapidgen.cli.entry', 'rapidgen.cli.send_stop'] []\n"
    ), done.stderr
