"""Plans and refusals by state: pending restart, clashes, programs."""

import json
import shutil
from dataclasses import replace

import pytest

from rapidgen.deploy import backup_set, make_plan, plan_json
from rapidgen.deploy.command_run import check_plans, earlier_set, write_plans
from rapidgen.deploy.doctor import _contents
from rapidgen.deploy.online.verify import PostRestartCheck
from rapidgen.deploy.plan_text import plan_text
from rapidgen.diagnostics import DiagnosticError
from rapidgen.wire.rws.bodies import Generation
from tests.refusal import refusal, refused


@pytest.fixture
def cell(rws, tmp_path):
    """An empty controller with RWS 1.0, and a transport to it."""
    with rws.empty_runner(tmp_path, Generation.ONE) as controller_runner:
        yield controller_runner, rws.connect(rws.Line(controller_runner, Generation.ONE))


@pytest.fixture(scope="module")
def wanted(rws):
    return rws.build(Generation.ONE)


def modules(controller_runner, task="T_ROB1"):
    return [
        m.name
        for m in controller_runner.programs.modules(controller_runner.controller.rapid_tasks[task])
    ]


def test_a_plan_and_a_look_change_nothing(rws, cell, wanted, tmp_path):
    controller_runner, transport = cell
    before = rws.home_of(controller_runner), rws.cfg_of(controller_runner)
    line = transport.services._runner.line
    plan = make_plan(transport, wanted)
    assert {m for m, t in line.log if not t.startswith("/users")} == {"GET"}
    assert (rws.home_of(controller_runner), rws.cfg_of(controller_runner)) == before
    text = plan_text(plan)
    assert "(virtual, RobotWare 6.15" in text
    for cfg in wanted.cfg:
        count = sum(len(section.instances) for section in cfg.sections)
        assert f"  > load {count} instances of {cfg.domain} by add\n" in text
    assert "> save and unload T_ROB1/MainModule, which has a main, too (--overwrite)" in text
    assert "! you: a warm start: --restart does it" in text
    write_plans(tmp_path / "plan.json", [plan])
    assert (
        json.loads((tmp_path / "plan.json").read_text())["plans"][0]["controller"]
        == controller_runner.id
    )


def test_a_plan_is_of_one_controller(rws, cell, wanted, tmp_path):
    controller_runner, transport = cell
    plan = make_plan(transport, wanted)
    write_plans(tmp_path / "plan.json", [plan])
    controller_runner.id = "ANOTHER"
    again = make_plan(transport, wanted)
    assert refusal(check_plans, tmp_path / "plan.json", [again]).diagnostics[0].code == "RG540"
    other = replace(plan, live=replace(plan.live, id="ELSE"))
    assert "RG540" in refused(rws.apply, transport, other, overwrite=True)
    assert not rws.home_of(controller_runner)


def test_clashing_module_is_unloaded_only_with_overwrite(rws, cell, wanted):
    controller_runner, transport = cell
    assert "RG541" in refused(rws.run, transport, wanted, overwrite=False)
    assert not rws.home_of(controller_runner)
    transport.services.set_symbol("T_ROB1/MainModule/x", 7)
    rws.run(transport, wanted)
    assert "MainModule" not in modules(controller_runner)
    saved = rws.home_of(controller_runner)["rapidgen_deploy/unloaded/T_ROB1/MainModule.mod"]
    assert b"PERS num x := 7;" in saved
    rws.run(transport, None, "uninstall")
    assert modules(controller_runner) == ["MainModule"]
    assert transport.services.symbol("T_ROB1/MainModule/x") == 7


def test_a_program_that_runs_is_not_stopped(rws, cell, wanted):
    controller_runner, transport = cell
    rws.run(transport, wanted)
    transport.services.motors(True)
    transport.services.start()
    plan = make_plan(transport, None, verb="uninstall")
    assert (
        "! you: stop the program: `rapidgen stop-program rws://cell` (stops motion)"
        in plan_text(plan)
    )
    files = rws.home_of(controller_runner)
    assert "RG542" in refused(rws.run, transport, None, "uninstall")
    assert rws.home_of(controller_runner) == files
    assert transport.services.execution().running


def test_manual_mode_is_a_persons_step(rws, cell, wanted):
    controller_runner, transport = cell
    controller_runner.controller.set_mode("manual_reduced")
    assert "! pendant: automatic mode (it is MANR)" in plan_text(make_plan(transport, wanted))
    assert "RG542" in refused(rws.run, transport, wanted)
    assert not rws.home_of(controller_runner)


def grants_rmmp(controller_runner, answer="Grant"):
    """Grant every question at the pendant; return the questions."""
    operator, requested = controller_runner.controller.operator, []
    operator.attach()

    def look():
        for question in operator.questions:
            if not question.answered:
                requested.append(question.text)
                operator.answer(question.number, answer)

    operator.asked.add(look)
    return requested


def test_manual_mode_is_written_in_when_the_pendant_grants_it(rws, cell, wanted):
    controller_runner, transport = cell
    controller_runner.controller.set_mode("manual_reduced")
    requested, message = grants_rmmp(controller_runner), []
    rws.run(transport, wanted, message=message)
    assert "rapidgen" in requested[0]
    assert any("Press Grant there within 10 s" in line for line in message)
    assert rws.home_of(controller_runner)
    assert controller_runner.restarts == 1


def test_what_the_pendant_denies_changes_nothing(rws, cell, wanted):
    controller_runner, transport = cell
    controller_runner.controller.set_mode("manual_reduced")
    grants_rmmp(controller_runner, "Deny")
    text = refused(rws.run, transport, wanted)
    assert "RG542" in text
    assert not rws.home_of(controller_runner)


def test_missing_grant_is_refused_before_changes(rws, cell, wanted):
    controller_runner, transport = cell
    app = transport.services._runner.line.app
    app.accounts = replace(app.accounts, denied=frozenset({"UAS_CFG_WRITE"}))
    plan = make_plan(transport, wanted)
    assert "! you: give the user UAS_CFG_WRITE in RobotStudio" in plan_text(plan)
    text = refused(rws.run, transport, wanted)
    assert "RG542" in text
    assert not rws.home_of(controller_runner)


def test_an_uninstall_without_a_restart_is_pending_until_one(rws, cell, wanted):
    controller_runner, transport = cell
    rws.run(transport, wanted)
    transport.services.stop(everything=True)
    message = []
    rws.run(transport, None, "uninstall", restart=False, message=message)
    assert message[-1].startswith("restart pending")
    pending = make_plan(transport, None, verb="uninstall")
    assert pending.is_pending
    assert "restart pending" in plan_text(pending)
    assert "cfg no longer has T_ROS_" in plan_text(make_plan(transport, wanted))
    result = {(c.area, c.verdict): c.found for c in _contents(transport, wanted, ())}
    assert "a restart is pending" in result["restart", "warn"]
    rws.run(transport, None, "uninstall")
    assert controller_runner.restarts == 2
    assert "RG529" in refused(make_plan, transport, None, verb="uninstall")


def test_people_are_waited_for(rws, cell, wanted):
    controller_runner, transport = cell
    rws.run(transport, wanted)
    transport.services.motors(True)
    transport.services.start()
    controller_runner.controller.set_mode("manual_reduced")
    acts = [lambda: controller_runner.controller.set_mode("auto")]

    def person(seconds):
        rws.pass_time(controller_runner, seconds)
        if acts:
            acts.pop()()

    message = []
    rws.run(transport, None, "uninstall", wait=30, pause=person, message=message)
    (waited,) = [line for line in message if line.startswith("waiting")]
    assert "is in mode MANR" in waited
    assert modules(controller_runner) == ["MainModule"]


def test_run_end_releases_mastership_and_sessions(rws, cell, wanted):
    _, transport = cell
    rws.run(transport, wanted, restart=False)
    app = transport.services._runner.line.app
    for domain in ("cfg", "rapid"):
        assert transport.services.holder(domain) is None
    assert len(app.sessions) == 1
    transport.close()
    assert len(app.sessions) == 0


def test_pending_restart_is_shown_until_done(rws, cell, wanted):
    controller_runner, transport = cell
    message = []
    rws.run(transport, wanted, restart=False, message=message)
    assert message[-1].startswith("restart pending")
    plan = make_plan(transport, wanted)
    assert plan.is_pending
    assert plan_json(plan)["restart_pending"]
    assert "  * everything is loaded, and counts after a restart: restart pending" in plan_text(
        plan
    )
    assert not controller_runner.restarts
    controller_runner.ask_restart()  # a person at the pendant
    rws.pass_time(controller_runner, 1.0)
    assert make_plan(transport, wanted).is_empty


def test_restart_is_warm_and_needs_the_option(rws, cell, wanted):
    controller_runner, transport = cell
    rws.run(transport, wanted, restart=False)
    line = transport.services._runner.line
    assert not [t for _, t in line.log if "restart" in t]
    rws.run(transport, wanted)
    assert controller_runner.restarts == 1
    assert len([t for _, t in line.log if "action=restart" in t]) == 1
    assert not [t for _, t in line.log if "reset" in t]


def test_a_controller_that_restarts_is_busy_for_a_while(rws, cell, wanted):
    controller_runner, transport = cell
    line, busy = transport.services._runner.line, []
    handle = line.handle

    def slow(got):
        if controller_runner.restarts and len(busy) < 10:
            rws.pass_time(controller_runner, 0.5)
            busy.append(got.target)
            return rws.busy
        return handle(got)

    line.handle = slow
    rws.run(transport, wanted)
    assert len(busy) == 10


def test_normal_tasks_that_stand_are_updated_without_a_restart(rws, generation, tmp_path):
    """Commissioning: all tasks of the driver are NORMAL."""
    slow = ("commissioning=true",)
    old, new = rws.build(generation, *slow), rws.build(generation, *slow, "trajectory.capacity=500")
    with rws.empty_runner(tmp_path, generation) as controller_runner:
        transport = rws.connect(rws.Line(controller_runner, generation))
        rws.run(transport, old)
        transport.services.motors(True)
        transport.services.start()
        restarts = controller_runner.restarts
        assert "RG542" in refused(rws.run, transport, new, restart=False)  # the user stops it
        transport.services.stop()
        message = []
        plan = rws.run(transport, new, restart=False, message=message)
        assert not plan.live.restart
        assert not [step for step in plan.steps if "warm start" in step.what]
        assert controller_runner.restarts == restarts
        assert make_plan(transport, new).is_empty
        assert not [line for line in message if line.startswith("!")]  # every pointer is at main
        transport.services.start()
        assert transport.services.execution().running


def test_an_update_and_the_way_back(rws, cell, wanted):
    _, transport = cell
    newer = rws.build(Generation.ONE, "trajectory.capacity=500")
    rws.run(transport, wanted)
    rws.run(transport, newer)
    assert transport.services.symbol("T_ROB1/ROS_common/ROS_BUILD_ID") == newer.build_id
    assert make_plan(transport, newer).is_empty
    rws.run(transport, backup_set(transport, "", 2), "rollback")
    for task in ("T_ROB1", "T_ROS_RECV", "T_ROS_STATE"):
        symbol = f"{task}/ROS_common/ROS_BUILD_ID"
        assert transport.services.symbol(symbol) == wanted.build_id
    assert make_plan(transport, wanted).is_empty


def test_a_driver_that_was_loaded_by_hand_comes_back_with_its_background_tasks(rws, cell, wanted):
    """Its tasks stand in modules that are to be loaded again."""
    controller_runner, transport = cell
    rws.run(transport, wanted)
    shutil.rmtree(controller_runner.controller.files.path("HOME:/rapidgen_deploy"))
    shutil.rmtree(controller_runner.controller.files.path("HOME:/rapidgen"))
    before = {
        task: modules(controller_runner, task) for task in controller_runner.controller.rapid_tasks
    }
    rws.pass_time(controller_runner, 1.0)
    assert controller_runner.controller.rapid_tasks["T_ROS_CONTROL"].stack()
    transport = rws.connect(rws.Line(controller_runner, Generation.ONE))
    text = plan_text(rws.run(transport, rws.build(Generation.ONE, "trajectory.capacity=500")))
    (row,) = (line for line in text.splitlines() if "save and unload T_ROB1/" in line)
    assert row.count("ROS_") > 3
    assert row.endswith("each of which has a name of ours (--overwrite)")
    rws.pass_time(controller_runner, 1.0)
    rws.run(transport, None, "uninstall")
    assert {t: sorted(modules(controller_runner, t)) for t in before} == {
        t: sorted(names) for t, names in before.items()
    }


def test_old_and_new_modules_in_one_task_are_not_taken_for_new(rws, cell, wanted):
    """An interruption after the first module: it alone has the new BUILD_ID."""
    controller_runner, transport = cell
    newer = rws.build(Generation.ONE, "trajectory.capacity=500")
    rws.run(transport, wanted)
    rws.run(transport, newer, restart=False)
    transport.services.stop(everything=True)
    transport.services.load_module("T_ROB1", "HOME/rapidgen/ROS_common.sys", replace=True)
    controller_runner.ask_restart()
    rws.pass_time(controller_runner, 1.0)
    assert "T_ROB1/ROS_motion" in [m.shown for m in make_plan(transport, newer).live.replace]
    rws.run(transport, newer)
    assert make_plan(transport, newer).is_empty


def test_success_and_then_a_system_failure(rws, cell, wanted):
    """2xx on all of it, and what boots is broken: the way back is offered, and works."""
    controller_runner, transport = cell
    home = rws.home_of(controller_runner)
    bad = [
        replace(f, data=f.data.replace(b"ENDMODULE", b"  oops := ;\r\nENDMODULE"))
        if f.path.endswith("ROS_stateServer.mod")
        else f
        for f in wanted.files
    ]
    broken = replace(wanted, files=tuple(bad))
    (result,) = refusal(rws.run, transport, broken).diagnostics
    assert result.code == "RG544"
    assert "system failure" in result.message
    assert "`rapidgen uninstall` with --restart" in result.help
    assert any("ROS_stateServer" in note for note in result.notes)
    rws.run(transport, None, "uninstall")
    assert rws.home_of(controller_runner) == home
    assert modules(controller_runner) == ["MainModule"]
    assert transport.services.panel().state != "sysfail"


def test_rollback_out_of_a_system_failure(rws, generation, tmp_path):
    """An update is agreed to with 2xx throughout, and what boots is broken."""
    old, new = rws.build(generation), rws.build(generation, "trajectory.capacity=500")
    bad = [
        replace(f, data=f.data.replace(b"ENDMODULE", b"  oops := ;\r\nENDMODULE"))
        if "ROS_stateServer" in f.path
        else f
        for f in new.files
    ]
    with rws.empty_runner(tmp_path, generation) as controller_runner:
        transport = rws.connect(rws.Line(controller_runner, generation))
        rws.run(transport, old)
        (result,) = refusal(rws.run, transport, replace(new, files=tuple(bad))).diagnostics
        assert result.code == "RG544"
        assert "`rapidgen rollback` with --restart" in result.help
        assert transport.services.panel().state == "sysfail"
        rws.run(transport, earlier_set(transport, "", None), "rollback")
        assert transport.services.panel().state != "sysfail"
        assert make_plan(transport, old).is_empty


def test_a_port_must_serve_our_build(rws, cell, wanted):
    _, transport = cell
    requested = []

    def other(host, port):
        requested.append((host, port))
        return "another-one!"

    proof = PostRestartCheck(other, "cell")
    (result,) = refusal(rws.run, transport, wanted, proof=proof).diagnostics
    assert (result.code, requested) == ("RG544", [("cell", 11002)])
    assert "rob1 state cell:11002 serves another-one!" in result.message


def test_messages_contain_no_password(rws, cell, wanted, tmp_path):
    _, transport = cell
    message = []
    plan = rws.run(transport, wanted, message=message)
    write_plans(tmp_path / "plan.json", [plan])
    text = [*message, plan_text(plan), (tmp_path / "plan.json").read_text(), repr(plan)]
    text += [repr(transport.services), repr(transport.services._core), repr(transport)]
    assert rws.PASSWORD not in "".join(text)


def background(controller_runner):
    """States of the driver's background tasks."""
    tasks = controller_runner.controller.rapid_tasks.values()
    return {task.state for task in tasks if task.spec.type != "NORMAL"}


def killed_after(rws, controller_runner, wanted, target):
    """A run that is killed after a request; where later runs go, and what it had got done."""
    line = rws.Line(controller_runner, Generation.ONE)
    line.cut = lambda number, got: "after" if target in got.target else None
    killed = rws.connect(line)
    with pytest.raises(DiagnosticError):
        rws.run(killed, wanted)
    assert line.dead
    later = rws.Line(controller_runner, Generation.ONE)
    later.app = line.app  # the same controller: the session is still there
    return rws.connect(later)


@pytest.mark.parametrize("target", ["/rw/rapid/execution?action=stop", "action=loadmod"])
def test_a_run_that_was_killed_while_tasks_stand_is_taken_up_again(rws, cell, wanted, target):
    """The controller ends a session after 300 idle seconds [RWS manual]."""
    controller_runner, transport = cell
    rws.run(transport, wanted)
    newer = rws.build(Generation.ONE, "trajectory.capacity=500")
    transport = killed_after(rws, controller_runner, newer, target)
    assert background(controller_runner) == {"stopped"}
    since, message = controller_runner.now, []
    rws.run(transport, newer, message=message, pause=lambda s: rws.pass_time(controller_runner, s))
    held = [text for text in message if text.startswith("waiting for mastership")]
    # A run that is killed while it stops tasks has no mastership.
    assert len(held) == ("loadmod" in target)
    assert (controller_runner.now - since > 250) == ("loadmod" in target)
    assert all("another run of rapidgen" in text for text in held)
    assert background(controller_runner) == {"running"}
    assert transport.services.symbol("T_ROS_RECV/ROS_common/ROS_BUILD_ID") == newer.build_id


def test_background_tasks_that_were_left_stopped_are_started_by_a_restart(rws, cell, wanted):
    """Nothing is to be loaded: the killed run had only stopped them, or the old set is wanted."""
    controller_runner, transport = cell
    rws.run(transport, wanted)
    assert make_plan(transport, wanted).is_empty
    transport.services.stop(everything=True)
    assert background(controller_runner) == {"stopped"}
    plan = make_plan(transport, wanted)
    assert plan.is_pending
    names = ", ".join(plan.live.silent)
    assert {"T_ROS_RECV", "T_ROS_STATE", "T_ROS_CONTROL"} <= {*plan.live.silent}
    assert f"it starts {names}, which are stopped" in plan_text(plan)
    result = {c.area: (c.verdict, c.found) for c in _contents(transport, wanted, ())}
    assert result["tasks"] == (
        "fail",
        f"{names} of the driver are stopped: its ports do not answer",
    )
    rws.run(transport, wanted)
    assert background(controller_runner) == {"running"}
    assert make_plan(transport, wanted).is_empty


@pytest.mark.parametrize("domain", ["cfg", "rapid"])
def test_foreign_mastership_prevents_any_stop(rws, cell, wanted, domain):
    controller_runner, transport = cell
    rws.run(transport, wanted)
    line = rws.Line(controller_runner, Generation.ONE)
    line.app = transport.services._runner.line.app
    other = rws.connect(line).services
    other.take_mastership(domain)
    line.app.sessions.all()[-1].application = "RobotStudio"
    newer = rws.build(Generation.ONE, "trajectory.capacity=500")
    before = rws.home_of(controller_runner), rws.cfg_of(controller_runner)
    error = refusal(rws.run, transport, newer)
    assert error.diagnostics[0].code == "RG542"
    assert f"mastership of {domain} at rws://cell is held by " in error.diagnostics[0].message
    assert "RobotStudio" in error.diagnostics[0].message
    assert (rws.home_of(controller_runner), rws.cfg_of(controller_runner)) == before
    assert background(controller_runner) == {"running"}
    messages = []

    def person(seconds):
        rws.pass_time(controller_runner, seconds)
        other.give_mastership(domain)

    rws.run(transport, newer, message=messages, wait=30, pause=person)
    assert any("waiting for a person: mastership of" in text for text in messages)
    assert background(controller_runner) == {"running"}
