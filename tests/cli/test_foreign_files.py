"""Files that are a pipe, a device, a link or too large: no command waits for one or reads it."""

import io
import os
import resource
import shutil
import signal

import pytest

from rapidgen.cli.app import main

SECRET = "canary-content"
MEMORY = 2 << 30
"""Bytes that a command may take beside what is there: far less than the large files have."""
WAIT = 100
"""s after which a command is taken for one that waits: none takes a second."""

FILES = """
bad.yaml    check bad.yaml
bad.yaml    build bad.yaml
bad.yaml    stop bad.yaml
bad.yaml    ros1 bad.yaml --output out
bad.yaml    ros2 bad.yaml --output out
bad.yaml    run good.mod --robot bad.yaml
bad.yaml    run good.mod --cell bad.yaml
bad.yaml    run good.mod --answers bad.yaml
bad.yaml    sim good.mod --ports auto --faults bad.yaml
bad.mod     check bad.mod
bad.mod     fmt --check bad.mod
bad.mod     run bad.mod
bad.mod     run --task T_ROB1=bad.mod
bad.pgf     run bad.pgf
SYS.cfg     check SYS.cfg
bad.urdf    new out.yaml --urdf bad.urdf
bad.xacro   new out.yaml --urdf bad.xacro
bad.urdf    check urdf.yaml
bad.mcap    view bad.mcap
bad.mcap    view bad.mcap --csv out.csv
bad.csv     plot bad.csv
bad.csv     plot good.csv bad.csv
bad.csv     move irb120 bad.csv --to 127.0.0.1:9
bad.json    move irb120 bad.json --to 127.0.0.1:9
bad.txt     plan irb120 --to @bad.txt
bad.json    deploy irb120 --yes --to dir://deployed --plan bad.json
bad.toml    plan irb120 --to ftp://127.0.0.1:9/HOME --secrets bad.toml
bad.toml    status rws://127.0.0.1:9 --secrets bad.toml
"""
"""What is named on the command line: a link is followed."""

IN_FOLDERS = """
backup/SYSPAR/SYS.cfg                        check irb120 --backup backup
backup/SYSPAR/EIO.cfg                        build irb120 --backup backup
backup/SYSPAR/MMC.cfg                        plan irb120 --to dir://deployed --backup backup
backup/SYSPAR/SYS.cfg                        doctor irb120 --to dir://deployed --backup backup
backup/SYSPAR/SYS.cfg                        run backup
backup/SYSPAR/EIO.cfg                        run backup
backup/BACKINFO/backinfo.txt                 run backup
backup/RAPID/TASK1/PROGMOD/Work.mod          run backup
backup/RAPID/TASK1/PROGMOD/Work.mod          check backup
built/manifest.json                          run built
built/SYS.cfg                                run built
built/HOME/rapidgen/ROS_common.sys           run built
built/HOME/rapidgen/ROS_common.sys           plan built --to dir://deployed
deployed/HOME/rapidgen_deploy/manifest.json  plan irb120 --to dir://deployed
deployed/HOME/rapidgen_deploy/manifest.json  rollback irb120 --yes --to dir://deployed
deployed/HOME/rapidgen/ROS_common.sys        deploy irb120 --yes --to dir://deployed
deployed/HOME/rapidgen/ROS_common.sys        uninstall irb120 --yes --to dir://deployed
deployed/SYSPAR/SYS.cfg                      plan irb120 --to dir://deployed
deployed/SYSPAR/MMC.cfg                      plan irb120 --to dir://deployed
"""
"""What lies in a folder that is named: a link that leads out of it is not followed."""

MODULE = "MODULE Work\n    PROC main()\n    ENDPROC\nENDMODULE\n"
BACKUP = {
    "SYSPAR/SYS.cfg": 'SYS:CFG_1.0:6:0::\n#\nCAB_TASKS:\n\n      -Name "T_ROB1" -MotionTask\n',
    "SYSPAR/EIO.cfg": "EIO:CFG_1.0:6:1::\n",
    "BACKINFO/backinfo.txt": ">>VERSION OF ROBOTWARE\nRobotWare 6.08\n",
    "RAPID/TASK1/PROGMOD/Work.mod": MODULE,
    "HOME/notes.txt": "",
}


def pipe(path, _):
    os.mkfifo(path)


def device(path, _):
    path.symlink_to("/dev/zero")


def large(path, _):
    with path.open("wb") as file:
        file.truncate(1 << 36)


def link(path, outside):
    path.symlink_to(outside)


def rows(text, makers):
    """(path, command, maker) of each line and maker."""
    lines = [line.split(maxsplit=1) for line in text.strip().splitlines()]
    return [
        pytest.param(path, command, make, id=f"{make.__name__}-{command}-{path}")
        for path, command in lines
        for make in makers
    ]


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    """A backup, a generated folder, and a backup with a deployed driver."""
    place = tmp_path_factory.mktemp("folders")
    for name, text in BACKUP.items():
        path = place / "backup" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    shutil.copytree(place / "backup", place / "deployed")
    assert main(["build", "irb120", "-o", f"{place}/built"]) == 0
    assert main(["deploy", f"{place}/built", "--to", f"dir://{place}/deployed", "--yes"]) == 0
    return place


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    monkeypatch.delenv("RAPIDGEN_PASSWORD", raising=False)
    monkeypatch.setattr("sys.stdin", io.StringIO())
    (tmp_path / "good.mod").write_text(MODULE)
    (tmp_path / "good.csv").write_text("time,joint_1\n0,0\n1,0.1\n")
    (tmp_path / "urdf.yaml").write_text("urdf: {file: bad.urdf}\n")
    (tmp_path / "deployed").mkdir()
    return tmp_path


def status(command, place):
    """The exit code of a command, which may not take for ever or all memory."""

    def waits(*_):
        raise AssertionError("the command waits, or reads without end")

    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    before = signal.signal(signal.SIGALRM, waits)
    with open("/proc/self/statm") as file:
        in_use = int(file.read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (in_use + MEMORY, hard))
    signal.alarm(WAIT)
    try:
        return main(command.replace("dir://", f"dir://{place}/").split())
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


@pytest.mark.parametrize(("path", "command", "make"), rows(FILES, (pipe, device, large)))
def test_a_file_is_refused(place, capsys, path, command, make):
    make(place / path, None)
    assert status(command, place) in (1, 2)
    message = "".join(capsys.readouterr())
    assert "error[RG" in message
    assert "help" in message
    assert path in message


@pytest.mark.parametrize(("path", "command", "make"), rows(IN_FOLDERS, (pipe, device, large, link)))
def test_a_file_in_a_folder_is_refused(folders, place, capsys, path, command, make):
    name = path.partition("/")[0]
    shutil.copytree(folders / name, place / name, dirs_exist_ok=True)
    secret = place / "outside"
    secret.write_text(SECRET)
    (place / path).unlink(missing_ok=True)
    make(place / path, secret)
    assert status(command, place) in (1, 2)
    out, err = capsys.readouterr()
    assert "[RG" in err or "RG" in out
    assert os.path.basename(path) in out + err
    assert SECRET not in out + err


def test_links_pipes_and_devices_in_home_are_left_out(folders, place, capsys):
    shutil.copytree(folders / "backup", place / "backup")
    secret = place / "outside"
    secret.write_text(SECRET)
    for make in (pipe, device, link):
        make(place / "backup/HOME" / make.__name__, secret)
    (place / "backup/RAPID/TASK1/PROGMOD/Work.mod").write_text(
        MODULE.replace(
            "    ENDPROC",
            "".join(
                f'        TPWrite "{name}" + ValToStr(IsFile("HOME:/{name}"));\n'
                for name in ("notes.txt", "pipe", "device", "link")
            )
            + "    ENDPROC",
        )
    )
    assert status("run backup", place) == 0
    message = capsys.readouterr().out
    assert "notes.txtTRUE" in message
    assert all(f"{make.__name__}FALSE" in message for make in (pipe, device, link))
