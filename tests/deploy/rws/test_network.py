"""Commands over a real connection: TLS, pinned certificate, password.

No output shows the password.
"""

import socket
from contextlib import ExitStack

import pytest
import typer

from rapidgen.cli.deployment import doctor, plan
from rapidgen.deploy import Access, connect, parse_target
from rapidgen.deploy.command_run import FleetJob, apply_all, plan_all
from rapidgen.deploy.fleet import parse_targets
from rapidgen.diagnostics import DiagnosticError, render
from rapidgen.servers.rws.application import Accounts
from rapidgen.servers.rws.server import serve_rws
from rapidgen.wire.rws.bodies import Generation
from tests.refusal import refusal

WORD = "absent-sees-this"
SEVEN = ("--set", "controller.robotware=7.06", "--set", "controller.type=omnicore")


@pytest.fixture
def run(capsys):
    """Run a verb: exit code, stdout, stderr with diagnostics as the command shows them."""
    app = typer.Typer(pretty_exceptions_enable=False)
    for verb in (plan, doctor):
        app.command(verb.__name__)(verb)
    command = typer.main.get_command(app)

    def run_(*text):
        displayed = ""
        try:
            code = command.main(args=[*text], standalone_mode=False)
        except DiagnosticError as error:
            code, displayed = error.exit_code, render(error.diagnostics)
        message = capsys.readouterr()
        return code or 0, message.out, message.err + displayed

    return run_


@pytest.fixture
def served(rws, tmp_path, monkeypatch):
    """An empty controller with RWS 2.0 on a port, and the password in the environment."""
    monkeypatch.setenv("RAPIDGEN_PASSWORD", WORD)
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    with rws.empty_runner(tmp_path, Generation.TWO, clock="real", speed=20) as controller_runner:
        controller_runner.start()
        service = serve_rws(
            controller_runner, Generation.TWO, accounts=Accounts({"Default User": WORD})
        )
        yield controller_runner, service
        service.close()


def test_plan_and_doctor_on_the_command_line(served, rws, run):
    controller_runner, service = served
    url = f"rws://{service.host}:{service.port}"
    pin = ("--fingerprint", service.host_key)
    code, _, why = run("plan", "irb120", "--to", url, *SEVEN)
    assert (code, "RG502" in why, "no password was sent" in why) == (1, True, True)
    code, displayed, message = run(
        "plan", "irb120", "--to", url, "--detailed-exitcode", *SEVEN, *pin
    )
    assert (code, f"via {url}: cell (virtual, RobotWare 7." in displayed) == (2, True), message
    code, looked, _ = run("doctor", "irb120", "--to", url, *SEVEN, *pin)
    assert code == 1
    assert f"id {controller_runner.id}" in looked
    assert "T_ROB1/MainModule is loaded, and has a main, too" in looked
    assert "the delivered password is not accepted" in looked
    assert not rws.home_of(controller_runner)
    assert WORD not in why + displayed + message + looked


def test_missing_and_other_server_are_refused(served):
    _, service = served
    with socket.socket() as deaf:  # bound, so that no other process gets it, and without listen()
        deaf.bind(("127.0.0.1", 0))
        port = deaf.getsockname()[1]
        result = refusal(connect, parse_target(f"rws://127.0.0.1:{port}"), Access(timeout=2))
    assert result.diagnostics[0].code == "RG501"
    target = parse_target(f"rwss://127.0.0.1:{service.port}")
    result = refusal(connect, target, Access(fingerprint="00" * 32))
    assert result.diagnostics[0].code == "RG502"
    assert "certificate" in result.diagnostics[0].message
    folder = parse_target(f"rws://127.0.0.1:{service.port}/elsewhere")
    assert refusal(connect, folder, Access()).diagnostics[0].code == "RG509"


def test_a_fleet_is_deployed_side_by_side(rws, tmp_path, monkeypatch):
    """Two controllers at a time; the failure of one does not stop the others."""
    monkeypatch.setenv("RAPIDGEN_PASSWORD", WORD)
    wanted = rws.build(Generation.ONE)
    with ExitStack() as stack:
        runners, urls = [], []
        for name in ("a", "b"):
            (tmp_path / name).mkdir()
            controller_runner = stack.enter_context(
                rws.empty_runner(tmp_path / name, Generation.ONE, clock="real", speed=20)
            )
            controller_runner.id = name
            controller_runner.start()
            accounts = Accounts({"Default User": WORD})
            service = serve_rws(controller_runner, Generation.ONE, accounts=accounts)
            stack.callback(service.close)
            runners.append(controller_runner)
            urls.append(f"rws://{service.host}:{service.port}")
        targets = parse_targets(urls)
        job = FleetJob(
            "deploy", targets, Access(), lambda _: wanted, True, 2, None, restart=True
        )  # fmt: skip
        plans = plan_all(job)
        assert [plan.live.id for plan in plans] == ["a", "b"]
        outcomes = apply_all(job, plans, lambda _: None)
        assert [outcome.word for outcome in outcomes] == ["done", "done"], outcomes
        assert [controller_runner.restarts for controller_runner in runners] == [1, 1]
        assert all(plan.is_empty for plan in plan_all(job))
