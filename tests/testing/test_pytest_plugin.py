"""The plugin, as users' tests see it."""

import re
import subprocess
import sys
from importlib.metadata import entry_points
from types import SimpleNamespace

import pytest

from rapidgen.testing import pytest_plugin

PLUGIN = "rapidgen.testing.pytest_plugin"

pytest_plugins = ["pytester"]

TEST = '''
import pytest

MODULE = """MODULE m
  PERS num n := 0;
  PROC main()
    FOR i FROM 1 TO 10 DO
      n := n + 1;
    ENDFOR
  ENDPROC
ENDMODULE
"""

def test_plain(virtual_controller, tmp_path):
    path = tmp_path / "m.mod"
    path.write_text(MODULE)
    controller = virtual_controller(path, cycle="once")
    assert controller.run(max_time=5) == "finished"
    assert controller.task("T_ROB1")["m:n"] == 10

@pytest.mark.virtual_seeds(12)
def test_race(virtual_controller, tmp_path):
    path = tmp_path / "m.mod"
    path.write_text(MODULE)
    controller = virtual_controller(
        {"T1": [path], "T2": [path]}, cycle="once", switch_at_pers=True
    )
    controller.run(max_time=5)
    assert controller.task("T1")["m:n"] == 20
'''


def test_fixture_and_seeds(pytester) -> None:
    pytester.makepyfile(TEST)
    installed = any(e.value == PLUGIN for e in entry_points(group="pytest11"))
    plugins = ("-p", "no:cacheprovider", *(() if installed else ("-p", PLUGIN)))
    result = pytester.runpytest_inprocess(*plugins, "-q")
    outcomes = result.parseoutcomes()
    assert outcomes["passed"] >= 1
    assert outcomes["failed"] >= 1
    assert outcomes["passed"] + outcomes["failed"] == 13
    seed = re.search(r"FAILED .*\[seed(\d+)\]", result.stdout.str())[1]
    again = pytester.runpytest_inprocess(*plugins, "-q", f"--virtual-seed={seed}", "-k", "race")
    assert again.parseoutcomes()["failed"] == 1
    assert "passed" not in again.parseoutcomes()


EXAMPLE = '''
import math
import pytest

PROGRAM = r"""MODULE picker
  VAR socketdev server;
  VAR socketdev client;
  PERS num picked := 0;
  PROC main()
    VAR string text;
    SocketCreate server;
    SocketBind server, "192.168.125.1", 5000;
    SocketListen server;
    SocketAccept server, client \\Time:=WAIT_MAX;
    WHILE TRUE DO
      SocketReceive client \\Str:=text \\Time:=WAIT_MAX;
      IF text = "PICK" pick;
      SocketSend client \\Str:="OK" + ValToStr(picked) + ";";
    ENDWHILE
  ENDPROC
  PROC pick()
    MoveAbsJ [[30,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tGrip;
    SetDO doGrip, 1;
    WaitDI diPart, 1;
    picked := picked + 1;
  ENDPROC
ENDMODULE
"""
CELL = """
robots: {T_ROB1: {model: irb1200, start: [0, 0, 0, 0, 45, 0]}}
signals: {doGrip: {kind: DO}, diPart: {kind: DI}}
tools: {tGrip: {frame: {position: [0, 0, 100]}, load: {mass: 1, centre: [0, 0, 50]}}}
devices:
  gripper: [{when: {doGrip: 1}, then: {diPart: 1}, after: 0.2}]
"""

@pytest.fixture
def program(tmp_path):
    path = tmp_path / "picker.mod"
    path.write_text(PROGRAM)
    return path

def test_picks(virtual_controller, virtual_cell, virtual_client, program):
    controller = virtual_controller(program, cell=virtual_cell(CELL))
    assert controller.positions()["joint_5"] == pytest.approx(math.radians(45))
    recorder = controller.record()["rob1"]
    client = virtual_client(controller, 5000)
    client.send(b"PICK")
    assert client.receive(until=b";") == b"OK1;"
    assert controller.signals["doGrip"] == 1
    assert controller.positions("rob1")["joint_1"] == pytest.approx(math.radians(30))
    assert controller.task("T_ROB1")["picker:picked"] == 1
    assert recorder.recording(0.05).actual[-1][0] == pytest.approx(math.radians(30))

def test_texts_are_no_bytes(virtual_controller, virtual_cell, virtual_client, program):
    client = virtual_client(virtual_controller(program, cell=virtual_cell(CELL)), 5000)
    with pytest.raises(TypeError, match="send bytes, not a text: b'PICK'"):
        client.send("PICK")
    with pytest.raises(TypeError, match="receive until bytes"):
        client.receive(until=";")

def test_nothing_comes_in_a_cell_without_gripper(
    virtual_controller, virtual_cell, virtual_client, program
):
    cell = virtual_cell(CELL.split("devices")[0])
    controller = virtual_controller(program, cell=cell)
    client = virtual_client(controller, 5000)
    client.send(b"PICK")
    with pytest.raises(TimeoutError, match="waits for diPart = 1; diPart is 0"):
        client.receive(until=b";")

def test_program_without_clients(virtual_controller, virtual_client, tmp_path):
    path = tmp_path / "idle.mod"
    path.write_text("MODULE idle\\n PROC main()\\n  WaitUntil FALSE;\\n ENDPROC\\nENDMODULE")
    controller = virtual_controller(path)
    with pytest.raises(TimeoutError, match="nothing listens on port 5000"):
        virtual_client(controller, 5000)

def test_a_line_that_breaks(virtual_controller, virtual_faults, virtual_client, program):
    plan = virtual_faults("network: [{do: reset, port: 5000, direction: in, after: 1}]")
    controller = virtual_controller(program, cell="infer", faults=plan)
    client = virtual_client(controller, 5000)
    client.send(b"ABC")
    assert b";" not in client.receive(until=b";"), "it was reset before the answer was whole"

def test_a_driver(virtual_controller, virtual_client):
    controller = virtual_controller("irb120")
    assert len(virtual_client(controller, 11002).receive(8)) == 8
'''


def test_a_program_with_its_cell_client_and_faults(pytester) -> None:
    """The plugin by example, as docs/use/programs.md shows it."""
    pytester.makepyfile(EXAMPLE)
    installed = any(e.value == PLUGIN for e in entry_points(group="pytest11"))
    plugins = ("-p", "no:cacheprovider", *(() if installed else ("-p", PLUGIN)))
    # A process of its own: numpy is not imported twice.
    result = pytester.runpytest_subprocess(*plugins, "-q")
    assert result.parseoutcomes() == {"passed": 6}, result.stdout.str()


def test_the_plugin_imports_no_controller() -> None:
    code = f"import sys, {PLUGIN}; sys.exit('rapidgen.controller.controller' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.parametrize("given", [(), ("5",), (2.5,), (1, 5)])
def test_invalid_number_of_seeds_is_reported(given) -> None:
    marker = pytest.mark.virtual_seeds(*given).mark
    test = SimpleNamespace(
        definition=SimpleNamespace(nodeid="test_a.py::test_b", get_closest_marker=lambda _: marker),
        fixturenames=["virtual_seed"],
        config=SimpleNamespace(getoption=lambda _: None),
    )
    with pytest.raises(pytest.fail.Exception, match=r"write @pytest.mark.virtual_seeds\(50\)"):
        pytest_plugin.pytest_generate_tests(test)
