"""The whole life of a deployment over real servers."""

import os
from pathlib import Path

import pytest

from rapidgen.deploy import TransportFault, backup_set, make_plan
from rapidgen.diagnostics import DiagnosticError
from tests.refusal import refusal

OLD, NEW = "aaaaaaaaaaaa", "bbbbbbbbbbbb"
FTP = ("pyftpdlib", "vsftpd", "proftpd", "pure-ftpd")
ALL = (*FTP, "paramiko", "sshd")
pytestmark = pytest.mark.server


@pytest.mark.parametrize("server", ALL, indirect=True)
def test_life_of_a_deployment(kit, server):
    (server.home / "mine.mod").write_text("mine")
    old, new = kit.driver(OLD), kit.driver(NEW, drop=("rapidgen/ROS_stateServer.mod",))
    transport = server.connect()
    kit.deploy(transport, old)
    assert kit.verdict(server.home, old) == "set 0"
    transport.close()
    transport = server.connect()
    assert make_plan(transport, old).is_empty
    kit.deploy(transport, new)
    assert kit.verdict(server.home, new) == "set 0"
    kit.deploy(transport, backup_set(transport, "", 2), verb="rollback")
    assert kit.verdict(server.home, old) == "set 0"
    kit.deploy(transport, None, verb="uninstall")
    transport.close()
    assert [p.name for p in server.home.iterdir()] == ["mine.mod"]


@pytest.mark.parametrize("server", ALL, indirect=True)
def test_odd_names_and_contents_come_through(server):
    transport = server.connect()
    folder = "a folder (1)/with spaces"
    transport.make_folder(folder)
    data = bytes(range(256)) * 300 + b"\r\n\n\r"
    transport.write(f"{folder}/a file.mod", data)
    assert transport.read(f"{folder}/a file.mod") == data
    transport.write(f"{folder}/empty", b"")
    assert transport.read(f"{folder}/empty") == b""
    entries = {e.name: e for e in transport.entries(folder)}
    assert (entries["a file.mod"].size, entries["a file.mod"].folder) == (len(data), False)
    assert {e.name for e in transport.entries("")} == {"a folder (1)"}
    for missing in ("nope", f"{folder}/nope", "nope/nope"):
        for action in (transport.read, transport.delete, transport.entries):
            with pytest.raises(TransportFault) as caught:
                action(missing)
            assert caught.value.kind == "missing"
    transport.close()


@pytest.mark.parametrize("server", ALL, indirect=True)
def test_wrong_login_is_refused_and_says_no_password(server, monkeypatch):
    if server.kind == "vsftpd":
        url = server.url.replace("anonymous", "unknown")
    else:
        url = server.url
    monkeypatch.setenv("RAPIDGEN_PASSWORD", "wr0ng-pass")
    from rapidgen.deploy import connect, parse_target
    from rapidgen.deploy.target import Access

    access = Access(known_hosts=server.access.known_hosts)
    if server.kind == "sshd":
        monkeypatch.setenv("HOME", str(server.home))  # no keys there
        monkeypatch.delenv("SSH_AUTH_SOCK", raising=False)
    (result,) = refusal(connect, parse_target(url), access).diagnostics
    assert result.code == "RG502"
    assert "wr0ng-pass" not in result.message + result.help + str(result.notes)


@pytest.mark.parametrize("server", ["paramiko", "sshd"], indirect=True)
def test_host_keys_must_be_known_and_the_same(server, tmp_path):
    from dataclasses import replace

    import paramiko

    from rapidgen.deploy import connect

    empty = tmp_path / "empty"
    empty.write_text("")
    with pytest.raises(DiagnosticError, match="is not known") as caught:
        connect(server.target, replace(server.access, known_hosts=str(empty)))
    (result,) = caught.value.diagnostics
    assert result.code == "RG503"
    # What the help says to add makes the connection work.
    empty.write_text(result.help.splitlines()[-1] + "\n")
    connect(server.target, replace(server.access, known_hosts=str(empty))).close()
    words = empty.read_text().split()
    other = paramiko.ECDSAKey.generate()
    name, text = (other.get_name(), other.get_base64())
    if words[1] != name:
        other_ed = Path(tmp_path / "other")
        import subprocess

        subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", other_ed], check=True)
        name, text = Path(f"{other_ed}.pub").read_text().split()[:2]
    empty.write_text(f"{words[0]} {name} {text}\n")
    with pytest.raises(DiagnosticError, match="has changed") as caught:
        connect(server.target, replace(server.access, known_hosts=str(empty)))
    assert caught.value.diagnostics[0].code == "RG503"


@pytest.mark.parametrize("server", ALL, indirect=True)
def test_a_read_only_home_is_refused_before_anything_changes(kit, server):
    if server.kind in ("pyftpdlib", "paramiko", "sshd", "vsftpd", "proftpd") and os.geteuid() == 0:
        blocker = server.home / "rapidgen_deploy"
        blocker.write_text("root may write everywhere: a file where the folder has to go")
    else:
        server.home.chmod(0o555)
    before = sorted(p.name for p in server.home.iterdir())
    transport = server.connect()
    with pytest.raises(DiagnosticError) as caught:
        kit.deploy(transport, kit.driver(OLD))
    transport.close()
    assert caught.value.diagnostics[0].code == "RG506"
    assert sorted(p.name for p in server.home.iterdir()) == before
    server.home.chmod(0o755)
