"""Sockets on which a simulator listens: docs/use/sockets.md names each kind, and where it is."""

import re
from pathlib import Path

import pytest

SECURITY = Path(__file__).parents[2] / "docs" / "use" / "sockets.md"
HOST = "127.0.0.2"  # loopback, too, but not the default


def listening(pid):
    """(address, port) of every TCP socket on which a process listens [proc(5)]."""
    own = set()
    for path in Path(f"/proc/{pid}/fd").iterdir():
        target = str(path.readlink()) if path.is_symlink() else ""
        if match := re.fullmatch(r"socket:\[(\d+)\]", target):
            own.add(match[1])
    rows = [row.split() for row in Path(f"/proc/{pid}/net/tcp").read_text().splitlines()[1:]]
    six = Path(f"/proc/{pid}/net/tcp6")
    rows += [row.split() for row in six.read_text().splitlines()[1:]] if six.exists() else []
    places = [row[1].split(":") for row in rows if row[3] == "0A" and row[9] in own]
    return {
        (".".join(str(byte) for byte in reversed(bytes.fromhex(address))), int(port, 16))
        for address, port in places
    }


def ports_of(value):
    """Port numbers that a value of `ready` names."""
    if isinstance(value, dict):
        if "port" in value:
            return {value["port"]}
        return {port for inner in value.values() for port in ports_of(inner)}
    if isinstance(value, str) and (found := re.match(r"\w+://[\d.]+:(\d+)", value)):
        return {int(found[1])}
    return {value} if isinstance(value, int) else set()


@pytest.fixture(scope="module")
def rows():
    """Rows of the table by the keys of `ready` that they name."""
    text = SECURITY.read_text().partition("## Every listening socket")[2].partition("\n## ")[0]
    table = [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in text.splitlines()
        if line.startswith("|")
    ]
    assert table[0][1:4] == ["in `ready`", "listens on", "who may connect"]
    assert all(len(row) == len(table[0]) and all(row) for row in table)
    return [(set(re.findall(r"`(\w+)`", row[1])), row) for row in table[2:]]


@pytest.mark.skipif(not Path("/proc/self/net/tcp").exists(), reason="no /proc of Linux")
def test_the_table_names_every_socket_that_sim_listens_on(start, rows):
    sim = start(
        *("irb120", "--ports", "auto", "--host", HOST, "--view"),
        *("--ftp", "0", "--sftp", "0", "--rws", "1"),
    )
    named = {key for keys, _ in rows for key in keys}
    of_port = {}
    for key in named & {*sim.ready}:
        for port in ports_of(sim.ready[key]):
            of_port.setdefault(port, set()).add(key)
    result = listening(sim.process.pid)
    assert len(result) == 8  # motion, state, control; control socket; FTP, SFTP, RWS; page
    for address, port in result:
        assert port in of_port, f"{address}:{port} is not in the table"
        # What follows --host says so in its row.
        for keys, row in rows:
            if of_port[port] & keys:
                assert ("`--host`" in row[2].partition(", whatever")[0]) == (address == HOST), row
    assert {key for keys in of_port.values() for key in keys} == named
