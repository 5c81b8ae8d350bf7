"""The cycle-time report of `run`: durations, limits, standing time, comparison."""

import json

import pytest

from rapidgen.cli.app import main

HOSTILE = '<script>alert("x")</script>'
PROGRAM = r"""MODULE cycle
  CONST speeddata turning := [1000, 20, 1000, 1000];
  PROC main()
    VAR robtarget p;
    AccSet 100, 100;
    MoveAbsJ [[10,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;
    p := CRobT(\Tool:=tool0);
    MoveL Offs(p,0,200,0), v100, fine, tool0;
    MoveL RelTool(Offs(p,0,200,0),0,0,0 \Rz:=40), turning, fine, tool0;
    WaitTime 0.5;
    MoveAbsJ [[-100,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], vmax, fine, tool0;
    MoveAbsJ [[-98,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], vmax, fine, tool0;
    MoveAbsJ [[-58,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000\T:=2, fine, tool0;
    MoveAbsJ [[-20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, z50, tool0;
    WaitTime 10;
    passing;
  ENDPROC
  PROC passing()
    MoveAbsJ [[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], vmax, z10, tool0;
    MoveAbsJ [[20,30,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], vmax, fine, tool0; ! HOSTILE
  ENDPROC
ENDMODULE
""".replace("HOSTILE", HOSTILE)


@pytest.fixture(scope="module")
def reports(tmp_path_factory):
    """The folder of a program and its reports."""
    folder = tmp_path_factory.mktemp("cycle")
    (folder / "cycle.mod").write_text(PROGRAM)
    words = ["run", str(folder / "cycle.mod"), "--robot", "irb1200"]
    for name in ("cycle.html", "cycle.json"):
        words += ["--cycle-report", str(folder / name)]
    assert main(words) == 0
    return folder


@pytest.fixture
def robot(reports):
    """The data of the only robot."""
    (robot,) = json.loads((reports / "cycle.json").read_text())["robots"]
    return robot


def test_times_add_up(robot):
    assert robot["moving"] + robot["waiting"] == pytest.approx(robot["seconds"], abs=1e-4)
    for rows in (robot["lines"], robot["routines"]):
        assert sum(row["seconds"] for row in rows) == pytest.approx(robot["seconds"], abs=1e-4)
    assert sum(robot["limits"].values()) == pytest.approx(robot["seconds"], abs=1e-4)
    for move in robot["moves"]:
        assert sum(move["limits"].values()) == pytest.approx(move["seconds"], abs=1e-5)
    stood = sum(end - begin for begin, end in robot["standing"])
    assert stood == pytest.approx(robot["waiting"], abs=1e-4)


def test_limits_of_moves(robot):
    named = {move["line"]: (move["limit"], move["stop"]) for move in robot["moves"]}
    late = "late program pointer (50024)"
    assert named == {
        6: ("programmed speed", "fine point"),
        8: ("programmed speed", "fine point"),
        9: ("orientation speed", "fine point"),
        11: ("speed of axis 1", "fine point"),
        12: ("fine point", "fine point"),
        13: ("programmed time", "fine point"),
        14: ("programmed speed", late),
        19: ("acceleration of axis 1", ""),
        20: ("acceleration of axis 2", "fine point"),
    }
    short, last = (next(m for m in robot["moves"] if m["line"] == n) for n in (12, 20))
    assert list(short["limits"])[1] == "acceleration of axis 1"
    assert last["limits"]["corner"] > 0.01


def test_durations_and_speeds(robot):
    """200 mm of a line at v100 take what the speed says; the programmed \\T is exact."""
    moves = {move["line"]: move for move in robot["moves"]}
    assert moves[8]["length"] == pytest.approx(200, abs=0.1)
    assert moves[8]["max_speed"] == pytest.approx(100, abs=0.5)
    assert moves[8]["limits"]["programmed speed"] == pytest.approx(2, rel=0.05)
    assert moves[13]["seconds"] == pytest.approx(2, abs=1e-3)
    assert moves[9]["limits"]["orientation speed"] == pytest.approx(2, rel=0.05)
    # An IRB 1200-5/0.9 turns axis 1 at 288 deg/s, here for 110 deg.
    assert moves[11]["seconds"] > 110 / 288


def test_standing_time_belongs_to_the_waiting_line(robot):
    waiting = {row["line"]: row["waiting"] for row in robot["lines"] if row["waiting"] > 0.01}
    assert waiting[10] == pytest.approx(0.5, abs=1e-3)
    # The move before, with a zone, goes on for a part of the 10 s.
    moved = next(move for move in robot["moves"] if move["line"] == 14)
    assert set(waiting) == {10, 15}
    assert 10 - moved["seconds"] < waiting[15] < 10


def test_page_shows_the_program_as_text(reports):
    page = (reports / "cycle.html").read_text()
    assert 's <small class="dim">(±3 %)' in page
    assert HOSTILE not in page
    assert "&lt;script&gt;" in page


def test_comparison_pairs_changed_lines(reports, capsys, tmp_path):
    changed = PROGRAM.replace("200,0), v100,", "200,0), v200,").replace(
        "    AccSet 100, 100;\n", ""
    )
    (tmp_path / "b.mod").write_text(changed)
    words = ["run", str(tmp_path / "b.mod"), "--robot", "irb1200"]
    page = tmp_path / "b.html"
    words += ["--cycle-report", str(page), "--compare", str(reports / "cycle.json")]
    assert main(words) == 0
    totals = capsys.readouterr().err
    change = float(totals.split("now, ")[1].split(" s")[0])
    assert change == pytest.approx(-1, abs=0.05)  # 200 mm at twice the speed
    table = page.read_text().split("Compared with cycle.json")[1].split("What limits")[0]
    assert "v100, fine, tool0;</code><br>→ <code>MoveL Offs(p,0,200,0), v200" in table
    assert "MoveL RelTool" not in table


@pytest.mark.parametrize(
    "text",
    ["no data", "[]", '{"format": "rapidgen cycle report", "version": 2}',
     '{"format": "rapidgen cycle report", "version": 1, "robots": [{"group": "a"}]}',
     '{"format": "rapidgen cycle report", "version": 1, "robots": [{"group": "a", "limits": {},'
     ' "seconds": NaN, "moving": 1, "waiting": 1, "lines": []}]}'],
)  # fmt: skip
def test_bad_earlier_report_is_rejected_before_the_run(reports, capsys, tmp_path, text):
    (tmp_path / "a.json").write_text(text)
    words = ["run", str(reports / "cycle.mod"), "--cycle-report", str(tmp_path / "x.html")]
    assert main([*words, "--compare", str(tmp_path / "a.json")]) == 2
    assert "RG901" in capsys.readouterr().err
    assert not (tmp_path / "x.html").exists()


def test_bad_options_are_rejected(reports, capsys, tmp_path):
    words = ["run", str(reports / "cycle.mod")]
    assert main([*words, "--compare", str(reports / "cycle.json")]) == 2
    assert "--compare needs --cycle-report" in capsys.readouterr().err
    assert main([*words, "--cycle-report", str(tmp_path / "x.txt")]) == 2
    assert "neither .html nor .json" in capsys.readouterr().err
