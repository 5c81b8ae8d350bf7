"""State and requests of programs without a page, also after restarts."""

import json

import pytest

from rapidgen.controller.boot_targets import BootOptions, load_target
from rapidgen.controller.editor_link import EditorCursor
from rapidgen.controller.runner import ControllerRunner
from rapidgen.viewer.broadcaster import Broadcaster
from rapidgen.viewer.simulator.simulation import Simulation
from tests.viewer.test_program_page import PROGRAM


class Viewer:
    """One page: its last message of each type."""

    def __init__(self, controller_runner):
        self.runner = controller_runner
        self.hub = Broadcaster(Simulation(controller_runner), self.take)
        self.last = {}
        self.number = 0
        self.hub.renew()
        self.take(self.hub.join())

    def take(self, batch):
        for message in json.loads(batch.data):
            self.last[message["type"]] = message

    def ask(self, do, **request):
        """The text of the reply, or its error."""
        self.number += 1
        requested = {"id": self.number, "request": {"do": do, **request}}
        self.take(self.hub.ask(json.dumps(requested)))
        reply = self.last["reply"]
        return reply["error"] or reply["text"]

    def pass_time(self, seconds):
        self.runner.controller.run_for(seconds)
        self.hub.look()


@pytest.fixture
def viewer(tmp_path):
    (tmp_path / "work.mod").write_text(PROGRAM)
    target = load_target([tmp_path / "work.mod"], BootOptions())
    with ControllerRunner.boot(target, clock="virtual") as controller_runner:
        yield Viewer(controller_runner)


def test_sources_pointers_and_a_breakpoint(viewer):
    viewer.pass_time(0.1)
    (task,) = viewer.last["loaded"]["tasks"]
    assert list(task["modules"]) == ["work"]
    assert viewer.ask("source", number=task["modules"]["work"]) == PROGRAM
    assert viewer.last["pointers"]["tasks"][0]["motion"]["line"] in (10, 16)
    assert viewer.ask("break", module="work", line=16, condition="n = 2") == "1"
    viewer.pass_time(60)
    halt = viewer.last["debugging"]["halt"]
    assert (halt["reason"], halt["place"]["line"]) == ("breakpoint", 16)
    assert viewer.last["held"]["variables"][0]["text"] == "2"
    assert viewer.ask("drive", how="over", task="T_ROB1") == ""
    viewer.pass_time(60)
    assert viewer.last["debugging"]["halt"]["place"]["line"] == 17
    assert viewer.ask("evaluate", expression="n + 0.5") == "2.5  (num)"
    assert viewer.ask("assign", target="n", value="7") == "7"
    assert viewer.ask("run-to", task="T_ROB1", module="work", line=12) == ""
    viewer.pass_time(60)
    assert viewer.last["debugging"]["halt"]["reason"] == "cursor"
    assert viewer.ask("watch", expressions=["total", "absent"]) == ""
    viewer.hub.look()
    assert [v["text"] for v in viewer.last["held"]["watch"]] == ["8", "(absent is not known here)"]


def test_a_breakpoint_of_which_something_else_is_wanted_stays_the_same_one(viewer):
    """It was taken away and set anew, so that a wish that is refused lost it."""
    assert viewer.ask("break", module="work", line=17, log="here") == "1"
    viewer.pass_time(10)
    (point,) = viewer.last["debugging"]["breakpoints"]
    assert (point["number"], point["log"], point["count"] > 0) == (1, "here", True)
    assert "no number of passes" in viewer.ask("break", number=1, module="work", line=17, hits="?")
    viewer.hub.look()
    assert viewer.last["debugging"]["breakpoints"] == [point]
    requested = viewer.ask(
        "break", number=1, module="work", line=17, condition="n > 1000", log="far"
    )
    assert requested == "1"
    viewer.pass_time(10)
    (now,) = viewer.last["debugging"]["breakpoints"]
    assert now == {**point, "condition": "n > 1000", "log": "far", "count": 0}
    # Where its statement has gone, too: a module was loaded anew without it.
    assert viewer.ask("break", number=1, module="work", line=900, log="far") == "1"
    viewer.hub.look()
    (now,) = viewer.last["debugging"]["breakpoints"]
    assert (now["number"], now["doubt"]) == (1, "no statement begins there")


@pytest.mark.parametrize(
    ("do", "request_", "error"),
    [
        ("break", {"module": "work", "line": 900}, "no statement begins there"),
        ("break", {"module": "absent", "line": 1}, "no statement begins there"),
        ("break", {"module": "work", "line": 10, "hits": "often"}, "no number of passes"),
        ("break", {"module": "work", "line": 10, "number": 7}, "has been deleted"),
        ("break", {"module": "work", "line": 0}, "not understood"),
        ("break", {"module": "x" * 300, "line": 1}, "not understood"),
        ("drive", {"how": "resume"}, "nothing is paused"),
        ("drive", {"how": "in", "task": "T_ROB1"}, "nothing is paused"),
        ("drive", {"how": "in", "task": "absent"}, "there is no task absent"),
        ("drive", {"how": "backwards"}, "not understood"),
        ("run-to", {"task": "T_ROB1", "module": "work", "line": 900}, "no statement begins"),
        ("look", {"task": "absent"}, "there is no task absent"),
        ("look", {"task": "T_ROB1", "level": -7}, "not understood"),
        ("source", {"number": 99}, "no longer loaded"),
        ("origin", {"number": 0}, "no template made it"),
        ("origin", {"number": 99}, "no template made it"),
        ("pace", {"value": 0.09}, "not understood"),
        ("pace", {"value": 101}, "not understood"),
        ("run-for", {"seconds": 0}, "not understood"),
        ("evaluate", {"expression": ")("}, ""),
        ("evaluate", {"expression": "1;ENDPROC PROC other()"}, "met ';'"),
        ("evaluate", {"expression": "there(1)"}, ""),
        ("evaluate", {"expression": "(" * 900}, ""),
        ("assign", {"target": "a", "value": "1"}, "a cannot be changed"),
        ("assign", {"target": "total", "value": '"text"'}, "the value is string, not num"),
        ("assign", {"target": "i := 3; i", "value": "4"}, "not one expression"),
        ("watch", {"expressions": ["1"] * 60}, "not understood"),
        ("errors", {"errors": "some"}, "not understood"),
    ],
)
def test_what_cannot_be_done_is_refused_with_a_reason(viewer, do, request_, error):
    viewer.pass_time(0.1)
    viewer.ask(do, **request_)
    reply = viewer.last["reply"]
    assert reply["error"]
    assert error in reply["error"]
    viewer.pass_time(1.0)
    assert viewer.last["debugging"]["halt"] is None


def test_time_goes_at_the_pace_that_is_asked_for_and_is_stepped(viewer):
    for pace in (0.1, 100, 1):
        assert viewer.ask("pace", value=pace) == ""
        assert viewer.runner.controller.scheduler.speed == pace
        viewer.hub.look()
        assert viewer.last["panel"]["pace"] == pace
    assert viewer.ask("drive", how="pause") == ""
    for seconds in (0.004, 0.024, 0.1, 1):
        before = viewer.runner.controller.now
        assert viewer.ask("run-for", seconds=seconds) == ""
        viewer.pass_time(5)
        assert viewer.last["debugging"]["halt"]["reason"] == "time"
        assert viewer.runner.controller.now == pytest.approx(before + seconds, abs=1e-9)
    assert viewer.ask("drive", how="resume") == ""
    viewer.pass_time(1)
    assert viewer.last["debugging"]["halt"] is None


def test_second_viewer_receives_complete_state(viewer):
    viewer.pass_time(0.1)
    viewer.ask("break", module="work", line=17)
    viewer.pass_time(60)
    text = {}
    text.update({message["type"]: 1 for message in json.loads(viewer.hub.join().data)})
    assert text.keys() >= {"scene", "loaded", "pointers", "debugging", "held"}


def test_breakpoints_stay_over_a_restart(viewer):
    viewer.ask("break", module="work", line=17)
    viewer.runner.on_boot.append(viewer.hub.renew)
    viewer.runner.ask_restart()
    viewer.runner.run(lambda: viewer.runner.restarts > 0)
    viewer.runner.controller.set_motors(True)
    viewer.runner.controller.start_program()
    viewer.pass_time(60)
    assert viewer.last["debugging"]["halt"]["place"]["line"] == 17


def test_lines_are_counted_and_no_longer(viewer):
    viewer.ask("cover", on=True)
    viewer.pass_time(10)
    viewer.pass_time(2)
    lines = {int(line): hits for line, hits in viewer.last["covered"]["lines"].items()}
    assert lines[9] >= 2
    assert 7 not in lines
    viewer.ask("cover", on=False)
    assert not viewer.runner.controller.statements.tracers


TARGETS = """MODULE points
  CONST robtarget p10 := [[300,100,400],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget unused := [[300,0,400],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  TASK PERS wobjdata table := [FALSE,TRUE,"",[[0,0,100],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PROC main()
    MoveJ p10, v1000, fine, tool0;
    MoveL p10, v1000, fine, tool0 \\WObj:=table;
    MoveL Offs(p10, 0, 0, 50), v1000, fine, tool0;
    TPWrite "no move";
  ENDPROC
ENDMODULE
"""


@pytest.fixture
def points(tmp_path):
    (tmp_path / "points.mod").write_text(TARGETS)
    target = load_target([tmp_path / "points.mod"], BootOptions(robot="irb120"))
    with ControllerRunner.boot(target, clock="virtual", autostart=False) as runner:
        yield Viewer(runner)


@pytest.mark.parametrize(
    ("line", "name", "heights"),
    [
        (2, "", [0.4, 0.5]),  # the declaration: both moves to it
        (6, "p10", [0.4, 0.5]),
        (6, "v1000", [0.4]),  # the move itself
        (8, "", [0.45]),
        (3, "unused", []),  # without a move the work object is unknown
        (9, "", []),
    ],
)
def test_target_under_editor_cursor_in_the_work_object_of_its_moves(points, line, name, heights):
    points.runner.editor.attach(lambda *_: None)
    points.runner.editor.cursor = EditorCursor("POINTS", line, name)
    points.hub.look()
    seen = points.last["editor"]
    assert (seen["attached"], seen["line"]) == (True, line)
    assert [round(one["pose"]["position"][2], 6) for one in seen["targets"]] == heights


def test_page_opens_a_line_in_all_attached_editors(points):
    opened = []

    def opener(*place):
        opened.append(place)

    refused = points.ask("open-in-editor", module="points", line=6)
    assert (refused, points.last["editor"]["attached"]) == (
        "no editor debugs this simulation",
        False,
    )
    points.runner.editor.attach(opener)
    points.runner.editor.cursor = EditorCursor("points", 6)
    assert points.ask("open-in-editor", module="points", line=6) == ""
    assert opened == [("points", 6)]
    points.runner.editor.detach(opener)
    points.hub.look()
    assert points.last["editor"] == {
        "type": "editor",
        "attached": False,
        "module": "",
        "line": 0,
        "targets": [],
    }
