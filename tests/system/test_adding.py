"""Load a cfg file onto a controller: known events (docs/rapid/cfg.md).

Each base is one of the delivered ones; each fault was reported by a controller, or contradicts all
backups and ABB's own files.
"""

import pytest

from rapidgen.system import parse_cfg
from rapidgen.system.base import Robot, base_system, header_digits
from rapidgen.system.cfg_loading import CfgFileLoad, add, faults_within

ONE = (Robot("T_ROB1", "ROB_1"),)
TWO = (Robot("T_ROB1", "ROB_1", ("TRACK_1",)), Robot("T_ROB2", "ROB_2"))
YUMI = (Robot("T_ROB_L", "ROB_L"), Robot("T_ROB_R", "ROB_R"))
SYS6, EIO6, SYS7, EIO7 = (f"{head}::\n" for head in (
    "SYS:CFG_1.0:6:0", "EIO:CFG_1.0:6:1", "SYS:CFG_1.0:7:0", "EIO:CFG_1.0:7:0",
))  # fmt: skip
SIGNAL = 'EIO_SIGNAL:\n -Name "doA" -SignalType "DO"\n -Name "aoA" -SignalType "AO"\n'


def load(*texts, robotware=(6, 15), robots=ONE, **options):
    files = (CfgFileLoad(parse_cfg(text, path=text[:3])) for text in texts)
    return add(base_system(robotware, robots), files, **options)


def codes(loaded):
    return [(fault.code, fault.span.line) for fault in loaded.faults]


def out(status, signal="doA", arguments=""):
    return EIO6 + SIGNAL + f'SYSSIG_OUT:\n -Status "{status}" -Signal "{signal}" {arguments}\n'


def out7(status, signal="doA", arguments="", name="Name"):
    return SYS7 + f'SYSSIG_OUT:\n -Status "{status}" -{name} "{signal}" {arguments}\n'


@pytest.mark.parametrize(
    ("robotware", "domain", "digits"),
    [
        ((5, 15), "EIO", (5, 0)),  # KRAKER
        ((5, 61), "EIO", (5, 60)),  # MCUBE 2017-04-13
        ((5, 61), "SIO", (5, 60)),
        ((5, 61), "SYS", (5, 0)),
        ((6, 3), "EIO", (6, 1)),  # MCUBE 6.03
        ((6, 14), "PROC", (6, 0)),  # VInRoS
        ((7, 6), "EIO", (7, 0)),  # a GoFa's backup
    ],
)
def test_digits_of_the_header(robotware, domain, digits):
    assert header_digits(robotware, domain) == digits


@pytest.mark.parametrize("robotware", [(5, 15), (5, 61), (6, 3), (6, 15), (7, 6)])
@pytest.mark.parametrize("robots", [ONE, TWO, YUMI])
def test_a_base_breaks_no_rule(robotware, robots):
    assert faults_within(base_system(robotware, robots)) == ()


def test_a_single_robot_has_no_unit_groups():
    """PANIN, PAULA, KRAKER, JOSE, TETOV, FABIO, EDGAR, KEEN."""
    base = base_system((6, 13), ONE)
    (task,) = base.instances("SYS", "CAB_TASKS")
    assert [a.name for a in task.attributes] == ["Name", "Type", "MotionTask"]
    assert base.unit_groups == frozenset()


def test_the_groups_of_a_yumi():
    """HONG: the right arm has planner 1, the seventh axis is a unit of the group."""
    right, left = base_system((6, 6), YUMI).instances("SYS", "MECHANICAL_UNIT_GROUP")
    for group, name, planner in ((right, "R", 1), (left, "L", 2)):
        assert group.text("Name") == f"rob_{name.lower()}"
        assert group.text("MechanicalUnit_1") == f"ROB_{name}_7"
        assert group.text("UseMotionPlanner") == f"motion_planner_{planner}"


def test_one_robot_with_multimove():
    """EBRUUN 6.04: 604-1, one robot, its task names the group all the same."""
    base = base_system((6, 4), ONE, multimove=True)
    (task,) = base.instances("SYS", "CAB_TASKS")
    assert task.text("UseMechanicalUnitGroup") == "rob1"


def test_digits_that_are_not_the_controllers():
    """120003 [real 6.03]; the expected digits are named."""
    loaded = load("SYS:CFG_1.0:6:1::\n", "EIO:CFG_1.0:6:0::\n", "SIO:CFG_1.0:7:0::\n")
    assert codes(loaded) == [("RG720", 1)] * 3
    assert "120003" in loaded.faults[0].message
    assert "6:0" in loaded.faults[0].label


def test_a_header_without_digits_is_taken():
    """ABB's DAP example on HOME of a 7.6."""
    assert load('SYS:CFG_1.0::\nCAB_TASKS:\n -Name "T_A"\n').faults == ()


def test_an_instance_that_exists():
    """120006 with the line [real 6.03]; names have no case (HONG)."""
    loaded = load(SYS6 + 'CAB_TASKS:\n\n -Name "t_rob1" -Type "NORMAL"\n')
    assert codes(loaded) == [("RG721", 4)]
    assert "120006" in loaded.faults[0].message


def test_an_instance_twice_in_one_file():
    assert codes(load(EIO6 + SIGNAL + ' -Name "DOA" -SignalType "DO"\n')) == [("RG721", 5)]


def test_modules_and_hooks_of_several_tasks_are_separate():
    """RARO repeats the file for each task, VInRoS the routine."""
    loaded = load(
        SYS6 + 'CAB_TASKS:\n -Name "T_A"\nCAB_TASK_MODULES:\n'
        ' -File "HOME:/a.sys" -Task "T_A"\n -File "HOME:/a.sys" -Task "T_ROB1"\n'
        'CAB_EXEC_HOOKS:\n -Routine "r" -Shelf "STOP" -Task "T_A"\n'
        ' -Routine "r" -Shelf "STOP" -Task "T_ROB1" -SeqNo 2\n'
    )
    assert loaded.faults == ()


@pytest.mark.parametrize(
    "text",
    [
        out("Error", arguments='-Arg2 "T_ROB1"'),
        out("TaskExecuting", arguments='-Arg2 "t_rob1"'),
        out("MechUnitNotMoving", arguments='-Arg1 "ROB_1"'),  # 6.13
        out("MechUnitNotMoving"),  # 6.04
        out("PPMoved", arguments='-Arg2 "T_ROB1" -Arg3 "MAIN"'),
        *map(out, ("EmStop", "MotOnState", "CycleOn", "AutoOn", "MotorOn", "RunchOk")),
    ],
)
def test_system_outputs_that_backups_show(text):
    assert load(text).faults == ()


@pytest.mark.parametrize(
    "text",
    [
        out("MechUnitNotMoving", arguments='-Arg2 "ROB_1"'),
        out("MechUnitNotMoving", arguments='-Arg1 "ROB_9"'),
        out("Error"),
        out("Error", arguments='-Arg1 "T_ROB1"'),
        out("TaskExecuting", arguments='-Arg2 "T_ROB9"'),
        out("ExecutionError", arguments='-Arg2 "T_ROB1"'),
        out("TCPSpeed", "aoA", '-Arg1 "ROB_1"'),
        out("EmStop", "doNone"),
        out("EmStop", "aoA"),
        out("EmStop", arguments='-Arg2 "T_ROB1"'),
        EIO6 + SIGNAL + 'SYSSIG_OUT:\n -Status "EmStop" -Name "doA"\n',
        SYS6 + 'SYSSIG_OUT:\n -Status "EmStop" -Name "doA"\n',
    ],
)
def test_a_fault_in_a_system_output(text):
    """71391 [real 6.03]."""
    result = load(text).faults
    assert {fault.code for fault in result} == {"RG722"}
    assert all("71391" in fault.message for fault in result)


def test_inputs_have_their_arguments_elsewhere():
    """Arg6 of LimitSpeed (TETOV), Arg7 of PpToMain (VInRoS), Arg1 of Start."""
    signal = EIO6 + 'EIO_SIGNAL:\n -Name "diA" -SignalType "DI"\n -Name "doA" -SignalType "DO"\n'
    right = (
        signal + 'SYSSIG_IN:\n -Signal "diA" -Action "Start" -Arg1 "CONT"\n'
        ' -Signal "diA" -Action "PpToMain" -Arg7 "T_ROB1"\n'
        ' -Signal "diA" -Action "LimitSpeed" -Arg6 "ROB_1"\n'
    )
    assert load(right).faults == ()
    wrong = signal + 'SYSSIG_IN:\n -Signal "doA" -Action "Stop"\n'
    assert codes(load(wrong)) == [("RG722", 6)]
    wrong = signal + 'SYSSIG_IN:\n -Signal "diA" -Action "LimitSpeed" -Arg1 "ROB_1"\n'
    assert codes(load(wrong)) == [("RG722", 6)]


SEVEN = {"robotware": (7, 6)}


def test_system_outputs_of_robotware_7():
    """In SYS with -Name (RARO); the signal lies in another file."""
    signals = EIO7 + SIGNAL
    for text in (
        out7("MotorOn"),
        out7("Error", arguments='-Arg2 "T_ROB1"'),
        out7("TCPSpeed", "aoA", '-Arg1 "ROB_1"'),
    ):
        assert load(text, signals, **SEVEN).faults == ()
    for text in (out7("MotorOn", name="Signal"), out7("MotOnState"), out7("TCPSpeed")):
        assert {fault.code for fault in load(text, signals, **SEVEN).faults} == {"RG722"}
    in_eio = EIO7 + SIGNAL + 'SYSSIG_OUT:\n -Status "MotorOn" -Signal "doA"\n'
    assert {fault.code for fault in load(in_eio, **SEVEN).faults} == {"RG722"}


def test_unconfirmed_words_on_robotware_7():
    """Refused, or taken where the reading says so."""
    open_words = out7("MechUnitNotMoving", arguments='-Arg1 "ROB_1"')
    assert load(open_words, EIO7 + SIGNAL, **SEVEN).faults
    assert not load(open_words, EIO7 + SIGNAL, open_words=True, **SEVEN).faults


def test_a_file_that_may_be_refused_is_left_out_whole():
    open_file = SYS7 + (
        'CAB_TASKS:\n -Name "T_A"\nSYSSIG_OUT:\n -Status "MotOnState" -Name "doA"\n'
    )
    signals = CfgFileLoad(parse_cfg(EIO7 + SIGNAL))
    optional = CfgFileLoad(parse_cfg(open_file, path="SYS_open.cfg"), optional=True)
    loaded = add(base_system((7, 6), ONE), (optional, signals))
    assert loaded.faults == ()
    assert [note.code for note in loaded.notes] == ["RG722"]
    assert loaded.cfg.tasks == {"t_rob1"}
    assert loaded.cfg.signal("doA")
    loaded = add(base_system((7, 6), ONE), (optional, signals), open_words=True)
    assert loaded.cfg.tasks == {"t_rob1", "t_a"}


RULE = 'FIREWALL_MANAGEMENT:\n -Name "RapidSockets" -EnableOnPublicNet\n'


def test_the_firewall_is_set_and_not_added():
    """The services are instances of a delivered OmniCore (backups of 7.5.2 and 7.6.1)."""
    sio = "SIO:CFG_1.0:7:0::\n" + RULE
    assert codes(load(sio, **SEVEN)) == [("RG721", 3)]
    loaded = add(base_system((7, 6), ONE), (CfgFileLoad(parse_cfg(sio), replace=True),))
    assert loaded.faults == ()
    rules = list(loaded.cfg.instances("SIO", "FIREWALL_MANAGEMENT"))
    (rule,) = (r for r in rules if r.text("Name") == "RapidSockets")
    assert rule.flag("EnableOnPublicNet")
    assert load(sio.replace("MENT", "R").replace("7:0", "6:1")).faults


@pytest.mark.parametrize(
    "text",
    [
        SYS6 + 'CAB_TASKS:\n -Name "T_A" -TrustLevel "NoSafety"\n',
        SYS6 + 'CAB_TASKS:\n -Name "T_A" -Typ "NORMAL"\n',
        SYS6 + 'CAB_TASKS:\n -Name "T_A" -UseMechanicalUnitGroup "rob1"\n',
        SYS6 + 'CAB_TASKS:\n -Name "T_A" -Task_in_forground "T_B"\n',
        SYS6 + 'CAB_TASK_MODULES:\n -File "HOME:/a.sys" -Task "T_B"\n',
        SYS6 + 'CAB_TASK_MODULES:\n -File "HOME:/a.sys"\n',
        SYS6 + 'CAB_EXEC_HOOKS:\n -Routine "r" -Shelf "HALT" -Task "T_ROB1"\n',
        SYS6 + 'CAB_EXEC_HOOKS:\n -Routine "r" -Shelf "STOP" -Task "T_B"\n',
        SYS6 + 'CAB_TASK:\n -Name "T_A"\n',
        SYS6 + 'MECHANICAL_UNIT_GROUP:\n -Name "rob1" -Robot "ROB_1"\n',
        EIO6 + 'EIO_SIGNAL:\n -Name "doA" -SignalType "DO" -Unit "board"\n',
        EIO6 + f'EIO_SIGNAL:\n -Name "{"x" * 33}" -SignalType "DO"\n',
        EIO6 + 'EIO_SIGNAL:\n -Name "doA" -SignalType "XO"\n',
        EIO6 + 'EIO_SIGNAL:\n -Name "doA"\n',
        "XYZ:CFG_1.0:6:0::\n",
    ],
)
def test_faults_without_a_known_event(text):
    result = load(text).faults
    assert {fault.code for fault in result} == {"RG723"}
    assert all("[mem]" in fault.message for fault in result)


def test_every_task_names_its_group_with_multimove():
    """MCUBE, EBRUUN, HONG: background tasks, too."""
    task = SYS6 + 'CAB_TASKS:\n -Name "T_A"'
    assert codes(load(task, robots=TWO)) == [("RG723", 3)]
    assert load(task + ' -UseMechanicalUnitGroup "ROB2"', robots=TWO).faults == ()
    assert codes(load(task + ' -UseMechanicalUnitGroup "rob3"', robots=TWO)) == [("RG723", 3)]


def test_planners_and_units_of_a_group():
    group = SYS6 + 'MECHANICAL_UNIT_GROUP:\n -Name "more" -Robot "ROB_1" {}\n'
    assert load(group.format('-MechanicalUnit_1 "TRACK_1"'), robots=TWO).faults == ()
    for wrong in ('-MechanicalUnit_1 "TRACK_2"', '-UseMotionPlanner "motion_planner_9"'):
        assert codes(load(group.format(wrong), robots=TWO)) == [("RG723", 3)]


def test_letters_beyond_ascii():
    file = CfgFileLoad(parse_cfg(SYS6), ascii=False)
    (fault,) = add(base_system((6, 15), ONE), (file,)).faults
    assert fault.code == "RG723"
