"""Synchronised movement of two arms [mem: MultiMove is in no public source]."""

import pytest

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.machine.scheduler import S

SHARED = """
    PERS tasks both{2} := [["T_ROB_L"],["T_ROB_R"]];
    VAR syncident begins;
    VAR syncident ends;
    VAR jointtarget j;
"""


def target(degrees):
    return f"[[{degrees},-90,30,0,30,0],[0,9E9,9E9,9E9,9E9,9E9]]"


def cell(tmp_path, left, right, declarations=SHARED):
    files = {}
    for name, body in (("left", left), ("right", right)):
        files[name] = tmp_path / f"{name}.mod"
        files[name].write_text(
            f"MODULE m_{name}\n{declarations}\nPROC main()\n{body}\nENDPROC\nENDMODULE\n"
        )
    return VirtualController.from_files(
        {"T_ROB_L": [files["left"]], "T_ROB_R": [files["right"]]},
        robots=load_config("irb14000").groups,
        cycle="once",
    )


def spans(controller, seconds=30):
    """When each arm moved: (from, to) in s for every motion between standstills."""
    result = {"rob_l": [], "rob_r": []}
    was = dict.fromkeys(result, True)

    def look():
        for name, row in result.items():
            at_rest = controller.motion.group(name).is_standing
            if at_rest != was[name]:
                was[name] = at_rest
                if at_rest:
                    row[-1].append(controller.scheduler.now / S)
                else:
                    row.append([controller.scheduler.now / S])
        controller.scheduler.after(round(0.001 * S), look)

    controller.scheduler.after(0, look)
    controller.run_for(seconds)
    return result["rob_l"], result["rob_r"]


def program(moves, wait=0.0):
    lines = [f"WaitTime {wait};", "SyncMoveOn begins, both;"]
    lines += moves
    return "\n".join([*lines, "SyncMoveOff ends;"])


def test_moves_of_one_id_begin_and_end_together(tmp_path):
    left = program(
        [f"MoveAbsJ {target(60)} \\ID:=10, v100, fine, tool0;",
         f"MoveAbsJ {target(50)} \\ID:=20, v1000, fine, tool0;"]
    )  # fmt: skip
    right = program(
        [f"MoveAbsJ {target(20)} \\ID:=10, v1000, fine, tool0;", "WaitTime 0.7;",
         f"MoveAbsJ {target(-70)} \\ID:=20, v200, fine, tool0;"], 0.5
    )  # fmt: skip
    one, two = spans(cell(tmp_path, left, right))
    assert len(one) == len(two) == 2
    for a, b in zip(one, two, strict=True):
        assert a == pytest.approx(b, abs=0.002)
    assert one[0][0] > 0.5
    assert one[1][0] - one[0][1] > 0.7
    assert one[0][1] - one[0][0] > 1.0  # the slow arm's time


def test_without_synchronisation_each_goes_at_its_own_pace(tmp_path):
    moves = [
        f"MoveAbsJ {target(degrees)} \\ID:=10, {speed}, fine, tool0;"
        for degrees, speed in ((60, "v100"), (20, "v1000"))
    ]
    one, two = spans(cell(tmp_path, *moves))
    assert one[0][1] - one[0][0] > 2 * (two[0][1] - two[0][0])


def test_corners_stay_together(tmp_path):
    def moves(size, speed):
        return [
            f"MoveAbsJ {target(size * k)} \\ID:={k}, {speed}, {'z50' if k < 4 else 'fine'}, tool0;"
            for k in range(1, 5)
        ]

    one, two = spans(cell(tmp_path, program(moves(15, "v100")), program(moves(5, "v1000"))))
    assert len(one) == len(two) == 1
    assert one[0] == pytest.approx(two[0], abs=0.02)


def test_an_id_is_needed(tmp_path):
    controller = cell(
        tmp_path,
        program([f"MoveAbsJ {target(10)}, v100, fine, tool0;"]),
        program([f"MoveAbsJ {target(10)} \\ID:=10, v100, fine, tool0;"]),
    )
    controller.run_for(5)
    assert any("ID is missing" in str(event) for event in controller.log)
    assert controller.task("T_ROB_L").state == "error"
