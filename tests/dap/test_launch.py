"""Launches that cannot be executed: each is refused, and the adapter takes the next one."""

import os
from contextlib import contextmanager

import pytest

from rapidgen.dap.client import RequestRefused
from rapidgen.dap.launch import read_launch
from rapidgen.diagnostics import DiagnosticError, refusal
from tests.dap.own_client import OwnClient, Refused
from tests.dap.test_session import PROGRAM

FILES = {
    "binary.mod": bytes(range(256)) * 40,
    "empty.mod": b"",
    "long.mod": b"MODULE m\nPROC main()\nTPWrite " + b"x" * 2_000_000,
    "wrong.mod": b"MODULE m\nPROC main()\nn := ;\nENDPROC\nENDMODULE\n",
    "undeclared.mod": b"MODULE m\nPROC main()\nn := nothing + 1;\nENDPROC\nENDMODULE\n",
    "self.pgf": b"<Program><Module>self.pgf</Module></Program>",
    "wrong.yaml": b"model: [irb120",
    "unknown.yaml": b"model: irb999\n",
}


@pytest.mark.parametrize(
    "arguments",
    [
        *({"program": name} for name in FILES if name != "undeclared.mod"),
        {"program": "missing.mod"},
        {"program": "irb999"},
        {"program": "folder"},
        {"program": "rights"},
        {"program": "main.mod", "robot": "irb999"},
        {"program": "main.mod", "cell": "missing.yaml"},
        {"program": "main.mod", "answers": "missing.yaml"},
        {"program": "main.mod", "start": "a,b"},
        {"program": "main.mod", "robotware": "x"},
        {"program": "main.mod", "backup": "folder"},
        {"program": "main.mod", "entry": "nowhere"},
        {"program": "\0"},
        {"tasks": {"T_ROB1": []}},
        {"tasks": {"A=B": ["main.mod"]}},
    ],
    ids=str,
)
def test_launch_is_refused_and_the_next_one_works(client, tmp_path, arguments):
    for name, data in FILES.items():
        (tmp_path / name).write_bytes(data)
    (tmp_path / "main.mod").write_text(PROGRAM)
    (tmp_path / "folder").mkdir()
    (tmp_path / "rights").mkdir()
    (tmp_path / "rights" / "m.mod").symlink_to(tmp_path / "nowhere")
    client.ask("initialize")
    with pytest.raises(Refused) as refusal:
        client.ask("launch", cwd=str(tmp_path), speed=0, **arguments)
    assert "Traceback" not in str(refusal.value)
    client.begin(tmp_path / "main.mod", [13])
    client.stopped()


@pytest.mark.parametrize(
    "arguments",
    [
        {},
        {"program": ""},
        {"program": {}},
        {"program": [1]},
        {"program": "m.mod", "speed": "fast"},
        {"program": "m.mod", "speed": True},
        {"program": "m.mod", "speed": 1001},
        {"program": "m.mod", "speed": 10**400},
        {"program": "m.mod", "cycle": "never"},
        {"program": "m.mod", "start": [1, None]},
        {"program": "m.mod", "tasks": [1]},
        {"program": "m.mod", "stopOnEntry": "yes"},
        {"program": "m.mod", "cwd": 3},
    ],
    ids=str,
)
def test_wrong_arguments_are_refused(arguments):
    with pytest.raises((RequestRefused, DiagnosticError)):
        read_launch(arguments)


def test_paths_begin_at_cwd(tmp_path):
    (tmp_path / "m.mod").write_text("")
    launch = read_launch(
        {"cwd": str(tmp_path), "program": ["m.mod", "irb120"], "tasks": {"T": "m.mod"}}
    )
    assert launch.targets == (str(tmp_path / "m.mod"), "irb120")
    assert launch.tasks == {"T": (str(tmp_path / "m.mod"),)}
    assert os.path.isabs(launch.tasks["T"][0])


@pytest.mark.parametrize(
    "fault",
    [
        refusal("RG920", None, "not built"),
        OSError(13, "denied"),
        ModuleNotFoundError("x", name="aiohttp"),
    ],
)
def test_page_that_cannot_be_served_refuses_the_launch(program, fault):
    @contextmanager
    def page(_runner, _target):
        raise fault
        yield

    path, client = program(PROGRAM), OwnClient(page)
    try:
        client.ask("initialize")
        with pytest.raises(Refused, match="RG9"):
            client.ask("launch", program=str(path), view=True)
    finally:
        client.close()
