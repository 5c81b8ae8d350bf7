"""status, log, start, halt, io, symbols and backup as a user calls them."""

import json
import sys
from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace

import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "servers" / "rws"))

from served import MAIN, make_runner

from rapidgen._simulator_registry import Simulator, published
from rapidgen.cli.app import main
from rapidgen.cli.controller import controller_state, show_state
from rapidgen.client.errors import ConnectionLost
from rapidgen.client.rws.model import LogEvent, Panel, ProgramState, TaskState
from rapidgen.machine.operator import Answer
from rapidgen.servers.rws.server import serve_rws
from rapidgen.system import read_backup
from rapidgen.wire.rws.bodies import Generation


@pytest.fixture(params=[Generation.ONE, Generation.TWO], ids=["rws1", "rws2"])
def host(request, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setenv("RAPIDGEN_PASSWORD", "robotics")
    with make_runner(tmp_path, request.param, clock="real", speed=60) as runner:
        runner.start()
        service = serve_rws(runner, request.param)
        where = f"rws://{service.host}:{service.port}"
        first = ["status", where]
        if service.host_key:
            assert main(first) == 1  # a certificate that was not accepted
            first += ["--fingerprint", service.host_key]
        assert main(first) == 0
        yield where
        service.close()


def said(capsys):
    output = capsys.readouterr()
    assert "robotics" not in output.out + output.err
    return output.out


def test_a_controller_is_shown_started_and_halted(host, capsys):
    assert main(["status", host, "--json"]) == 0
    text = json.loads(said(capsys))
    assert (text["state"], text["mode"], text["running"]) == ("motoron", "AUTO", False)
    assert main(["start-program", host]) == 2  # no terminal to answer the question
    assert main(["start-program", host, "--yes", "--main"]) == 0
    assert f"{host}: program started" in said(capsys)
    assert main(["stop-program", host, "--motors-off"]) == 0
    assert main(["status", host]) == 0
    assert "motoroff" in said(capsys)
    assert main(["log", host, "--count", "3"]) == 0
    assert "Motors off" in said(capsys)
    assert main(["log", host, "--count", "3", "--json"]) == 0
    titles = [json.loads(line)["title"] for line in said(capsys).splitlines()]
    assert "Motors off" in titles


def test_signals_and_symbols_are_shown_and_set(host, capsys):
    assert main(["io", host, "do x;1", "1"]) == 0
    assert main(["io", host, "doDefault", "1"]) == 1
    assert main(["io", host, "do x;1", "one"]) == 2
    assert main(["io", host]) == 0
    assert "do x;1               DO  1" in said(capsys)
    assert main(["symbols", host, "T_ROB1/MainModule/list", "[4,5,6]"]) == 0
    assert "[4,5,6]" in said(capsys)
    assert main(["symbols", host, "T_ROB1/MainModule/list", "[4,5"]) == 2
    assert main(["symbols", host]) == 0
    assert "T_ROB1/MainModule/list  per  num{3}" in said(capsys)
    assert main(["symbols", host, "--json"]) == 0
    text = {one["path"]: one for one in json.loads(said(capsys))}
    assert text["T_ROB1/MainModule/list"]["dims"] == [3]
    assert main(["symbols", host, "T_ROB1/MainModule/list", "--json"]) == 0
    assert json.loads(said(capsys))["value"] == "[4,5,6]"


def test_modules_sources_and_values_are_read(host, capsys):
    # The program of make_runner is the expected value: nothing is written in between.
    assert main(["status", host, "--json", "--modules"]) == 0
    (task,) = json.loads(said(capsys))["tasks"]
    assert {"name": "MainModule", "system": False} in task["modules"]
    assert main(["status", host, "--modules"]) == 0
    assert "    MainModule\n" in said(capsys)
    module = ["symbols", host, "T_ROB1/MainModule"]
    assert main([*module, "--source", "--json"]) == 0
    assert json.loads(said(capsys))["source"].split() == MAIN.split()
    assert main(["symbols", host, "T_ROB1/MainModule/x", "7"]) == 0
    said(capsys)
    assert main([*module, "--values", "--json"]) == 0
    values = {one["name"]: one["value"] for one in json.loads(said(capsys))}
    assert (values["x"], values["list"], "c" in values) == ("7", "[1,2,3]", False)
    assert main([*module, "--values"]) == 0
    assert "T_ROB1/MainModule/x  per  num  7\n" in said(capsys)


@pytest.mark.parametrize("option", ["--source", "--values"])
@pytest.mark.parametrize("path", [[], ["T_ROB1"], ["T_ROB1/MainModule/x"], ["T_ROB1/Main", "5"]])
def test_sources_and_values_need_a_module(option, path, capsys):
    assert main(["symbols", "rws://127.0.0.1:1", *path, option]) == 2
    assert "TASK/MODULE" in capsys.readouterr().err


@pytest.mark.parametrize("generation", [Generation.ONE, Generation.TWO])
def test_sim_is_the_simulator_that_serves_them(generation, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setenv("RAPIDGEN_PASSWORD", "robotics")
    with published(Simulator("other", 1, {})):
        assert main(["status", "sim"]) == 1
        assert "RG642" in capsys.readouterr().err
        with make_runner(tmp_path, generation, clock="real", speed=60) as runner:
            runner.start()
            service = serve_rws(runner, generation)
            where = f"rws://{service.host}:{service.port}"
            with published(Simulator("cell", 2, {}, where, service.host_key)):
                assert main(["status", "sim", "--json"]) == 0
            service.close()
    assert json.loads(said(capsys))["host"].endswith(str(service.port))


@pytest.mark.parametrize(
    ("text", "code", "hint"),
    [
        (["symbols", "T_ROB1/nothing"], 2, "T_ROB1 --kind any"),
        (["symbols", "T_ROB1/MainModule/nothing"], 1, "rapidgen symbols"),
        (["symbols", "T_NONE"], 1, "rapidgen symbols"),
        (["symbols", "T_ROB1", "5"], 2, "TASK/MODULE/NAME"),
        (["symbols", "T_ROB1/MainModule/x", "TRUE"], 1, "type"),
        (["symbols", "--kind", "pers"], 2, "'per'"),
        (["io", "nothing"], 1, "rapidgen io"),
        (["io", "nothing", "1"], 1, "rapidgen io"),
        (["log", "--domain", "99"], 1, "domain 0"),
        (["start-program"], 2, "THE ROBOT MAY MOVE"),
    ],
)
def test_unknown_name_is_reported_with_known_names(host, capsys, text, code, hint):
    assert main([text[0], host, *text[1:]]) == code
    output = capsys.readouterr()
    assert output.out.count("\n") == 0 or text == ["start-program"]
    assert hint in output.err


class Followed:
    """A controller whose connection is lost once; `back` is its log afterwards."""

    def __init__(self, before, back):
        self.answers = [before, ConnectionLost([]), back, KeyboardInterrupt()]

    def log(self, *, domain, count=50, after=0):
        answer = self.answers.pop(0)
        if isinstance(answer, BaseException):
            raise answer
        return tuple(event for event in answer if event.number > after)

    def wait_ready(self):
        assert len(self.answers) == 2


@pytest.mark.parametrize(
    ("back", "displayed"),
    [
        (["1 a", "2 b", "3 c"], ["1 a", "2 b", "3 c"]),
        (["3 c"], ["1 a", "2 b", "3 c"]),
        (["1 d"], ["1 a", "2 b", "1 d"]),
        (["1 d", "2 e", "3 f"], ["1 a", "2 b", "1 d", "2 e", "3 f"]),
    ],
    ids=["all", "only-newer", "cleared", "numbers-anew"],
)
def test_a_followed_log_goes_on_behind_a_lost_connection(back, displayed, monkeypatch, capsys):
    def entries(texts):
        return [LogEvent(0, int(t[0]), "info", 10125, t[2], t[2], "", ()) for t in texts]

    result = Followed(entries(["1 a", "2 b"]), entries(back))
    monkeypatch.setattr("rapidgen.cli.rws_session.controller", lambda *_: nullcontext(result))
    monkeypatch.setattr("time.sleep", lambda seconds: None)
    assert main(["log", "rws://nowhere", "--follow", "--json"]) == 130
    *text, _ = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [f"{event['number']} {event['title']}" for event in text] == displayed


@pytest.mark.parametrize(("answer", "code"), [("Grant", 0), ("Deny", 1)])
def test_manual_mode_asks_for_consent_at_pendant(answer, code, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("RAPIDGEN_PASSWORD", "robotics")
    script = [Answer(answer, dialog="RMMP")]
    with make_runner(tmp_path, clock="real", speed=60, answers=script) as runner:
        runner.controller.set_mode("manual_reduced")
        runner.start()
        service = serve_rws(runner, Generation.ONE)
        where = f"rws://{service.host}:{service.port}"
        assert main(["symbols", where, "T_ROB1/MainModule/x", "7"]) == code
        output = capsys.readouterr()
        assert "press Grant on its pendant within 10 s" in output.err
        assert output.out == ("7\n" if code == 0 else "")
        service.close()


def test_a_backup_comes_here_and_boots(host, capsys, tmp_path):
    folder = tmp_path / "backup"
    assert main(["backup", host, "-o", str(folder)]) == 0
    system = read_backup(folder)
    assert [module.name for module in system.tasks[0].modules] == ["MainModule"]
    assert main(["backup", host, "-o", str(folder)]) == 2
    assert not list(tmp_path.glob("*.part"))
    assert "files" in said(capsys)


@pytest.mark.parametrize(
    ("words", "code", "exit_code"),
    [
        (["status", "ftp://h"], "RG657", 2),
        (["status", "rws://u:p@h"], "RG657", 2),
        (["status", "cell.yaml"], "RG657", 2),
        (["status", "a b"], "RG657", 2),
        (["status", "rws://127.0.0.1:1"], "RG512", 2),
    ],
)
def test_wrong_words_are_explained(words, code, exit_code, capsys, monkeypatch):
    monkeypatch.delenv("RAPIDGEN_PASSWORD", raising=False)
    assert main(words) == exit_code
    text = capsys.readouterr().err
    assert code in text
    assert ":p@" not in text


class Tasks:
    """A controller whose background tasks are as a test says."""

    where = "rws://cell"

    def __init__(self, *tasks):
        self._tasks = tasks

    def tasks(self):
        return self._tasks

    def identity(self):
        return SimpleNamespace(name="cell", id="1", robotware="6.15", is_virtual=True)

    def panel(self):
        return Panel("motoron", "AUTO", 100)

    def execution(self):
        return ProgramState(running=True, cycle="forever")

    def pointer(self, _task):
        return SimpleNamespace(module="")


@pytest.mark.parametrize(
    ("name", "execution", "words"),
    [
        ("T_ROS_CONTROL", "stopped", ["T_ROS_CONTROL: not running", "warm start", "driver"]),
        ("T_ROS_STATE", "ready", ["T_ROS_STATE: not running", "`rapidgen log`"]),
        ("T_OTHER", "stopped", ["T_OTHER: not running", "warm start"]),
        ("T_ROS_CONTROL", "started", []),
    ],
)
def test_status_shows_fix_for_stopped_background_task(name, execution, words, capsys):
    text = controller_state(
        Tasks(
            TaskState("T_ROB1", "normal", "linked", "stopped", True, True),
            TaskState(name, "semistatic", "linked", execution, False, False),
        )
    )
    show_state(text)
    fixes = [line for line in capsys.readouterr().out.splitlines() if line.startswith("! ")]
    assert [f"! {fix}" for fix in text["fixes"]] == fixes
    assert len(fixes) == bool(words)
    assert all(word in fixes[0] for word in words)
    assert all(("driver" in fix) == ("ROS" in name) for fix in fixes)


@pytest.mark.parametrize("words", [["status"], ["symbols", "T_ROB1/MainModule", "--values"]])
def test_every_repeats_in_one_session_with_a_line_each_time(host, words, capsys, monkeypatch):
    looks = iter([None, None])

    def stop_after_two(_seconds):
        if next(looks, "end") == "end":
            raise KeyboardInterrupt

    monkeypatch.setattr("rapidgen.cli.controller.time", SimpleNamespace(sleep=stop_after_two))
    command, *rest = words
    assert main([command, host, *rest, "--json", "--every", "0.5"]) == 130
    lines = [json.loads(line) for line in said(capsys).splitlines()]
    assert len([one for one in lines if "errors" not in one]) == 3
    assert main([command, host, *rest[:1], "--every", "0.1"]) == 2


def test_every_needs_values(capsys):
    assert main(["symbols", "rws://127.0.0.1:1", "--every", "1"]) == 2
    assert "--every repeats --values" in capsys.readouterr().err
