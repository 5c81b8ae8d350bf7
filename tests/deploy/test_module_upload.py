"""`rapidgen load` against served virtual controllers of each generation of web services."""

import json

import pytest

from rapidgen.cli.app import main
from rapidgen.deploy.online.module_upload import FOLDER, make_upload_plan, upload_module
from rapidgen.diagnostics import DiagnosticError
from rapidgen.wire.rws.bodies import Generation
from tests.deploy.test_module_execution import connected, serving
from tests.servers.rws.served import MAIN

CHANGED = MAIN.replace("WaitTime 0.1", "WaitTime 0.5").replace(
    "list{3} := [1,2,3]", "list{2} := [7,8]"
)


@pytest.fixture
def services(request, tmp_path):
    generation = getattr(request, "param", Generation.TWO)
    with serving(tmp_path, generation) as (_, service), connected(service, tmp_path) as client:
        yield client


def upload(services, plan, text, kept=None):
    upload_module(
        services,
        plan,
        text.encode(),
        "a.mod",
        keep=(kept if kept is not None else []).append,
        say=lambda _: None,
    )


def code(fault):
    return {one.code for one in fault.value.diagnostics}


@pytest.mark.parametrize("services", list(Generation), indirect=True)
def test_replaces_exactly_what_the_plan_shows(services):
    services.set_symbol("T_ROB1/MainModule/x", 5)
    plan = make_upload_plan(services, CHANGED.encode(), "a.mod")
    assert (plan.task, plan.module, plan.action) == ("T_ROB1", "MainModule", "replace")
    assert "-            WaitTime 0.1;" in plan.diff
    assert "+            WaitTime 0.5;" in plan.text()
    kept = []
    upload(services, plan, CHANGED, kept)
    assert services.symbol_text("T_ROB1/MainModule/list") == "[7,8]"
    # The replaced module has the values that it had on the controller.
    assert b"x:=5" in kept[0].replace(b" ", b"")
    assert not [f for f in services.list_files(FOLDER) if not f.is_folder]
    again = make_upload_plan(services, CHANGED.encode(), "a.mod")
    assert (again.action, again.diff) == ("keep", ())


def test_adds_a_module_and_unloads_it_after_build_errors(services):
    text = 'MODULE extra\n  PERS num one := "1";\nENDMODULE\n'
    plan = make_upload_plan(services, text.encode(), "a.mod")
    assert (plan.task, plan.action) == ("T_ROB1", "add")
    with pytest.raises(DiagnosticError) as fault:
        upload(services, plan, text)
    assert code(fault) == {"RG342"}
    assert "extra" not in [m.name for m in services.modules("T_ROB1")]
    good = text.replace('"1"', "1")
    upload(services, make_upload_plan(services, good.encode(), "a.mod"), good)
    assert "extra" in [m.name for m in services.modules("T_ROB1")]


def test_build_errors_bring_the_earlier_module_back(services):
    services.set_symbol("T_ROB1/MainModule/x", 5)
    broken = MAIN.replace("count := 0", 'count := "0"')
    plan = make_upload_plan(services, broken.encode(), "a.mod")
    with pytest.raises(DiagnosticError) as fault:
        upload(services, plan, broken)
    assert code(fault) == {"RG342"}
    assert '"0"' not in services.module_text("T_ROB1", "MainModule")
    assert services.symbol_text("T_ROB1/MainModule/x") == "5"
    assert services.build_errors("T_ROB1") == ()


def test_a_change_since_the_plan_is_refused(services):
    plan = make_upload_plan(services, CHANGED.encode(), "a.mod")
    with pytest.raises(DiagnosticError) as fault:
        upload(services, plan, CHANGED + "! later\n")
    assert code(fault) == {"RG341"}
    other = MAIN.replace("0.1", "0.2")
    upload(services, make_upload_plan(services, other.encode(), "b.mod"), other)
    with pytest.raises(DiagnosticError) as fault:
        upload(services, plan, CHANGED)
    assert code(fault) == {"RG341"}
    assert "0.2" in services.module_text("T_ROB1", "MainModule")


def test_a_running_program_and_unknown_tasks_are_refused(services):
    services.start()
    plan = make_upload_plan(services, CHANGED.encode(), "a.mod")
    assert "T_ROB1 run" in plan.obstacles[0]
    with pytest.raises(DiagnosticError):
        upload(services, plan, CHANGED)
    services.stop()
    with pytest.raises(DiagnosticError) as fault:
        make_upload_plan(services, CHANGED.encode(), "a.mod", task="T_ROB2")
    assert code(fault) == {"RG340"}
    # The pointer of the stopped program is in the module: the plan says where it goes.
    plan = make_upload_plan(services, CHANGED.encode(), "a.mod")
    assert plan.pointer == "main"
    upload(services, plan, CHANGED)
    services.start()
    assert services.execution().running


def test_command_shows_the_plan_asks_and_keeps_a_copy(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setenv("RAPIDGEN_PASSWORD", "robotics")
    (tmp_path / "new.mod").write_text(CHANGED)
    with serving(tmp_path, Generation.ONE) as (_, service):
        words = ["load", "new.mod", "--to", f"rws://{service.host}:{service.port}"]
        assert main([*words, "--plan", "--json"]) == 0
        plan = json.loads(capsys.readouterr().out)
        assert main(words) == 2  # no terminal to answer the question
        assert "RG533" in capsys.readouterr().err
        assert main([*words, "--expect", "0123", "--yes", "--json"]) == 1
        assert json.loads(capsys.readouterr().out)["errors"][0]["code"] == "RG341"
        assert main([*words, "--expect", plan["id"], "--yes", "--json"]) == 0
        assert json.loads(capsys.readouterr().out)["id"] == plan["id"]
        (copy,) = (tmp_path / ".rapidgen" / "before").iterdir()
        assert "WaitTime 0.1" in copy.read_text()
        assert main([*words, "--plan"]) == 0
        assert "no change of module MainModule" in capsys.readouterr().out
