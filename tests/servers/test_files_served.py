"""The file faces of a virtual controller: they serve HOME, and nothing but HOME."""

import ftplib
import io
import os
import socket
from pathlib import Path

import paramiko
import pytest

from rapidgen.diagnostics import DiagnosticError
from rapidgen.servers import serve_ftp, serve_sftp
from tests.ports import free_port


@pytest.fixture
def home(tmp_path):
    home = tmp_path / "HOME"
    home.mkdir()
    (home / "a.mod").write_bytes(b"MODULE a\r\nENDMODULE\r\n")
    (tmp_path / "secret.txt").write_text("outside")
    (home / "link").symlink_to(tmp_path / "secret.txt")
    (home / "up").symlink_to(tmp_path)
    return home


@pytest.fixture
def ftp(home):
    service = serve_ftp(home)
    client = ftplib.FTP(timeout=60)
    client.connect(service.host, service.port)
    client.login(service.user, service.password)
    yield client
    client.close()
    service.close()


@pytest.fixture
def sftp(home):
    service = serve_sftp(home)
    transport = paramiko.Transport((service.host, service.port))
    transport.connect(username=service.user, password=service.password)
    client = paramiko.SFTPClient.from_transport(transport)
    yield client
    transport.close()
    service.close()


def _ftp_read(client, path):
    out = io.BytesIO()
    client.retrbinary(f"RETR {path}", out.write)
    return out.getvalue()


def test_ftp_reads_writes_renames_and_deletes(ftp, home):
    assert _ftp_read(ftp, "a.mod") == b"MODULE a\r\nENDMODULE\r\n"
    ftp.mkd("sub")
    ftp.storbinary("STOR sub/b.new", io.BytesIO(b"\r\n\x00\xff"))
    ftp.rename("sub/b.new", "sub/b.mod")
    assert (home / "sub/b.mod").read_bytes() == b"\r\n\x00\xff"
    ftp.delete("sub/b.mod")
    ftp.rmd("sub")
    assert not (home / "sub").exists()


def test_ftp_has_no_mlsd_unless_asked(ftp):
    with pytest.raises(ftplib.error_perm, match="500"):
        list(ftp.mlsd())


OUTSIDE = ["../secret.txt", "link", "up/secret.txt", "/../../etc/passwd", "a\0b"]


@pytest.mark.parametrize("path", OUTSIDE[:-1])
def test_ftp_has_no_way_out(ftp, tmp_path, path):
    with pytest.raises(ftplib.error_perm):
        _ftp_read(ftp, path)
    if path != OUTSIDE[0]:  # `..` stops at the root, as in a chroot: that is HOME/secret.txt
        with pytest.raises(ftplib.error_perm):
            ftp.storbinary(f"STOR {path}", io.BytesIO(b"x"))
    assert (tmp_path / "secret.txt").read_text() == "outside"


def test_sftp_reads_writes_renames_and_deletes(sftp, home):
    with sftp.open("a.mod", "rb") as file:
        assert file.read() == b"MODULE a\r\nENDMODULE\r\n"
    sftp.mkdir("sub")
    with sftp.open("sub/b.new", "wb") as file:
        file.write(b"\r\n\x00\xff" * 20_000)
    (home / "sub/b.mod").write_bytes(b"old")
    with pytest.raises(OSError, match="Failure"):
        sftp.rename("sub/b.new", "sub/b.mod")
    sftp.posix_rename("sub/b.new", "sub/b.mod")
    assert (home / "sub/b.mod").read_bytes() == b"\r\n\x00\xff" * 20_000
    assert {"a.mod", "link", "sub", "up"} == set(sftp.listdir("."))
    assert sftp.stat("sub/b.mod").st_size == 80_000
    sftp.remove("sub/b.mod")
    sftp.rmdir("sub")
    assert not (home / "sub").exists()


@pytest.mark.parametrize("path", OUTSIDE)
def test_sftp_has_no_way_out(sftp, tmp_path, path):
    with pytest.raises(OSError, match=r"denied|No such"):
        sftp.open(path, "rb")
    if path != OUTSIDE[0]:
        with pytest.raises(OSError, match=r"denied|No such"):
            sftp.open(path, "wb")
    assert (tmp_path / "secret.txt").read_text() == "outside"
    assert "secret.txt" not in sftp.listdir("/..")


def test_sftp_removes_a_link_and_not_its_target(sftp, home, tmp_path):
    sftp.remove("link")
    assert not os.path.lexists(home / "link")
    assert (tmp_path / "secret.txt").exists()


def test_sftp_keeps_no_folder_open_that_it_refuses_to_read(sftp, home):
    for _ in range(3):
        with pytest.raises(OSError, match="Failure"):
            sftp.open("/", "rb")
    assert "a.mod" in sftp.listdir("/")
    held = [os.path.realpath(number) for number in Path("/proc/self/fd").iterdir()]
    assert str(home) not in held


def test_sftp_gives_no_shell(home):
    service = serve_sftp(home)
    try:
        with paramiko.Transport((service.host, service.port)) as transport:
            transport.connect(username=service.user, password=service.password)
            channel = transport.open_session()
            with pytest.raises(paramiko.SSHException):
                channel.exec_command("id")
    finally:
        service.close()


def test_wrong_passwords_are_refused(home):
    service = serve_ftp(home, password="right")
    client = ftplib.FTP(timeout=60)
    client.connect(service.host, service.port)
    with pytest.raises(ftplib.error_perm, match="530"):
        client.login(service.user, "wrong")
    client.close()
    service.close()
    service = serve_sftp(home, password="right")
    transport = paramiko.Transport((service.host, service.port))
    with pytest.raises(paramiko.AuthenticationException):
        transport.connect(username=service.user, password="wrong")
    transport.close()
    service.close()


@pytest.mark.parametrize("serve", [serve_ftp, serve_sftp])
def test_loopback_only_and_own_credentials(serve, home):
    for host in ("0.0.0.0", "192.168.125.1", "example.org"):
        with pytest.raises(DiagnosticError) as caught:
            serve(home, host)
        assert caught.value.diagnostics[0].code == "RG560"
    first, second = serve(home, port=free_port()), serve(home)
    assert first.password != second.password
    assert first.password not in repr(first)
    with pytest.raises(DiagnosticError) as caught:
        serve(home, "127.0.0.1", first.port)
    assert caught.value.diagnostics[0].code == "RG561"
    first.close()
    first.close()
    second.close()
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection((first.host, first.port), timeout=2)


@pytest.mark.parametrize(
    "command", ["SITE CHMOD 777 /", "SITE CHMOD 777 a.mod", "MFMT 20200101000000 /"]
)
def test_rights_and_times_of_this_machines_files_cannot_be_changed(ftp, home, command):
    before = home.stat()
    with pytest.raises(ftplib.error_perm, match="500"):
        ftp.voidcmd(command)
    assert (home.stat().st_mode, home.stat().st_mtime) == (before.st_mode, before.st_mtime)
