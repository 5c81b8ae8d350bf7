"""`rapidgen sim --ftp --sftp`: a deployment arrives in the HOME of a running controller."""

import ftplib
import io
import os
import socket
import subprocess
import sys

RAPIDGEN = [sys.executable, "-m", "rapidgen.cli"]


def rapidgen(*arguments, **environment):
    return subprocess.run(
        [*RAPIDGEN, *arguments],
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, **environment},
    )


def test_sftp_deployment_arrives_in_home_of_running_sim(start, tmp_path):
    sim = start("irb120", "--ports", "auto", "--ftp", "0", "--sftp", "0")
    sftp, ftp = sim.ready["sftp"], sim.ready["ftp"]
    assert sftp["password"] != ftp["password"]
    known = tmp_path / "known_hosts"
    known.write_text(sftp["host_key"] + "\n")
    url = f"sftp://Default%20User@127.0.0.1:{sftp['port']}"
    target = ["irb120", "--to", url, "--known-hosts", str(known)]
    secret = {"RAPIDGEN_PASSWORD": sftp["password"]}
    done = rapidgen("deploy", *target, "--yes", **secret)
    assert done.returncode == 0, done.stderr
    assert sftp["password"] not in done.stdout + done.stderr
    assert rapidgen("plan", *target, "--detailed-exitcode", **secret).returncode == 0
    # The other face shows the same files, and they are what `build` writes.
    built = tmp_path / "built"
    assert rapidgen("build", "irb120", "--output", str(built)).returncode == 0
    modules = [path for path in (built / "HOME").rglob("*") if path.is_file()]
    assert len(modules) > 3
    with ftplib.FTP(timeout=60) as client:
        client.connect("127.0.0.1", ftp["port"])
        client.login(ftp["user"], ftp["password"])
        for module in modules:
            result = io.BytesIO()
            path = module.relative_to(built / "HOME").as_posix()
            client.retrbinary(f"RETR {path}", result.write)
            assert result.getvalue() == module.read_bytes(), path
    code, out, err = sim.end()
    assert (code, out) == (0, "")
    assert "Traceback" not in err


def test_used_file_port_and_network_host_are_rejected():
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        in_use = rapidgen("sim", "irb120", "--ports", "auto", "--sftp", str(port))
    assert (in_use.returncode, in_use.stdout) == (1, "")
    assert "RG561" in in_use.stderr
    outside = rapidgen("sim", "irb120", "--ports", "auto", "--host", "0.0.0.0", "--ftp", "0")
    assert (outside.returncode, outside.stdout) == (2, "")
    assert "RG560" in outside.stderr
    for process in (in_use, outside):
        assert "Traceback" not in process.stderr
    assert rapidgen("sim", "irb120", "--ftp", "65536").returncode == 2
