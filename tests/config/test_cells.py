"""`rapidgen new` on cells: tracks, gantries, positioners, several arms."""

import re

import pytest

from rapidgen.cli.configuration import new
from rapidgen.config import load_config
from rapidgen.config.cell import load_cell
from rapidgen.config.registry import find_shipped
from rapidgen.diagnostics import DiagnosticError
from rapidgen.generate import build, make_system
from rapidgen.verification.testbench import Bench
from tests.config.drawing import BASE, arm, drawn, joint, links, robot

TABLE = joint("tilt", "base_link", "frame", lower=-2, upper=2) + links("frame")
PLATE = joint("plate", "frame", "top") + links("top")
FINGER = joint("finger", "tool0", "f", "prismatic", lower=0, upper=0.02) + links("f")


def with_parts(text, *parts):
    return text.replace("</robot>", f"{''.join(parts)}</robot>")


def carried(text, *names):
    """The arm on linear axes, one upon the other."""
    text = text.replace('<parent link="base_link"/>', f'<parent link="on_{names[-1]}"/>')
    parts, below = [], "base_link"
    for name in names:
        parts.append(joint(name, below, f"on_{name}", "prismatic", lower=0, upper=3, velocity=1))
        parts.append(links(f"on_{name}"))
        below = f"on_{name}"
    return with_parts(text, *parts)


def made(tmp_path, text, **options):
    (tmp_path / "robot.urdf").write_text(text)
    new(tmp_path / "cell.yaml", urdf=tmp_path / "robot.urdf", force=True, **options)
    return load_config(tmp_path / "cell.yaml")


def axes(group):
    return {j.name: j.axis for j in group.joints if j.axis.startswith("eax")}


CELLS = {
    "track": (carried(drawn("irb120"), "rail"), {"rail": "eax_a"}),
    "gantry": (
        carried(drawn("irb1200"), "x", "y", "z"),
        {"x": "eax_a", "y": "eax_b", "z": "eax_c"},
    ),
    "positioner": (with_parts(drawn("irb120"), TABLE, PLATE), {"tilt": "eax_a", "plate": "eax_b"}),
    "gripper": (with_parts(drawn("irb120"), FINGER), {}),
    "track and positioner": (
        with_parts(carried(drawn("irb2400"), "rail"), TABLE),
        {"rail": "eax_a", "tilt": "eax_b"},
    ),
    "palletiser": (drawn("irb460"), {}),
    "scara": (drawn("irb910sc"), {}),
    "seven axes": (drawn("irb14050"), {"joint_7": "eax_a"}),
}


def test_a_positioner_has_an_axis_that_no_answer_has_taken(tmp_path):
    text = with_parts(carried(drawn("irb2400"), "rail"), TABLE)
    cell = made(tmp_path, text, joint=["rail=eax_b"], coupling=1)
    assert axes(cell.groups[0]) == {"rail": "eax_b", "tilt": "eax_a"}
    cell = made(tmp_path, text, track=["rail=eax_a"], coupling=1)
    assert axes(cell.groups[0]) == {"rail": "eax_a", "tilt": "eax_b"}


@pytest.mark.parametrize("case", CELLS)
def test_a_cell_is_built_and_moves(tmp_path, case):
    text, external = CELLS[case]
    config = made(tmp_path, text, coupling=1 if case == "palletiser" else None)
    (group,) = config.groups
    assert axes(group) == external
    carriers = [p for p in group.positioners if {s.joint for s in p.chain} & set(external)]
    assert bool(carriers) == ("positioner" in case)
    with Bench(config, make_system(config, build(config))) as bench:
        bench.assert_moves_through(bench.motion(), bench.wave(3, duration=1.0))
        bench.assert_healthy()


YUMI = (find_shipped("irb14000").parent / "urdf" / "irb14000.urdf").read_text()


def yumi(left, right):
    """Both arms, with other names of their joints."""
    names = {"l": left, "r": right}
    return re.sub(r"yumi_joint_(\d)_([lr])", lambda hit: names[hit[2]].format(hit[1]), YUMI)


def test_two_arms_of_a_yumi(tmp_path):
    config = made(tmp_path, YUMI)
    assert [(g.name, g.task) for g in config.groups] == [("rob_l", "T_ROB_L"), ("rob_r", "T_ROB_R")]
    assert [len(g.joints) for g in config.groups] == [7, 7]


@pytest.mark.parametrize(
    ("left", "right"),
    [
        # kth-ros-pkg/yumi; OrebroUniversity/yumi and its forks; others
        ("yumi_joint_{}_l", "yumi_joint_{}_r"),
        ("yumi_robl_joint_{}", "yumi_robr_joint_{}"),
        ("left_{}", "right_{}"),
        ("LeftArm{}", "RightArm{}"),
        ("l_joint_{}", "r_joint_{}"),
    ],
)
def test_both_arms_of_a_yumi_have_the_controllers_tasks(tmp_path, left, right):
    config = made(tmp_path, yumi(left, right))
    tasks = {g.name: (g.task, g.mechanical_unit) for g in config.groups}
    assert tasks == {"rob_l": ("T_ROB_L", "ROB_L"), "rob_r": ("T_ROB_R", "ROB_R")}
    for group in config.groups:
        own = (left if group.name == "rob_l" else right).format(1)
        assert own in {j.name for j in group.joints}


def test_yumi_arms_with_unclear_names_leave_tasks_open(tmp_path):
    (tmp_path / "robot.urdf").write_text(yumi("a_{}", "b_{}"))
    with pytest.raises(DiagnosticError) as caught:
        new(tmp_path / "cell.yaml", urdf=tmp_path / "robot.urdf")
    assert {d.code for d in caught.value.diagnostics} == {"RG022"}
    written = (tmp_path / "cell.yaml").read_text()
    assert written.count('task: "???"') == written.count('mechanical_unit: "???"') == 2


DELTA = robot(
    BASE,
    *(
        joint(f"upper_{n}", "base_link", f"u{n}") + links(f"u{n}")
        + joint(f"lower_{n}", f"u{n}", f"v{n}") + links(f"v{n}")
        for n in (1, 2, 3)
    ),
)  # fmt: skip


@pytest.mark.parametrize(
    ("text", "word"),
    [
        (DELTA, "a delta robot"),
        (robot(BASE, TABLE, PLATE), "2 joints and no robot"),
        (robot(BASE, arm(), name="kuka_kr5_arc"), "is no robot of ABB"),
        (robot(BASE, arm(), name="ur10e_robot"), "is no robot of ABB"),
    ],
)
def test_robot_of_another_maker_is_reported(tmp_path, text, word):
    with pytest.raises(DiagnosticError) as caught:
        made(tmp_path, text)
    assert [d.code for d in caught.value.diagnostics] == ["RG059"]
    assert word in caught.value.diagnostics[0].message
    assert not (tmp_path / "cell.yaml").exists()


def test_partners_of_externally_guided_motion(tmp_path):
    path = tmp_path / "cell.yaml"
    path.write_text("egm: {PC: '192.168.125.20:6511', UCdevice: '127.0.0.1:6510'}\n")
    assert load_cell(path).egm == {
        "pc": ("192.168.125.20", 6511),
        "ucdevice": ("127.0.0.1", 6510),
    }


@pytest.mark.parametrize("text", ["6510", "robot:6510", "127.0.0.1:0", "127.0.0.1", "::1:6510"])
def test_partner_that_is_no_address(tmp_path, text):
    path = tmp_path / "cell.yaml"
    path.write_text(f"egm: {{PC: '{text}'}}\n")
    with pytest.raises(DiagnosticError, match="is not HOST:PORT"):
        load_cell(path)
