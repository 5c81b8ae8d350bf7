"""What the machine refuses: full disks, closed streams, names that it does not take."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from rapidgen._atomic_write import write_whole
from rapidgen.cli.app import main
from rapidgen.config import load_config
from rapidgen.generate import build
from tests.refusal import refusal, refused

GOOD = 'MODULE Good\n    PROC main()\n        TPWrite "hi";\n    ENDPROC\nENDMODULE\n'


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "good.mod").write_text(GOOD)
    return tmp_path


def shell(command, folder, **environment):
    """Run `$RG ...` in bash: streams are closed and redirected as a user would."""
    return subprocess.run(
        ["bash", "-c", command],
        cwd=folder,
        capture_output=True,
        text=True,
        env={**os.environ, "RG": f"{sys.executable} -m rapidgen.cli", **environment},
    )


@pytest.mark.parametrize("text", ["explain all", "run good.mod", "robots", "--help"])
def test_full_disk_is_reported(folder, text):
    done = shell(f"$RG {text} >/dev/full", folder)
    assert done.returncode == 1
    assert "error[RG903]: cannot continue: No space left" in done.stderr
    assert "Traceback" not in done.stderr


def test_removed_current_folder_is_reported(folder):
    done = shell("mkdir gone && cd gone && rmdir ../gone && $RG build irb120", folder)
    assert done.returncode == 2
    assert "error[RG903]: cannot continue: No such file" in done.stderr


@pytest.mark.parametrize("text", ["explain all", "run good.mod", "robots"])
def test_a_closed_stdout_is_no_fault(folder, text):
    done = shell(f"$RG {text} >&-", folder)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("text", ["explain all", "run good.mod", "robots", "schema"])
def test_broken_pipe_is_not_an_error(folder, text):
    reader, writer = os.pipe()
    os.close(reader)
    with os.fdopen(writer, "wb") as gone:
        done = subprocess.run(
            [sys.executable, "-m", "rapidgen.cli", *text.split()],
            cwd=folder,
            stdout=gone,
            stderr=subprocess.PIPE,
        )
    # 128 + SIGPIPE: what a shell shows of a program that the signal ends.
    assert (done.returncode, done.stderr) == (141, b"")


@pytest.mark.parametrize("text", ["check nowhere.mod", "robots show none", "run good.mod"])
def test_nor_one_of_the_errors(folder, text):
    done = shell(f"{{ sleep 0.2; $RG {text}; echo $? >code; }} 2>&1 | true", folder)
    assert done.returncode == 0
    assert (folder / "code").read_text() == "141\n"


def test_a_closed_stderr_is_no_fault(folder):
    assert shell("$RG check nowhere.mod 2>&-", folder).returncode == 2


def test_unencodable_characters_are_escaped(folder):
    (folder / "letters.mod").write_text(GOOD.replace("hi", "é"), encoding="latin-1")
    done = shell("$RG run letters.mod", folder, PYTHONIOENCODING="ascii")
    assert (done.returncode, done.stdout) == (0, "\\xe9\n")


@pytest.mark.parametrize("encoding", ["utf-8", "latin-1"])
def test_letters_are_shown_as_the_file_has_them(folder, encoding):
    (folder / "letters.mod").write_text(GOOD.replace("hi", "é ü"), encoding=encoding)
    done = shell("$RG run letters.mod", folder, PYTHONIOENCODING="utf-8")
    assert (done.returncode, done.stdout) == (0, "é ü\n")


def test_build_accepts_undecodable_file_name(folder):
    Path(os.fsdecode(b"cell\xff.yaml")).write_text("name: cell\nmodel: irb120\n")
    done = shell("$RG build $'cell\\xff.yaml' -o out", folder)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("verb", ["check", "fmt", "run", "build"])
def test_a_name_that_is_too_long(folder, capsys, verb):
    assert main([verb, "a" * 300 + ".mod"]) == 2
    assert "File name too long" in capsys.readouterr().err


@pytest.mark.parametrize("verb", ["check", "run", "sim"])
def test_a_loop_of_links(folder, capsys, verb):
    os.symlink("loop.mod", "loop.mod")
    assert main([verb, "."]) in (1, 2)
    displayed = capsys.readouterr()
    assert "Too many levels of symbolic links" in displayed.out + displayed.err


def test_a_file_that_breaks_off_while_it_is_read(folder, capsys):
    assert main(["run", "/proc/self/mem"]) == 2
    assert "error[RG704]" in capsys.readouterr().err


@pytest.mark.parametrize("text", [["fmt", ""], ["check", ""], ["build", "irb120", "-o", ""]])
def test_an_empty_argument_is_not_the_folder_one_is_in(folder, capsys, text):
    (folder / "ugly.mod").write_text(GOOD.lower())
    assert main(text) == 2
    assert "an argument is empty" in capsys.readouterr().err
    assert (folder / "ugly.mod").read_text() == GOOD.lower()


def test_a_file_is_written_whole_or_not_at_all(folder):
    target = folder / "kept.txt"
    target.write_bytes(b"before")
    target.chmod(0o640)
    (folder / "link").symlink_to("kept.txt")
    write_whole(folder / "link", b"after")
    assert target.read_bytes() == b"after"
    assert target.stat().st_mode & 0o777 == 0o640
    assert (folder / "link").is_symlink()
    # The largest file that the process may write is smaller than the data.
    script = (
        "import resource, signal\n"
        "from pathlib import Path\n"
        "from rapidgen._atomic_write import write_whole\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (10, 10))\n"
        "try:\n"
        "    write_whole(Path('kept.txt'), b'x' * 1000)\n"
        "except OSError as error:\n"
        "    print(error.filename)\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.stdout == "kept.txt\n", done.stderr
    assert sorted(os.listdir()) == ["good.mod", "kept.txt", "link"]
    assert target.read_bytes() == b"after"


def test_a_run_that_is_refused_leaves_no_report(folder):
    (folder / "bad.mod").write_text("MODULE bad\n")
    assert main(["run", "bad.mod", "--coverage", "x.lcov", "--profile=p.json"]) == 2
    assert sorted(os.listdir()) == ["bad.mod", "good.mod"]


def test_a_device_is_written_to_and_not_replaced(folder):
    write_whole(Path("/dev/null"), b"data")
    assert Path("/dev/null").is_char_device()


@pytest.mark.parametrize(
    "override",
    [
        "joints.joint_1.upper=1e308",
        "joints.joint_1.speed=1e308",
        "joints.joint_1.speed=1e-320",
        "tool.load.mass=1e308",
        "tool.frame.position=[1e308, 0, 0]",
        "trajectory.approach_speed=1e-320",
        "acceleration_time=1e-320",
    ],
)
def test_figures_that_no_num_holds_are_refused(override):
    assert set(refused(lambda: build(load_config("irb120", overrides=[override])))) == {"RG006"}


def test_a_long_value_is_shown_short():
    result = refusal(load_config, "irb120", overrides=[f"ports.motion={'a' * 5000}"])
    assert len(result.diagnostics[0].message) < 200
