"""Signals and routines as services of the node, with and without `rapidgen_interfaces`."""

import sys
from dataclasses import replace

import pytest
from messages import Point, Pose, Quaternion, Value

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.generate import build, make_system
from rapidgen.system.model import ModuleFile, SignalSpec

CONFIG = """
name: cell
model: irb120
signals:
  valve: {kind: DO, access: write}
  part: {kind: DI}
routines:
  weld:
    call: cell:weld
    parameters:
      - {name: seam, type: num, mode: inout}
      - {name: note, type: string}
      - {name: there, type: robtarget}
      - {name: back, type: jointtarget}
      - {name: good, type: bool, mode: inout}
"""
CELL = b"""MODULE cell
    PERS string noted := "";
    PERS robtarget was := [[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PROC weld(INOUT num seam, string note, robtarget there, jointtarget back, INOUT bool good)
        IF seam < 0 RAISE ERR_ARGVALERR;
        noted := note;
        was := there;
        good := back.robax.rax_1 > 5;
        seam := seam * 2;
    ERROR
        RAISE;
    ENDPROC
ENDMODULE
"""


@pytest.fixture
def cell(tmp_path):
    """A controller in real time, and the configuration of its driver."""
    path = tmp_path / "robot.yaml"
    path.write_text(CONFIG)
    config = load_config(path)
    system = make_system(config, build(config))
    module = ModuleFile("cell", "cell.mod", CELL)
    tasks = tuple(
        replace(task, modules=(*task.modules, module)) if task.motion else task
        for task in system.tasks
    )
    signals = (*system.signals, SignalSpec("valve", "DO"), SignalSpec("part", "DI"))
    system = replace(system, tasks=tasks, signals=signals)
    with VirtualController(system, config.groups, clock="real", ports="auto") as controller:
        controller.start()
        yield controller, path


@pytest.fixture
def node(driver_type, cell):
    controller, path = cell
    address = str(controller.address("rob1", timeout=60))
    node = driver_type(parameter_overrides={"config": str(path), "address": address})
    node.topics["robot_status"].wait(lambda report: report.motion_possible.val == 1)
    yield node
    node.destroy_node()


def test_signals_are_written_and_read(node, cell):
    controller, _ = cell
    report = node.services["write_signal"](name="valve", value=1.0)
    assert (report.success, report.value) == (True, 1.0)
    assert controller.io["valve"].value == 1
    assert node.services["read_signal"](name="part").value == 0.0
    for service, requested in (
        ("write_signal", {"name": "part", "value": 1.0}),
        ("read_signal", {"name": "pump"}),
    ):
        report = node.services[service](**requested)
        assert not report.success
        assert requested["name"] in report.message


def test_a_routine_gets_values_of_every_type_and_tells_its_results(node, cell):
    controller, _ = cell
    target = Pose(position=Point(x=0.4, y=0.1, z=0.5), orientation=Quaternion(y=1.0, w=0.0))
    arguments = [
        Value(type=Value.NUM, number=3.5),
        Value(type=Value.STRING, text="seam 7"),
        Value(type=Value.ROBTARGET, pose=target),
        Value(type=Value.JOINTTARGET, joints=[0.2, 0.0, 0.0, 0.0, 0.0, 0.0]),
        Value(type=Value.BOOL, boolean=False),
    ]
    reply = node.services["call_routine"](name="weld", arguments=arguments)
    assert (reply.success, reply.message) == (True, "done")
    assert [(value.type, value.number, value.boolean) for value in reply.results] == [
        (Value.NUM, 7.0, False),
        (Value.BOOL, 0.0, True),
    ]
    task = controller.task("T_ROB1")
    assert task["cell:noted"] == "seam 7"
    was = task["cell:was"]
    position = [was.trans.x, was.trans.y, was.trans.z]
    turned = [was.rot.q1, was.rot.q2, was.rot.q3, was.rot.q4]
    assert position == pytest.approx([400, 100, 500])
    assert [abs(part) for part in turned] == pytest.approx([0, 0, 1, 0])

    arguments[0] = Value(type=Value.NUM, number=-1.0)
    reply = node.services["call_routine"](name="weld", arguments=arguments)
    assert not reply.success
    assert "ERR_ARGVALERR" in reply.message
    reply = node.services["call_routine"](name="weld", arguments=[Value(type=9)])
    assert (reply.success, reply.message) == (False, "9 is not a type of rapidgen_interfaces/Value")


def test_without_the_package_the_node_runs_and_says_so(sourced, cell, monkeypatch):
    controller, path = cell
    for name in ("rapidgen_interfaces", "rapidgen_interfaces.msg", "rapidgen_interfaces.srv"):
        monkeypatch.setitem(sys.modules, name, None)
    from rapidgen.ros.node import RobotNode

    address = str(controller.address("rob1", timeout=60))
    node = RobotNode(parameter_overrides={"config": str(path), "address": address})
    node.topics["robot_status"].wait(lambda report: report.motion_possible.val == 1)
    assert set(node.services) == {"stop", "pause", "resume"}
    assert any("rapidgen_interfaces is not in" in line for line in node.get_logger().lines)
    node.destroy_node()
