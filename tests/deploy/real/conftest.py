"""Debian's own servers, each on loopback with a configuration of ours, as little root as possible.

They come from PATH or from build/servers (`.ci/servers`). A server that is missing skips its
tests loudly; with CI=true it fails them.
"""

import getpass
import logging
import os
import platform
import pwd
import shutil
import socket
import subprocess
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

import pytest

from rapidgen.deploy import Access, connect, parse_target
from rapidgen.deploy.transports.registry import Target
from rapidgen.servers import serve_ftp, serve_sftp
from tests.ports import free_port, own_address

ROOT = Path(__file__).parents[3]
UNPACKED = ROOT / "build" / "servers" / "root"
USER, PASSWORD = "Default User", "robot-test"
HASH = "$1$rapidgen$Z4.YQEqmTI.KLC/JtVMCd."  # of PASSWORD, as AuthUserFile wants it
IS_ROOT = os.geteuid() == 0
UNPRIVILEGED = 65534


@dataclass
class Server:
    """A running server: `home` is the folder it serves, `url` leads there."""

    kind: str
    home: Path
    port: int
    url: str
    access: Access
    target: Target

    def connect(self, port: int | None = None):
        url = self.url if port is None else self.url.replace(str(self.port), str(port))
        return connect(parse_target(url), self.access)


def program(name: str, *places: str) -> str:
    """Path of a server; skips, or fails under CI, when there is none."""
    search = os.pathsep.join([os.environ.get("PATH", ""), "/usr/sbin", *places])
    search += f"{os.pathsep}{UNPACKED}/usr/sbin{os.pathsep}{UNPACKED}/usr/bin"
    result = shutil.which(name, path=search)
    if result is None:
        absent(f"{name}: run .ci/servers, or install it")
    return str(result)


def absent(what: str) -> NoReturn:
    """Fail under CI, skip elsewhere."""
    if os.environ.get("CI") == "true":
        pytest.fail(f"this machine has no {what}")
    pytest.skip(f"this machine has no {what}")


def environment() -> dict[str, str]:
    triplet = f"{platform.machine()}-linux-gnu"
    libraries = [str(UNPACKED / "usr/lib" / triplet), str(UNPACKED / "lib" / triplet)]
    return {**os.environ, "LD_LIBRARY_PATH": os.pathsep.join(libraries)}


def start(command: list[str], host: str, port: int, folder: Path) -> subprocess.Popen:
    """Start a server and wait until it greets, as servers of FTP and of SSH do."""
    log = (folder / "log").open("wb")
    process = subprocess.Popen(
        command,
        env=environment(),
        stdin=subprocess.DEVNULL,
        stdout=log,
        stderr=log,
    )
    log.close()
    end = time.monotonic() + 60
    while True:
        try:
            with socket.create_connection((host, port), timeout=1) as probe:
                probe.settimeout(max(1, end - time.monotonic()))
                greeted = bool(probe.recv(1))
        except OSError:
            greeted = False
        finished = process.poll() is not None
        if greeted and not finished:
            return process
        if finished or time.monotonic() > end:
            process.kill()
            process.wait()
            text = (folder / "log").read_text(errors="replace")
            pytest.fail(f"{command[0]} does not start: {text}")
        select_nothing(0.02)


def select_nothing(seconds: float) -> None:
    """Wait for a server of another project to listen: it says so in no other way."""
    import select

    select.select([], [], [], seconds)


def stop(process: subprocess.Popen) -> None:
    process.terminate()
    try:
        process.wait(5)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def vsftpd(folder: Path, home: Path, host: str, port: int) -> tuple[list[str], str, Access]:
    config = folder / "vsftpd.conf"
    config.write_text(
        f"""listen=YES
listen_address={host}
listen_port={port}
background=NO
run_as_launching_user=YES
anonymous_enable=YES
no_anon_password=YES
anon_root={home}
write_enable=YES
anon_upload_enable=YES
anon_mkdir_write_enable=YES
anon_other_write_enable=YES
anon_umask=022
anon_world_readable_only=NO
allow_writeable_chroot=YES
seccomp_sandbox=NO
xferlog_enable=NO
ftp_username={getpass.getuser()}
nopriv_user={getpass.getuser()}
"""
    )
    return [program("vsftpd"), str(config)], f"anonymous@{host}", Access()


def proftpd(folder: Path, home: Path, host: str, port: int) -> tuple[list[str], str, Access]:
    import grp

    users = folder / "users"
    users.write_text(f"{USER}:{HASH}:{os.getuid()}:{os.getgid()}::{home}:/bin/sh\n")
    users.chmod(0o600)
    config = folder / "proftpd.conf"
    config.write_text(
        f"""ServerName test
ServerType standalone
DefaultServer on
DefaultAddress {host}
SocketBindTight on
Port {port}
User {getpass.getuser()}
Group {grp.getgrgid(os.getgid()).gr_name}
AuthUserFile {users}
AuthOrder mod_auth_file.c
RequireValidShell off
RootLogin on
PidFile {folder}/pid
ScoreboardFile {folder}/scoreboard
DelayEngine off
WtmpLog off
TransferLog none
UseReverseDNS off
AllowOverwrite on
Umask 022
"""
    )
    command = [program("proftpd"), "-n", "-q", "-c", str(config)]
    return command, f"Default%20User@{host}", Access()


def pure_ftpd(folder: Path, home: Path, host: str, port: int) -> tuple[list[str], str, Access]:
    if not IS_ROOT:
        pytest.skip("pure-ftpd of Debian starts as root only")
    tool = program("pure-pw")
    database = folder / "pure.pdb"
    users = folder / "users"
    if home.stat().st_uid == 0:
        os.chown(home, UNPRIVILEGED, UNPRIVILEGED)
    # The tool refuses a user name with a space; the server reads what the file says.
    users.write_text(f"{USER}:{HASH}:{UNPRIVILEGED}:{UNPRIVILEGED}::{home}/./::::::::::::\n")
    subprocess.run([tool, "mkdb", str(database), "-f", str(users)], check=True, env=environment())
    command = [program("pure-ftpd"), "-S", f"{host},{port}", "-l", f"puredb:{database}"]
    command += ["-g", str(folder / "pid"), "-u", "1", "-H", "-U", "022:022"]
    return command, f"Default%20User@{host}", Access()


def sshd(folder: Path, home: Path, host: str, port: int) -> tuple[list[str], str, Access]:
    for name in ("host", "client"):
        command = ["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", str(folder / name)]
        subprocess.run(command, check=True)
    shutil.copy(folder / "client.pub", folder / "authorized")
    config = folder / "sshd.conf"
    config.write_text(
        f"""ListenAddress {host}
Port {port}
HostKey {folder}/host
AuthorizedKeysFile {folder}/authorized
PermitRootLogin yes
PidFile {folder}/pid
PasswordAuthentication no
KbdInteractiveAuthentication no
StrictModes no
UsePAM no
Subsystem sftp internal-sftp
"""
    )
    key = (folder / "host.pub").read_text()
    (folder / "known_hosts").write_text(f"[{host}]:{port} {key}")
    access = Access(identity=str(folder / "client"), known_hosts=str(folder / "known_hosts"))
    user = getpass.getuser()
    if IS_ROOT:
        Path("/run/sshd").mkdir(exist_ok=True)  # where root's sshd separates privileges
        if "sshd" not in {entry.pw_name for entry in pwd.getpwall()}:
            absent("user sshd, which root's sshd needs: install openssh-server")
    return [program("sshd"), "-D", "-e", "-f", str(config)], f"{user}@{host}", access


DEBIAN = {"vsftpd": vsftpd, "proftpd": proftpd, "pure-ftpd": pure_ftpd, "sshd": sshd}
OURS = {"pyftpdlib": serve_ftp, "paramiko": serve_sftp}
FTP = ("pyftpdlib", "vsftpd", "proftpd", "pure-ftpd")
ALL = (*FTP, "paramiko", "sshd")


@pytest.fixture
def server(request, monkeypatch, caplog) -> Iterator[Server]:
    """The server that the test's parameter names (indirect)."""
    kind = request.param
    monkeypatch.setenv("RAPIDGEN_PASSWORD", PASSWORD)
    # (A server may take away its pid file at the same time.)
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as name:
        folder = Path(name)
        folder.chmod(0o755)
        home = folder / "HOME"
        home.mkdir()
        host = own_address()
        if kind in OURS:
            service = OURS[kind](home, host, user=USER, password=PASSWORD)
            # pytest shows its output if a test fails.
            caplog.set_level(logging.DEBUG, "pyftpdlib")
            scheme = "ftp" if kind == "pyftpdlib" else "sftp"
            known = folder / "known_hosts"
            known.write_text(service.host_key + "\n")
            url = f"{scheme}://Default%20User@{host}:{service.port}"
            access = Access(known_hosts=str(known))
            yield Server(kind, home, service.port, url, access, parse_target(url))
            service.close()
            return
        port = free_port()
        command, login, access = DEBIAN[kind](folder, home, host, port)
        process = start(command, host, port, folder)
        scheme = "sftp" if kind == "sshd" else "ftp"
        # The login ends in HOME: there is no path to give.
        place = str(home) if kind in ("sshd",) else ""
        url = f"{scheme}://{login}:{port}{place}"
        try:
            yield Server(kind, home, port, url, access, parse_target(url))
        finally:
            stop(process)
