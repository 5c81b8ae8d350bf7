"""The commands `commission` and `report`, from their arguments to their files."""

import asyncio
import json
import pty
import subprocess
import sys
import zipfile

import pytest

from rapidgen.cli.app import main
from rapidgen.cli.commission import TerminalOperator
from rapidgen.client.address import Address
from rapidgen.commission import Question
from rapidgen.commission.checklist import read_checklist

LOOPBACK = Address("127.0.0.1")


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        (["--to", "192.0.2.1"], "RG640"),
        (["--to", "192.0.2.1", "--yes"], "RG640"),
        (["--to", "192.0.2.1", "--move-real-robot", "192.0.2.2"], "RG640"),
        (["--to", "192.0.2.1", "--move-real-robot", "192.0.2.1"], "RG641"),
        (["--to", "192.0.2.1", "--move-real-robot", "192.0.2.1", "--answers", "a.yaml"], "RG684"),
        (["--yes"], "RG641"),
    ],
)
def test_real_robot_needs_its_host_and_an_operator(arguments, code, capsys, monkeypatch):
    """Refused before a connection: 192.0.2.0/24 is for documentation (RFC 5737)."""
    monkeypatch.setattr(sys, "stdin", open("/dev/null"))  # noqa: SIM115
    with sys.stdin:
        assert main(["commission", "irb120", *arguments]) == 2
    assert code in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[1]", "no mapping"),
        ("aera: yes", "did you mean 'area'?"),
        ("area: 3", "no text"),
        ("a: [", "cannot be used"),
    ],
)
def test_unusable_answers(tmp_path, text, message, capsys, monkeypatch):
    path = tmp_path / "answers.yaml"
    path.write_text(text, encoding="utf-8")
    monkeypatch.setattr("rapidgen.client.connect_target.find_simulator", lambda *_: LOOPBACK)
    assert main(["commission", "irb120", "--to", "sim", "--answers", str(path)]) == 2
    error = capsys.readouterr().err
    assert "RG689" in error
    assert message in error


def test_report_shows_and_writes(tmp_path, capsys, monkeypatch):
    result, bundle = tmp_path / "move.json", tmp_path / "report.zip"
    figures = {"points": 3, "planned_seconds": 2.0, "seconds": 2.25, "deviation": 0, "starved": 0}
    result.write_text(json.dumps(figures), encoding="utf-8")
    arguments = ["report", "--result", str(result), "-o", str(bundle)]
    monkeypatch.setattr(sys, "stdin", open("/dev/null"))  # noqa: SIM115
    with sys.stdin:
        assert main(arguments) == 2
    shown = capsys.readouterr().err
    assert "RG641" in shown
    assert '"seconds": 2.25' in shown
    assert not bundle.exists()
    assert main([*arguments, "--yes"]) == 0
    with zipfile.ZipFile(bundle) as archive:
        assert archive.namelist() == ["versions.json", "durations-1.json"]
    assert main(["report"]) == 2


def test_answer_typed_before_its_question_does_not_count(monkeypatch):
    """It would permit a move that is not announced yet."""
    ours, theirs = pty.openpty()
    with open(theirs, encoding="utf-8") as terminal, open(ours, "wb", buffering=0) as keys:
        monkeypatch.setattr(sys, "stdin", terminal)
        keys.write(b"yes\n")

        async def asked():
            answer = asyncio.ensure_future(TerminalOperator().ask(Question("move", "Move now?")))
            await asyncio.sleep(0)
            await asyncio.sleep(0)
            keys.write(b"perhaps\nno\n")
            return await answer

        assert asyncio.run(asked()) == "no"


@pytest.mark.long
def test_commission_of_a_simulator(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    program = [sys.executable, "-m", "rapidgen.cli"]
    start = ["--ports", "auto", "--start", "0,0,0,0,30,0"]
    server = subprocess.Popen([*program, "sim", "irb120", *start], stdout=subprocess.PIPE)
    try:
        assert server.stdout.readline().startswith(b"ready")
        words = ["commission", "irb120", "--to", "sim", "--yes", "-o", str(tmp_path / "out")]
        assert main(words) == 0
    finally:
        server.terminate()
        server.wait(60)
        server.stdout.close()
    checklist = read_checklist(tmp_path / "out" / "checklist.json")
    assert checklist.end == "complete"
    assert {step.name for step in checklist.steps} >= {"stop", "cable", "restored"}
    assert "<svg" in (tmp_path / "out" / "checklist.html").read_text("utf-8")
