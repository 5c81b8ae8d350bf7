"""abb_driver on the same controller: it goes first, its files stay, its signals are used.

Its instances are those of its own page and of a RW 6.06 backup that has it (HONG in
docs/rapid/cfg.md): three modules with -AllTask, two SEMISTATIC tasks, the motion module in T_ROB1.
"""

import shutil

import pytest

from rapidgen.cli.deployment import deploy as deploy_verb
from rapidgen.deploy import apply, make_plan
from rapidgen.deploy.command_run import save_neighbours
from rapidgen.deploy.doctor import run_checks
from rapidgen.deploy.syspar import loaded_cfg
from rapidgen.deploy.target import Access, parse_target
from rapidgen.deploy.transports.folder import FolderTransport
from rapidgen.servers import serve_ftp
from rapidgen.system import parse_cfg
from tests.refusal import refused

BUILD = "aaaaaaaaaaaa"
CLEAN = """SYS:CFG_1.0:6:0::
#
CAB_TASK_MODULES:

      -File "HOME:/user.sys" -ModName "user" -AllTask
#
CAB_TASKS:

      -Name "T_ROB1" -Type "NORMAL" -MotionTask
"""
ABB_DRIVER = """SYS:CFG_1.0:6:0::
#
CAB_EXEC_HOOKS:

      -Routine "theirs" -Shelf "POWER_ON" -AllMotionTask -SeqNo 1

      -Routine "ROS_reset" -Shelf "RESET" -Task "ROS_MotionServer"

      -Routine "abort_trajectory" -Shelf "STOP" -Task "T_ROB1"
#
CAB_TASK_MODULES:

      -File "HOME:/user.sys" -ModName "user" -AllTask

      -File "HOME:/ROS/ROS_common.sys" -ModName "ROS_common" -AllTask

      -File "HOME:/ROS/ROS_socket.sys" -ModName "ROS_socket" -AllTask

      -File "HOME:/ROS/ROS_messages.sys" -ModName "ROS_messages" -AllTask

      -File "HOME:/ROS/ROS_stateServer.mod" -ModName "ROS_stateServer"\\
      -Task "ROS_StateServer"

      -File "HOME:/ROS/ROS_motionServer.mod" -ModName "ROS_motionServer"\\
      -Task "ROS_MotionServer"

      -File "HOME:/ROS/ROS_motion.mod" -ModName "ROS_motion" -Task "T_ROB1"

      -File "HOME:/logger.mod" -ModName "logger" -Task "T_LOG"
#
CAB_TASKS:

      -Name "T_ROB1" -Type "NORMAL" -MotionTask

      -Name "ROS_StateServer" -TrustLevel "None"

      -Name "ROS_MotionServer" -TrustLevel "SysStop"

      -Name "T_LOG" -Type "NORMAL"
"""
EIO = """EIO:CFG_1.0:6:1::
#
EIO_SIGNAL:

      -Name "signalmotoron" -SignalType "DO" -Label "theirs" -Access "All"
"""
GOES = [
    "CAB_EXEC_HOOKS ROS_reset RESET ROS_MotionServer",
    "CAB_EXEC_HOOKS abort_trajectory STOP T_ROB1",
    "CAB_TASK_MODULES HOME:/ROS/ROS_common.sys -AllTask",
    "CAB_TASK_MODULES HOME:/ROS/ROS_socket.sys -AllTask",
    "CAB_TASK_MODULES HOME:/ROS/ROS_messages.sys -AllTask",
    "CAB_TASK_MODULES HOME:/ROS/ROS_stateServer.mod ROS_StateServer",
    "CAB_TASK_MODULES HOME:/ROS/ROS_motionServer.mod ROS_MotionServer",
    "CAB_TASK_MODULES HOME:/ROS/ROS_motion.mod T_ROB1",
    "CAB_TASKS ROS_StateServer",
    "CAB_TASKS ROS_MotionServer",
]


@pytest.fixture
def controller(tmp_path):
    """A system folder with abb_driver in HOME:/ROS, loaded."""
    folder = tmp_path / "c"
    (folder / "HOME/ROS").mkdir(parents=True)
    (folder / "SYSPAR").mkdir()
    (folder / "SYSPAR/SYS.cfg").write_text(ABB_DRIVER)
    (folder / "SYSPAR/EIO.cfg").write_text(EIO)
    for file in ("common.sys", "socket.sys", "messages.sys", "motionServer.mod", "motion.mod"):
        name = f"ROS_{file}"
        text = f"MODULE {name.partition('.')[0]}\n  LOCAL PROC abort_trajectory()\n  ENDPROC\n"
        (folder / "HOME/ROS" / name).write_text(text + "ENDMODULE\n")
    return folder


THEIR_TASK = """
#
CAB_TASKS:

      -Name "t_ros_state" -Type "STATIC" -Entry "theirs"
#
CAB_TASK_MODULES:

      -File "HOME:/theirs.mod" -Task "T_ROS_state"
"""


def files(folder):
    return {p: p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def test_nothing_is_deployed_before_its_instances_are_out(kit, controller):
    transport = FolderTransport(controller)
    before = files(controller)
    plan = make_plan(transport, kit.driver(BUILD))
    assert [n.shown for n in plan.neighbour.instances] == GOES
    assert refused(apply, transport, plan) == ["RG534"]
    assert refused(apply, transport, plan, overwrite=True) == ["RG534"]
    assert files(controller) == before
    message = " | ".join(step.what for step in plan.steps)
    assert "back the controller up" in message
    assert "Controller > Task: ROS_StateServer; ROS_MotionServer |" in message
    assert "T_LOG" not in message
    assert "user.sys" not in message
    assert [step.stops_motion for step in plan.steps].count(True) == 1


def test_deploy_next_to_removed_driver_and_uninstall(kit, controller):
    transport = FolderTransport(controller)
    (controller / "SYSPAR/SYS.cfg").write_text(CLEAN)
    before = files(controller)
    plan = kit.deploy(transport, kit.driver(BUILD))
    assert plan.neighbour is None
    after = files(controller)
    assert {p: d for p, d in after.items() if p in before and p.parent.name != "SYSPAR"} == {
        p: d for p, d in before.items() if p.parent.name != "SYSPAR"
    }
    kit.deploy(transport, None, verb="uninstall")
    assert files(controller) == before


def test_its_signals_of_the_same_kind_are_used_as_they_are(kit, controller):
    transport = FolderTransport(controller)
    (controller / "SYSPAR/SYS.cfg").write_text(CLEAN)
    (change,) = [
        c for c in kit.deploy(transport, kit.driver(BUILD)).cfg if c.key.startswith("EIO_SIGNAL")
    ]
    assert change.action == "use"
    again = make_plan(transport, kit.driver("b" * 12))
    assert {c.action for c in again.cfg if c.domain == "EIO"} == {"use"}
    (signal,) = parse_cfg((controller / "SYSPAR/EIO.cfg").read_bytes()).instances("EIO_SIGNAL")
    assert signal.text("Label") == "theirs"
    kit.deploy(transport, kit.driver("b" * 12, signals=()))
    assert (controller / "SYSPAR/EIO.cfg").read_text() == EIO


def test_a_signal_of_another_kind_is_refused(kit, controller):
    transport = FolderTransport(controller)
    (controller / "SYSPAR/SYS.cfg").write_text(CLEAN)
    (controller / "SYSPAR/EIO.cfg").write_text(EIO.replace('"DO"', '"GI"'))
    before = files(controller)
    assert refused(kit.deploy, transport, kit.driver(BUILD), overwrite=True) == ["RG535"]
    assert files(controller) == before


OUTPUT = """#
SYSSIG_OUT:

      -Status "MotOnState" -Signal "signalMotorOn"{}
"""


@pytest.mark.parametrize(
    ("foreign", "action"),
    [(OUTPUT.format(""), "same"), (OUTPUT.format(' -Arg1 "x"'), "use"), ("", "add")],
)
def test_its_system_outputs_are_used(kit, controller, foreign, action):
    transport = FolderTransport(controller)
    (controller / "SYSPAR/SYS.cfg").write_text(CLEAN)
    (controller / "SYSPAR/EIO.cfg").write_text(EIO + foreign)
    plan = kit.deploy(transport, kit.driver(BUILD, outputs=OUTPUT.format("")))
    assert {c.action for c in plan.cfg if "SYSSIG_OUT" in c.key} == {action}
    text = parse_cfg((controller / "SYSPAR/EIO.cfg").read_bytes())
    assert len(list(text.instances("SYSSIG_OUT"))) == 1
    kit.deploy(transport, None, verb="uninstall")
    assert (controller / "SYSPAR/EIO.cfg").read_text() == EIO + foreign


def test_a_signal_that_another_output_drives_is_refused(kit, controller):
    transport = FolderTransport(controller)
    (controller / "SYSPAR/SYS.cfg").write_text(CLEAN)
    other = OUTPUT.format("").replace("MotOnState", "AutoOn")
    (controller / "SYSPAR/EIO.cfg").write_text(EIO + other)
    assert refused(kit.deploy, transport, kit.driver(BUILD, outputs=OUTPUT.format(""))) == ["RG535"]


def test_where_cfg_is_not_seen_its_files_refuse_until_a_backup_says_they_are_not_loaded(
    kit, controller, tmp_path
):
    home = FolderTransport(controller / "HOME")
    plan = make_plan(home, kit.driver(BUILD))
    assert plan.neighbour.instances == ()
    assert set(plan.neighbour.files) >= {"ROS/ROS_common.sys", "ROS/ROS_motion.mod"}
    assert refused(apply, home, plan) == ["RG534"]
    shutil.copytree(controller, tmp_path / "backup")
    loaded = loaded_cfg(tmp_path / "backup")
    plan = make_plan(home, kit.driver(BUILD), loaded=loaded)
    assert [n.shown for n in plan.neighbour.instances] == GOES
    assert refused(apply, home, plan) == ["RG534"]
    (tmp_path / "backup/SYSPAR/SYS.cfg").write_text(CLEAN)
    plan = make_plan(home, kit.driver(BUILD), loaded=loaded_cfg(tmp_path / "backup"))
    apply(home, plan)
    assert kit.verdict(controller / "HOME", kit.driver(BUILD)) == "set 0"
    (load,) = [s.what for s in plan.steps if s.what.startswith("load HOME:/rapidgen_deploy/SYS")]
    assert "(8 instances to add, 0 to change)" in load


def test_a_driver_of_ours_that_was_copied_by_hand_is_another_driver_too(kit, controller):
    (controller / "SYSPAR/SYS.cfg").write_text(
        CLEAN.replace(
            '"HOME:/user.sys" -ModName "user" -AllTask', '"HOME:/ROS/x.sys" -Task "T_ROB1"'
        )
    )
    (controller / "HOME/ROS/x.sys").write_text("MODULE ros_COMMON(SYSMODULE)\nENDMODULE\n")
    plan = make_plan(FolderTransport(controller), kit.driver(BUILD))
    assert [n.shown for n in plan.neighbour.instances] == [
        "CAB_TASK_MODULES HOME:/ROS/x.sys T_ROB1"
    ]


def test_a_backup_that_restores_modules_with_our_names_is_refused(kit, controller):
    (controller / "SYSPAR/SYS.cfg").write_text(CLEAN)
    (controller / "RAPID/TASK1/SYSMOD").mkdir(parents=True)
    (controller / "RAPID/TASK1/SYSMOD/ROS_COMMON.sys").write_text("MODULE ROS_common\nENDMODULE\n")
    (controller / "RAPID/TASK1/SYSMOD/user.sys").write_text("MODULE user\nENDMODULE\n")
    transport = FolderTransport(controller)
    before = files(controller)
    plan = make_plan(transport, kit.driver(BUILD))
    assert plan.in_memory == ("RAPID/TASK1/SYSMOD/ROS_COMMON.sys",)
    assert refused(apply, transport, plan, overwrite=True) == ["RG537"]
    assert files(controller) == before


def test_a_folder_without_syspar_is_no_backup(tmp_path):
    assert refused(loaded_cfg, tmp_path) == ["RG536"]


def test_doctor_says_whether_the_steps_were_done(kit, controller, tmp_path):
    """Over a HOME alone, with backups from before and after loading."""
    (controller / "SYSPAR/SYS.cfg").write_text(CLEAN)
    shutil.copytree(controller, tmp_path / "before")
    kit.deploy(FolderTransport(controller), kit.driver(BUILD))
    target = parse_target(f"dir://{controller / 'HOME'}")
    for backup, verdict in ((tmp_path / "before", "warn"), (controller, "ok"), (None, "unknown")):
        checks = run_checks(
            target, Access(), kit.driver(BUILD), hello=lambda host, port: None, backup=backup
        )
        assert [c.verdict for c in checks if c.area == "configuration"] == [verdict]


def test_over_ftp_the_backup_is_an_option_of_every_verb(kit, controller, tmp_path, monkeypatch):
    folder = built(kit, tmp_path)
    shutil.copytree(controller, tmp_path / "backup")
    service = serve_ftp(controller / "HOME", password="x")
    monkeypatch.setenv("RAPIDGEN_PASSWORD", "x")
    monkeypatch.chdir(tmp_path)
    url = [f"ftp://127.0.0.1:{service.port}"]
    options = {"yes": True, "backup": tmp_path / "backup"}
    try:
        assert refused(deploy_verb, str(folder), url, yes=True) == ["RG534"]
        assert refused(deploy_verb, str(folder), url, **options) == ["RG534"]
        (tmp_path / "backup/SYSPAR/SYS.cfg").write_text(CLEAN)
        assert refused(deploy_verb, str(folder), [*url, f"dir://{tmp_path}"], **options) == [
            "RG536"
        ]
        assert deploy_verb(str(folder), url, **options) == 0
    finally:
        service.close()
    assert kit.verdict(controller / "HOME", kit.driver(BUILD)) == "set 0"
    assert (controller / "HOME/ROS/ROS_common.sys").is_file()


def built(kit, tmp_path):
    folder = tmp_path / "built"
    for path, data in kit.driver_files(BUILD).items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(data)
    return folder


def test_doctor_names_it_and_a_copy_loads_it_again(kit, controller, tmp_path, monkeypatch):
    target = parse_target(f"dir://{controller}")
    checks = run_checks(target, Access(), kit.driver(BUILD), hello=lambda host, port: None)
    (result,) = [c for c in checks if c.area == "drivers"]
    assert (result.verdict, "ROS_common.sys -AllTask" in result.found) == ("fail", True)
    folder = built(kit, tmp_path)
    monkeypatch.chdir(tmp_path)
    assert refused(deploy_verb, str(folder), [f"dir://{controller}"], yes=True) == ["RG534"]
    (copy,) = (tmp_path / ".rapidgen/before").rglob("*.cfg")
    retained = parse_cfg(copy.read_bytes())
    assert [i.text("Name") for i in retained.instances("CAB_TASKS")] == [
        "ROS_StateServer",
        "ROS_MotionServer",
    ]
    assert len([i for s in retained.sections for i in s.instances]) == len(GOES)


def test_foreign_task_with_our_name_is_not_taken_over(kit, controller):
    path = controller / "SYSPAR/SYS.cfg"
    path.write_text(CLEAN + THEIR_TASK)
    transport = FolderTransport(controller)
    plan = make_plan(transport, kit.driver(BUILD))
    assert [n.shown for n in plan.neighbour.instances] == [
        "CAB_TASK_MODULES HOME:/theirs.mod T_ROS_state"
    ]
    before = files(controller)
    assert refused(apply, transport, plan, overwrite=True) == ["RG534"]
    assert files(controller) == before
    path.write_text(CLEAN)
    kit.deploy(transport, kit.driver(BUILD))
    # A module that is loaded later into a task of the driver is intentional.
    text = path.read_text().replace(
        "CAB_TASK_MODULES:\n",
        'CAB_TASK_MODULES:\n\n      -File "HOME:/x.mod" -Task "T_ROS_state"\n',
    )
    path.write_text(text)
    assert make_plan(transport, kit.driver("bbbbbbbbbbbb")).neighbour is None


def test_a_copy_of_what_loads_the_other_driver_outlives_a_second_run(kit, controller, tmp_path):
    """Between the runs half of its instances were deleted, as the steps say."""
    transport, folder = FolderTransport(controller), tmp_path / "before"
    first = make_plan(transport, kit.driver(BUILD))
    (complete,) = save_neighbours([first], folder)
    text = complete.read_bytes()
    path = controller / "SYSPAR/SYS.cfg"
    path.write_text(ABB_DRIVER.replace('-Name "ROS_StateServer" -TrustLevel "None"', ""))
    (remaining,) = save_neighbours([make_plan(transport, kit.driver(BUILD))], folder)
    assert (complete.name, remaining.name) == ("SYS.cfg", "SYS-2.cfg")
    assert complete.read_bytes() == text
    assert b"ROS_StateServer" in text
    assert save_neighbours([first], folder) == [complete]
