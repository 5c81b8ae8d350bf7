"""Usage errors: each has a code, a message and a help."""

import io
import re
import shlex
from pathlib import Path

import pytest

from rapidgen.cli.app import main

ROW = re.compile(r"^\$ (.*)\n    (\d) (RG\d+) (.*)\n    (.*)\n", re.MULTILINE)
ROWS = ROW.findall(Path(__file__).with_name("usage_errors.txt").read_text("utf-8"))
FILES = {
    "good.mod": "MODULE good\n    PROC main()\n    ENDPROC\nENDMODULE\n",
    "bad.mod": "MODULE bad\n    PROC main()\n        x := ;\n    ENDPROC\nENDMODULE\n",
    "cell.yaml": "model: irb120\n",
    "typo.yaml": "model: irb120\ntrajectroy: {capacity: 10}\n",
    "syntax.yaml": "model: irb120\n  ports: {motion\n",
    "p.csv": f"time,{','.join(f'joint_{n}' for n in range(1, 7))}\n0{',0' * 6}\n1,0.1{',0' * 5}\n",
    "two.csv": "time,joint_1,joint_2\n0,0,0\n1,0.1,0\n",
    "letters.csv": "time,joint_1\n0,0\n1,north\n",
    "empty.csv": "",
    "urdf.urdf": "<robot name='r'><link name='a'/>",
    "list.txt": "ftp://h/x\nnonsense\n",
    "plan.json": "{}",
    "secrets.toml": "[default]\npassword='x'\n",
    "f.yaml": "network:\n  - {what: explode}\n",
    "a.yaml": "- 1\n",
}


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    monkeypatch.delenv("RAPIDGEN_PASSWORD", raising=False)
    monkeypatch.setattr("sys.stdin", io.StringIO())
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    (tmp_path / "latin.yaml").write_bytes("model: irb120\nname: é\n".encode("latin-1"))
    (tmp_path / "secrets.toml").chmod(0o644)
    (tmp_path / "folder").mkdir()
    return tmp_path


def test_all_usage_errors_are_read():
    text = Path(__file__).with_name("usage_errors.txt").read_text("utf-8")
    assert len(ROWS) == text.count("\n$ ") > 100


@pytest.mark.parametrize(("words", "exit_code", "code", "message", "help"), ROWS)
def test_usage_error(place, capsys, words, exit_code, code, message, help):
    folder = str(place / "folder")
    before = sorted(place.rglob("*"))
    assert main(shlex.split(words.replace("{folder}", folder))) == int(exit_code)
    displayed = capsys.readouterr()
    text = displayed.err + displayed.out
    result = text[text.index(f"error[{code}]: ") :]
    assert message.replace("{folder}", folder) in result
    assert help in result.partition("= help: ")[2]
    assert "Traceback" not in text
    assert sorted(place.rglob("*")) == before
