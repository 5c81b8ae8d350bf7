"""The bundle holds numbers, known words and hashes; planted names do not get into it."""

import io
import json
import socket
import zipfile
from dataclasses import replace

import pytest

from rapidgen.commission import Checklist, Step
from rapidgen.commission import report as report_module
from rapidgen.commission.checklist import read_checklist
from rapidgen.commission.checklist_text import html, markdown
from rapidgen.commission.report import bundle, zipped
from rapidgen.diagnostics import DiagnosticError
from rapidgen.machine.saved_log import SavedEvent

SECRETS = (
    "acme-line7", "10.77.3.21", "plc.acme.example", "jane.doe", "120-508731", "MoveL pSecret",
    "/home/jane/cells", "gripper_axis", "hunter2",
)  # fmt: skip
PLANTED = Checklist(
    robot="acme-line7",
    model="IRB 120-3/0.58 120-508731",
    group="acme-line7",
    target="plc.acme.example:11000,11002",
    date="2026-03-04T05:06:07+01:00 jane.doe",
    version="0.1.0 hunter2",
    driver="/home/jane/cells",
    build_id="120-508731",
    robotware="7.6.1 on plc.acme.example",
    end="failed",
    steps=(
        Step(
            "direction.gripper_axis",
            "gripper_axis of jane.doe",
            "ok",
            "at 10.77.3.21",
            figures={"moved_deg": 2.0, "gripper_axis_deg": 1.0, "took_s": 1.25},
        ),
        Step("hunter2", "x", "fail", "MoveL pSecret, z10, tool0;", "ask jane.doe", "hunter2"),
    ),
)
LOG = "1, E, 50024, Corner path failure, 2026-03-04 05:06:07.5, Task: acme-line7 /home/jane/cells\n"


@pytest.fixture
def planted(tmp_path):
    path = tmp_path / "checklist.json"
    path.write_text(PLANTED.to_json(), encoding="utf-8")
    result = tmp_path / "move.json"
    figures = {"points": 3, "planned_seconds": 2.0, "seconds": 2.25, "deviation": 0, "starved": 0}
    result.write_text(json.dumps({**figures, "joints": {"gripper_axis": 1}}), encoding="utf-8")
    return path, result


def test_bundle_has_no_planted_secret(planted):
    checklist, result = planted
    files = bundle([checklist], [], [result])
    with zipfile.ZipFile(io.BytesIO(zipped(files))) as archive:
        text = "".join(archive.read(name).decode() for name in archive.namelist())
        assert all(info.date_time[0] == 1980 for info in archive.infolist())
    for secret in (*SECRETS, socket.gethostname()):
        assert secret not in text
    data = json.loads(files["commission-1.json"])
    assert data["month"] == "2026-03"
    assert data["steps"][0] == {
        "step": "direction",
        "verdict": "ok",
        "code": "",
        "figures": {"moved_deg": 2.0, "took_s": 1.25},
        "joint": 1,
    }
    assert data["steps"][1] == {"step": "other", "verdict": "fail", "code": "", "figures": {}}
    # Equal names are equal hashes in one bundle, and others in the next.
    assert data["robot"] == data["group"]
    again = json.loads(bundle([checklist], [], [])["commission-1.json"])
    assert again["robot"] != data["robot"]
    assert json.loads(files["durations-1.json"])["seconds"] == 2.25


def test_last_check_refuses_a_name_that_got_in(planted, monkeypatch):
    monkeypatch.setattr(report_module, "_commission", lambda checklist, _: {"x": checklist.target})
    with pytest.raises(DiagnosticError, match=r"plc\.acme\.example") as refused:
        bundle([planted[0]], [], [])
    assert refused.value.diagnostics[0].code == "RG689"


def test_events_are_numbers_only(tmp_path, monkeypatch):
    event = report_module.SavedLog(
        "7.6.1",
        tuple(
            SavedEvent(n, "E", code, "acme-line7", date, "jane.doe", ("hunter2",))
            for n, (code, date) in enumerate(
                [(50024, "2026-03-04 05:06:07.500"), (1, "x"), (50024, "2026-03-04 05:06:09.000")]
            )
        ),
    )
    monkeypatch.setattr(report_module, "read_saved_log", lambda _: event)
    data = json.loads(bundle([], [tmp_path / "log"], [])["events-1.json"])
    assert data == {
        "robotware": "7.6.1",
        "events": [[0.0, "E", 50024], [1.5, "E", 50024]],
        "counts": {"50024": 2},
        "other_events": 1,
    }


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{}", "nonsense", "[" * 9000, '{"format": "rapidgen commission 1"}',
     PLANTED.to_json().replace('"fail"', '"great"'), PLANTED.to_json().replace("2.0", '"2"')],
)  # fmt: skip
def test_other_files_are_refused(tmp_path, text):
    path = tmp_path / "checklist.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(DiagnosticError) as refused:
        read_checklist(path)
    assert refused.value.diagnostics[0].code == "RG689"


def test_checklist_survives_json_and_is_escaped(planted):
    assert read_checklist(planted[0]) == PLANTED
    hostile = replace(
        PLANTED,
        robot="<script>alert(1)</script>",
        steps=(Step("stop", "a | b", "fail", "<img src=x>\n# x", "<b>", "RG688"),),
    )
    page = html(hostile)
    assert "<script" not in page
    assert "<img" not in page
    row = markdown(hostile).splitlines()[-3]
    assert row == r"| a \| b | FAILED | <img src=x> # x (RG688; <b>) |  |"
