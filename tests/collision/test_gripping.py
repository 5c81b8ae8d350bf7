"""Parts that grippers hold: worlds, signals of programs, and the client."""

from pathlib import Path

import numpy as np
import pytest

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Kinematics
from rapidgen.cli.app import main
from rapidgen.client import Robot, Trajectory
from rapidgen.client.core.state_port import StatePort
from rapidgen.client.errors import InvalidTrajectory, NotSupported
from rapidgen.collision.shapes import box
from rapidgen.config.cell import load_cell
from rapidgen.controller.controller import VirtualController
from rapidgen.diagnostics import DiagnosticError
from tests.collision.test_distances import of_mujoco

# At the first position the flange looks down; the tool ends at z = 413.3 mm, the block 2 mm below
# it, on the table. The wall ends below the tool, and above the bottom of the block.
TOOL = """
signals: {doGrip: {kind: DO}}
tools:
  tGrip:
    frame: {position: [0, 0, 60]}
    load: {mass: 0.5}
    shapes: [{box: [40, 40, 60], frame: {position: [0, 0, 30]}}]
"""
THINGS = """
things:
  block: {box: [40, 40, 40], frame: {position: [356.7, 0, 391.35]}}
  table: {box: [200, 200, 20], frame: {position: [356.7, 0, 361.35]}}
  wall: {box: [20, 20, 60], frame: {position: [252, 252, 365]}}
attach:
  - {part: block, to: tGrip, when: {doGrip: 1}, reach: 5}
"""
CELL = TOOL + THINGS
PROGRAM = """MODULE feeder
  PERS tooldata tGrip;
  CONST extjoint none := [9E9,9E9,9E9,9E9,9E9,9E9];
  PROC main()
    MoveAbsJ [[0,10,5,0,75,0],none], v500, fine, tool0;
    {0}
    MoveAbsJ [[0,5,5,0,75,0],none], v500, z10, tool0;
    MoveAbsJ [[90,{1},5,0,75,0],none], v500, fine, tool0;
  ENDPROC
ENDMODULE
"""
PICK = np.radians([0, 10, 5, 0, 75, 0])


@pytest.fixture
def files(cell, folder):
    """Return a program and its cell: `files(statements, second_joint, cell_text)`."""

    def make(grip="SetDO doGrip, 1; WaitTime 0.1;", second=10, text=CELL):
        module = folder / "feeder.mod"
        program = PROGRAM.replace("  PERS tooldata tGrip;\n", "")
        module.write_text(program.format(grip, second))
        return str(module), str(cell(text))

    return make


@pytest.mark.parametrize(
    ("grip", "second", "code"),
    [
        ("", 10, 0),
        ("SetDO doGrip, 1; WaitTime 0.1;", 10, 1),
        ("SetDO doGrip, 1; WaitTime 0.1;", 0, 0),
        ("SetDO doGrip, 1; WaitTime 0.1; SetDO doGrip, 0;", 10, 0),
    ],
)
def test_run_checks_the_part_while_the_signal_holds_it(files, grip, second, code, capsys):
    """Only the held part is low enough to touch the wall; it may stay on its table."""
    module, cell = files(grip, second)
    assert main(["run", module, "--cell", cell]) == code
    err = capsys.readouterr().err
    assert ("block touches wall" in err or "wall touches block" in err) == bool(code)
    assert "touches table" not in err


def test_run_reports_a_grip_without_a_part_in_reach(files, capsys):
    """The block is 12 mm below the tool, whose reach is 5 mm."""
    module, cell = files(text=CELL.replace("391.35", "381.35").replace("361.35", "351.35"))
    assert main(["run", module, "--cell", cell]) == 1
    err = capsys.readouterr().err
    assert "error[RG830]: block is 12.0 mm from tGrip; its reach is 5.0 mm" in err


def test_detection_stops_a_held_part(files):
    module, cell = files()
    with VirtualController.from_files(
        [module], cell=cell, collisions="error", cycle="once"
    ) as controller:
        controller.run(max_time=20)
        state = controller.collisions.state()
        assert state.gripped == (("block", "tGrip"),)
        assert set(state.first.bodies) == {"block", "wall"}
        assert controller.task("T_ROB1").state == "stopped"


def test_held_part_is_checked_against_what_it_stood_on(files):
    """Lowering the part by 5 degrees of axis 2 pushes it through the table."""
    module, cell = files()
    program = Path(module)
    program.write_text(program.read_text().replace("[[0,5,5", "[[0,14,5"))
    with VirtualController.from_files(
        [module], cell=cell, collisions="error", cycle="once"
    ) as controller:
        controller.run(max_time=20)
        assert set(controller.collisions.contacts[0].bodies) == {"block", "table"}


@pytest.mark.parametrize(
    ("attach", "code"),
    [
        ("{part: brick, to: tGrip}", "RG829"),
        ("{part: block, to: tHand}", "RG829"),
        ("{part: block, to: tGrip, when: {doHold: 1}}", "RG434"),
    ],
)
def test_unknown_names_of_a_grip_are_reported(files, attach, code, capsys):
    text = TOOL + THINGS.split("attach:")[0] + f"attach: [{attach}]\n"
    module, cell = files(text=text)
    assert main(["run", module, "--cell", cell]) == 2
    assert code in capsys.readouterr().err


# -- client ----------------------------------------------------------------------------------------


@pytest.fixture
def robot(cell, folder, monkeypatch):
    """A robot that is not connected, at the pick."""
    monkeypatch.setattr(StatePort, "wire_joints", (*PICK, 0.0, 0.0, 0.0, 0.0))
    return Robot(folder / "robot.yaml", address="127.0.0.1:1", cell=cell(CELL))


TURN = Trajectory.from_points([PICK, np.radians([90, 10, 5, 0, 75, 0])], seconds=6)
LIFT = Trajectory.from_points([PICK, np.radians([0, -10, 5, 0, 75, 0])], seconds=2)


def test_client_checks_a_part_after_attach(robot):
    robot.check(TURN)
    robot.cell.attach("block")
    assert robot.cell.held == {"block": "tGrip"}
    with pytest.raises(InvalidTrajectory, match="block"):
        robot.check(TURN)
    robot.check(LIFT)
    robot.cell.release("block")
    robot.check(TURN)


def test_client_rejects_a_part_out_of_reach(robot, monkeypatch):
    with pytest.raises(DiagnosticError, match="RG830"):
        robot.cell.attach("block", at=np.radians([0, 5, 5, 0, 75, 0]))
    with pytest.raises(DiagnosticError, match="RG829"):
        robot.cell.attach("wall")
    assert robot.cell.held == {}


def test_robot_without_a_cell_has_no_parts():
    with pytest.raises(NotSupported, match="cell"):
        _ = Robot("irb120", address="127.0.0.1:1").cell


def test_released_part_is_where_it_was_put(robot):
    """A body that hangs on the world keeps its place of the release."""
    there = np.radians([90, 0, 5, 0, 75, 0])
    robot.cell.attach("block")
    robot.cell.release("block", at=there)
    scene = robot.cell.world.scene
    block = next(body for body in scene.bodies if body.name == "block")
    x, y, z = block.shapes[0].pose[0]
    assert abs(x) < 0.05
    assert y > 0.3
    assert z > 0.4
    assert not block.owner
    with pytest.raises(InvalidTrajectory, match="block"):
        robot.check(
            Trajectory.from_points([PICK, np.radians([60, 4, 5, 0, 75, 0]), there * 1.2], seconds=6)
        )


def test_held_part_moves_with_the_flange(robot):
    """Distances of MuJoCo, at places from the kinematics of the configuration."""
    chain = Kinematics.of(robot.cell.group)
    robot.cell.attach("block")
    scene = robot.cell.world.scene
    random = np.random.default_rng(2)
    rows = PICK + random.uniform(-0.8, 0.8, (30, 6))
    in_flange = frames.compose(
        frames.invert(chain.forward(tuple(PICK))), ((0.3567, 0.0, 0.39135), frames.UNIT)
    )
    blocks = [
        box(0.04, 0.04, 0.04, frames.compose(chain.forward(tuple(row)), in_flange)) for row in rows
    ]
    walls = [box(0.02, 0.02, 0.06, ((0.252, 0.252, 0.365), frames.UNIT))] * len(rows)
    expected = of_mujoco(blocks, walls)
    pairs = [set(scene.names(number)) for number in range(len(scene.pairs))]
    values = robot.cell.world.values({"rob1": rows})
    far = scene.body_distances(values, [pairs.index({"block", "wall"})])[:, 0]
    free = expected > 0
    assert free.sum() > 10
    assert np.abs(far - expected)[free].max() < 1e-6


def test_cell_file_needs_no_signals_for_a_grip(cell):
    path = cell(CELL.replace(", when: {doGrip: 1}", ""))
    assert load_cell(path).attach[0].when == {}
