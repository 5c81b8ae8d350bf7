"""Collision detection of the virtual controller, and parts that grippers hold."""

import numpy as np
import pytest

from rapidgen.controller.controller import VirtualController
from rapidgen.rapid.switches import Switches

POST = "things:\n  post: {box: [80, 80, 900], frame: {position: [350, 250, 450]}}"
TURN = """MODULE feeder
  CONST jointtarget a := [[0,10,5,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget b := [[70,10,5,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    {0}
    MoveAbsJ a, v500, z50, tool0;
    MoveAbsJ b, v500, fine, tool0;
    TPWrite "arrived";
  {1}
  ENDPROC
ENDMODULE
"""
HANDLER = """ERROR
    IF ERRNO = ERR_COLL_STOP THEN
      ClearPath;
      StartMove;
      MoveAbsJ a, v100, fine, tool0;
      TRYNEXT;
    ENDIF"""


@pytest.fixture
def booted(cell, folder):
    """A controller with detection: `booted(program, things)`."""
    made = []

    def make(program, things=POST, mode="error", extra="", **options):
        module = folder / "feeder.mod"
        module.write_text(program)
        file = cell(f"{things}\n{extra}")
        controller = VirtualController.from_files(
            [module], cell=file, collisions=mode, cycle="once", **options
        )
        made.append(controller)
        return controller

    yield make
    for controller in made:
        controller.close()


def codes(controller):
    return [event.code for event in controller.log]


def test_detection_stops_the_robot_at_a_contact(booted):
    """Event 50204 and motors that stay on: [mem], facts of ABB's Motion Supervision."""
    controller = booted(TURN.format("", ""))
    assert controller.run(max_time=10) == "finished"
    assert codes(controller).count(50_204) == 1
    assert controller.motors_on
    assert controller.task("T_ROB1").state == "stopped"
    state = controller.collisions.state()
    assert set(state.first.bodies) == {"link_6", "post"}
    assert state.first.place.endswith("MoveAbsJ/7")
    assert state.near[0].verdict == "contact"
    assert state.least == state.near[0].distance < 0
    on_link, on_post = np.array(state.near[0].points)
    assert np.linalg.norm(on_link - on_post) == pytest.approx(-state.least, abs=1e-6)
    assert any("hoses" in text for text in state.unchecked)


def test_detection_finds_the_contact_of_1_ms_samples(booted):
    controller = booted(TURN.format("", ""), mode="warn")
    recorder = controller.record()["rob1"]
    controller.run(max_time=10)
    scene = controller.collisions.world.scene
    times = range(0, round(1.3e9), 1_000_000)
    rows = np.array([commanded for commanded, _ in recorder.postures(times)])
    far = scene.body_distances(controller.collisions.world.values({"rob1": rows}))
    first = times[int(np.flatnonzero((far <= 0).any(axis=1))[0])] / 1e9
    # The samples are late by up to 1 ms, the proof by its tolerance.
    assert controller.collisions.contacts[0].time == pytest.approx(first, abs=2.5e-3)


def test_warn_logs_each_contact_once(booted):
    controller = booted(TURN.format("", ""), mode="warn")
    heard = []
    controller.operator.subscribe(lambda _task, text: heard.append(text))
    assert controller.run(max_time=10) == "finished"
    assert heard == ["arrived"]
    contacts = controller.collisions.contacts
    assert codes(controller).count(50_204) == len(contacts) == len({c.bodies for c in contacts})


def test_restart_goes_on_stopping_until_the_robot_leaves(booted):
    controller = booted(TURN.format("", ""))
    controller.run(max_time=10)
    controller.start_program()
    controller.run(max_time=10)
    assert codes(controller).count(50_204) == 2
    controller.pp_to_main()
    controller.start_program()
    # The way back to the first target leads out of the contact, the second one into it again.
    controller.run_for(5)
    assert codes(controller).count(50_204) == 3
    assert controller.positions()["joint_1"] > 0.3


@pytest.mark.parametrize(("handler", "state"), [(HANDLER, "finished"), ("", "error")])
def test_switch_raises_err_coll_stop_in_the_move(booted, handler, state):
    """Handlers of public programs use ClearPath and StartMove [code]."""
    program = TURN.format("", handler)
    controller = booted(program, dialect=Switches(collision_error="error"))
    controller.run(max_time=30)
    assert codes(controller).count(50_204) == 1
    assert controller.task("T_ROB1").state == state
    if handler:
        assert abs(controller.positions()["joint_1"]) < 1e-6


def test_motion_sup_off_does_not_stop(booted):
    controller = booted(TURN.format("MotionSup \\Off;", ""))
    heard = []
    controller.operator.subscribe(lambda _task, text: heard.append(text))
    controller.run(max_time=10)
    assert heard == ["arrived"]
    assert 50_204 in codes(controller)
