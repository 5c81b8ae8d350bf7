"""`sim` as an address: simulators are found while they run, and only then."""

import os
import signal
import subprocess
import sys
from contextlib import ExitStack

import pytest

from rapidgen._simulator_registry import Simulator, folder, published, running
from rapidgen.cli import send_stop
from rapidgen.cli.app import main
from rapidgen.client.sim_address import find_simulator
from tests.refusal import refusal

ARM = Simulator("irb120", 7, {"rob1": "127.0.0.1:11000,11002,11001"})
YUMI = Simulator("irb14000", 8, {"rob_l": "127.0.0.1:1,3,2", "rob_r": "127.0.0.1:11,13,12"})


@pytest.fixture(autouse=True)
def own(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    return tmp_path / "rapidgen"


def test_a_simulator_is_found_while_it_runs():
    with published(ARM) as text:
        assert text
        assert running() == ([ARM], [])
        assert str(find_simulator("irb120")) == "127.0.0.1:11000,11002"
        assert str(find_simulator()) == "127.0.0.1:11000,11002"
    assert running() == ([], [])
    assert os.listdir(folder()) == []


def test_sim_groups_have_separate_addresses():
    with published(YUMI):
        assert find_simulator("irb14000", "rob_r").motion == 11
        assert "--group rob_l or rob_r" in refusal(find_simulator, "irb14000").diagnostics[0].help
        assert send_stop.addresses(["irb14000", "--to", "sim"]) == [
            ("127.0.0.1", 1),
            ("127.0.0.1", 11),
        ]
        assert send_stop.addresses(["irb14000", "--to", "sim", "--group", "rob_r"]) == [
            ("127.0.0.1", 11)
        ]
        assert len(send_stop.addresses(["sim"])) == 2


@pytest.mark.parametrize(
    ("target", "name", "message", "note"),
    [
        ([], "irb120", "no simulator of yours runs", ""),
        ([YUMI], "irb120", "no simulator of 'irb120' runs, but others do", "irb14000 (process 8)"),
        ([ARM, Simulator("irb120", 9, {})], "irb120", "2 simulators run", "(process 9)"),
    ],
)
def test_ambiguous_simulator_is_rejected(target, name, message, note):
    with ExitStack() as stack:
        for one in target:
            stack.enter_context(published(one))
        (result,) = refusal(find_simulator, name).diagnostics
    assert result.code == "RG642"
    assert message in result.message
    assert note in " ".join(result.notes)


def test_others_are_not_counted_where_it_is_not_clear_which():
    with published(ARM), published(YUMI), published(Simulator("irb120", 9, {})):
        (result,) = refusal(find_simulator, "irb120").diagnostics
    assert result.message == "2 simulators run"
    assert [note.partition(" ")[0] for note in result.notes] == ["irb120", "irb120"]


def test_killed_simulator_is_reported_and_removed(caplog):
    script = (
        "import os, signal\n"
        "from rapidgen._simulator_registry import Simulator, published\n"
        "with published(Simulator('irb120', os.getpid(), {'rob1': '127.0.0.1:1,3'})):\n"
        "    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.returncode == -signal.SIGKILL, done.stderr
    with caplog.at_level("WARNING", "rapidgen"):
        assert refusal(find_simulator, "irb120").diagnostics[0].code == "RG642"
    assert "no longer runs" in caplog.text
    assert os.listdir(folder()) == []


def test_world_writable_registry_is_ignored(own):
    own.mkdir()
    own.chmod(0o777)
    with published(ARM) as text:
        assert not text
        assert running() == ([], [])


def test_damaged_files_are_passed_over(own):
    with published(ARM):
        (own / "sim-1-x.json").write_text("[]")
        (own / "notes").write_text("mine")
        assert running()[0] == [ARM]
    assert os.listdir(own) == ["notes"]


def test_running_simulator_is_suggested_if_no_driver_answers(capsys):
    with published(ARM):
        assert main(["monitor", "irb120", "--to", "127.0.0.1:1,1"]) == 1
    text = "note: a simulator of irb120 runs at 127.0.0.1:11000,11002,11001: `--to sim`"
    assert text in capsys.readouterr().err
    assert main(["monitor", "irb120", "--to", "127.0.0.1:1,1"]) == 1
    assert "a simulator of" not in capsys.readouterr().err


def test_the_verbs_find_it(start, capsys, tmp_path, monkeypatch):
    sim = start("irb120", "--ports", "auto", "--rws", "1")
    assert sim.ready["address"]["rob1"] == "127.0.0.1:{motion},{state},{control}".format(
        **sim.ready["ports"]["rob1"]
    )
    assert main(["monitor", "irb120", "--to", "sim", "--lines", "--count", "1"]) == 0
    assert main(["monitor", "sim", "--lines", "--count", "1"]) == 0
    capsys.readouterr()
    assert main(["stop", "sim"]) == 0
    assert "stopped at joint_1" in capsys.readouterr().out
    (own,) = running()[0]
    assert own.web_services == sim.ready["rws"]
    (tmp_path / "part.mod").write_text("MODULE part\nPROC main()\nENDPROC\nENDMODULE\n")
    monkeypatch.setenv("RAPIDGEN_PASSWORD", "robotics")
    assert main(["execute", str(tmp_path / "part.mod"), "--to", "sim"]) == 1
    assert "the driver is active at" in capsys.readouterr().err
    sim.end()
    assert main(["stop", "irb120", "--to", "sim"]) == 1
    assert "error[RG642]" in capsys.readouterr().err
