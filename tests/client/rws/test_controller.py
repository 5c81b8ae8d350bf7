"""`Controller` and `AsyncController` against web services of all three generations."""

import asyncio
import inspect
import logging
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from rapidgen.client import RobotTimeout
from rapidgen.client.errors import NotReady
from rapidgen.client.rws import AsyncController, Controller, RwsError
from rapidgen.client.rws.address import parse_address
from rapidgen.client.rws.core import RATE, RateLimiter
from rapidgen.client.rws.errors import LoginFailed, MastershipHeld, NotConfirmed, NotRws
from rapidgen.client.rws.known_certificates import known
from rapidgen.servers.rws.handlers import motion
from rapidgen.wire.rws.bodies import Generation

BACK = b"""MODULE Back
    PERS num k := 0;
    PROC main()
        WHILE TRUE DO
            k := k + 1;
            WaitTime 1;
        ENDWHILE
    ENDPROC
ENDMODULE
"""


def test_a_controller_is_read_and_driven(served):
    with Controller(served.address, **served.keywords) as controller:
        assert controller.generation is served.generation
        assert controller.identity().is_virtual
        assert controller.panel().state == "motoron"
        assert [task.name for task in controller.tasks()] == ["T_ROB1"]
        assert controller.symbol("T_ROB1/MainModule/puck_target")[0] == (0, 0, 600)
        controller.set_symbol("T_ROB1/x", 2.5)
        controller.set_symbol("T_ROB1/MainModule/name", 'a "b" \\ c;')
        assert controller.symbol("T_ROB1/MainModule/name") == 'a "b" \\ c;'
        assert controller.set_signal("do x;1", 1).value == 1
        assert {s.name for s in controller.signals()} >= {"do x;1", "diStart"}
        assert [s.name for s in controller.symbols("T_ROB1", kind="con")] == ["c"]
        controller.set_speed(40)
        controller.pp_to_main()
        controller.start()
        assert controller.execution().running
        assert controller.pointer("T_ROB1").module == "MainModule"
        controller.stop()
        assert not controller.execution().running
        assert controller.module_text("T_ROB1", "MainModule").startswith("MODULE MainModule")
        assert controller.log(count=1)[0].title == "Program stopped"
    assert served.on_controller(lambda: served.runner.controller.signals["do x;1"]) == 1


def test_the_log_tells_what_was_asked_for_and_no_secret(served, caplog):
    caplog.set_level(logging.DEBUG, "rapidgen.client")
    with Controller(served.address, **served.keywords) as controller:
        controller.set_symbol("T_ROB1/MainModule/name", '"secret value"')
    item = [r for r in caplog.records if r.name == "rapidgen.client"]
    assert any("logged in as" in r.getMessage() for r in item if r.levelno == logging.INFO)
    assert any("POST /rw/" in r.getMessage() for r in item if r.levelno == logging.INFO)
    assert not any(r.getMessage().split(": ")[1].startswith("GET") and r.levelno > 10 for r in item)
    assert served.service.password not in caplog.text
    assert "secret value" not in caplog.text


def test_a_task_comes_with_cfg_files_and_a_restart(served):
    digits = "6:0" if served.generation is Generation.ONE else "7:0"
    cfg = (
        f'SYS:CFG_1.0:{digits}::\n#\nCAB_TASKS:\n\n -Name "T_BACK" -Type "SEMISTATIC"\n#\n'
        'CAB_TASK_MODULES:\n\n -File "HOME:/drv/Back.mod" -ModName "Back" -Task "T_BACK"\n'
    )
    with Controller(served.address, **served.keywords) as controller:
        controller.make_folder("HOME/drv")
        assert controller.write_file("HOME/drv/Back.mod", BACK)
        assert not controller.write_file("HOME/drv/Back.mod", BACK)
        assert controller.read_file("HOME/drv/Back.mod") == BACK
        assert [f.name for f in controller.list_files("HOME/drv")] == ["Back.mod"]
        controller.write_file("TEMP/sys.cfg", cfg.encode())
        controller.cfg_load("TEMP/sys.cfg")
        with pytest.raises(RwsError) as caught:
            controller.cfg_load("TEMP/sys.cfg")
        assert caught.value.symbol == "E_CFG_NAME_EXIST"
        assert controller.cfg_instances("SYS", "CAB_TASKS")[-1].attributes["Name"] == "T_BACK"
        controller.set_symbol("T_ROB1/x", 7)
        controller.restart()
        assert [t.execution for t in controller.tasks()] == ["ready", "started"]
        assert controller.symbol("T_ROB1/x") == 7
        place = controller.backup("b")
        assert "Back.mod" in {f.name for f in controller.list_files(f"{place}/HOME/drv")}
        assert controller.delete_file(place)
        assert not controller.delete_file(place)


def test_load_module_with_errors_lists_them(served):
    with Controller(served.address, **served.keywords) as controller:
        controller.write_file(
            "HOME/a.mod", b"MODULE A\n    PROC p()\n        y := ;\n    ENDPROC\n"
        )
        controller.load_module("T_ROB1", "HOME/a.mod")
        assert controller.build_errors("T_ROB1")[0].row == 3
        with pytest.raises(RwsError) as caught:
            controller.pp_to_main()
        assert caught.value.symbol == "E_RAPID_SYNTAX_ERROR"
        controller.write_file("HOME/a.mod", b"MODULE A\n    PERS num y := 3;\nENDMODULE\n")
        controller.load_module("T_ROB1", "HOME/a.mod", replace=True)
        controller.set_symbol("T_ROB1/A/y", 4)
        saved = controller.save_module("T_ROB1", "A", "saved")
        assert b"PERS num y := 4;" in controller.read_file(saved)
        assert [m.name for m in controller.modules("T_ROB1")] == ["MainModule", "A"]
        controller.unload_module("T_ROB1", "A")
        controller.pp_to_main()


def test_the_asynchronous_client_does_the_same(served):
    async def run():
        async with AsyncController(served.address, **served.keywords) as controller:
            assert (await controller.panel()).mode == "AUTO"
            await controller.set_symbol("T_ROB1/x", 3)
            async with controller.mastership():
                holder = await controller.holder()
                assert holder.mine
            both = await asyncio.gather(controller.symbol("T_ROB1/x"), controller.execution())
            assert both[0] == 3
            await controller.start()
            await controller.stop()

    asyncio.run(run())


def test_both_clients_have_the_same_methods():
    def public(kind):
        return {n: inspect.signature(m) for n, m in inspect.getmembers(kind) if n[0] != "_"
                and callable(m)}  # fmt: skip

    one, other = public(Controller), public(AsyncController)
    assert set(one) == set(other)
    assert len(one) > 40
    assert all(one[name].parameters.keys() == other[name].parameters.keys() for name in one)


# -- requests --------------------------------------------------------------------------------------


def test_one_value_is_one_request_on_a_warm_session(served):
    with Controller(served.address, **served.keywords) as controller:
        controller.panel()
        for ask in (
            lambda: controller.symbol("T_ROB1/x"),
            lambda: controller.signal("do x;1"),
            controller.execution,
            controller.tasks,
        ):
            before = controller.requests
            ask()
            assert controller.requests == before + 1


def test_the_ceiling_holds():
    pace, now, sent = RateLimiter(), 0.0, []
    for _ in range(100):
        now += pace.reserve(now)
        sent.append(now)
    assert all(later - first >= 1.0 for first, later in zip(sent, sent[RATE:], strict=False))


def test_threads_share_a_client(served):
    with Controller(served.address, **served.keywords) as controller, ThreadPoolExecutor(8) as pool:
        assert len(set(pool.map(lambda _: controller.symbol("T_ROB1/x"), range(16)))) == 1


# -- who holds what --------------------------------------------------------------------------------


def test_mastership_is_given_back_and_never_taken_by_force(served):
    first = Controller(served.address, **served.keywords)
    second = Controller(served.address, **{**served.keywords, "user": "Admin"})
    with first, second:
        if served.generation is Generation.EIGHT:
            return  # both are this machine's control station: that is its own test below
        with first.mastership():
            with pytest.raises(MastershipHeld) as caught:
                second.take_mastership()
            assert "Default User" in str(caught.value)
            with pytest.raises(NotReady):
                first.start()
        with second.mastership():
            assert second.holder().mine
        with pytest.raises(KeyError), first.mastership():
            raise KeyError
        assert first.holder() is None
        with first.mastership():
            done = threading.Timer(0.1, first.give_mastership)
            done.start()
            second.take_mastership(wait=30)
            assert second.holder().user == "Admin"


def test_abandoned_write_access_is_released(tmp_path, served):
    if served.generation is not Generation.EIGHT:
        return
    killed = Controller(served.address, **served.keywords)
    killed.take_mastership()
    killed._runner.close()
    with Controller(served.address, **served.keywords) as controller:
        assert controller.holder().mine
        with controller.mastership():
            controller.pp_to_main()
        assert controller.holder() is None


# -- lies ------------------------------------------------------------------------------------------


def test_a_start_that_was_agreed_to_and_is_none_is_found_out(served):
    with Controller(served.address, **served.keywords) as controller:
        controller.motors(False)
        # RWS 1.0 rejects it; a success of RWS 2.0 is an accepted request [real 7.21, VC 6.16].
        one = served.generation is Generation.ONE
        with pytest.raises(RwsError if one else NotConfirmed) as caught:
            controller.start()
        assert ("E_EXEC_STATE" in str(caught.value)) == one


def test_refusal_has_symbol_and_help(served):
    with Controller(served.address, **served.keywords) as controller:
        with pytest.raises(RwsError) as caught:
            controller.set_signal("doDefault", 1)
        assert caught.value.symbol == "E_REJECT"
        assert "access level" in caught.value.diagnostics[0].help
        with pytest.raises(RwsError):
            controller.symbol("T_ROB1/none")
        with pytest.raises(RwsError):
            controller.tasks() and controller.modules("T_NONE")


def test_mastership_within_mastership_lasts_until_the_outer_end(served):
    with Controller(served.address, **served.keywords) as controller:
        with controller.mastership("cfg"):
            with controller.mastership("cfg"):
                pass
            assert controller.holder("cfg").mine
        assert controller.holder("cfg") is None


def test_a_task_that_is_left_out_is_not_started(served):
    with Controller(served.address, **served.keywords) as controller:
        controller.select_task("T_ROB1", False)
        assert not controller.tasks()[0].active
        with pytest.raises(NotConfirmed):
            controller.start()  # agreed to, and nothing runs
        controller.select_task("T_ROB1", True)
        controller.start()
        with pytest.raises(RwsError) as result:
            controller.select_task("T_ROB1", False)
        assert result.value.symbol == "E_EXEC_STATE"


def test_where_the_robot_stands(served):
    with Controller(served.address, **served.keywords) as controller:
        (unit,) = controller.mechanical_units()
        joints, place = controller.joint_target(unit), controller.rob_target(unit)
        assert (len(joints.robax), joints.extax) == (6, (9e9,) * 6)
        assert place.trans[2] > 0
        assert sum(q * q for q in place.rot) == pytest.approx(1, abs=1e-4)
        with pytest.raises(RwsError):
            controller.joint_target("ROB_9")


@pytest.mark.parametrize("spelled", ["eax{}", "eax_{}"])
def test_external_axes_of_a_target_have_two_spellings(served, monkeypatch, spelled):
    """rpi's client reads eaxa, RWS4YuMi eax_a: both ran on real controllers."""
    axes = {spelled.format(letter): str(i) for i, letter in enumerate("abcdef")}
    complete = motion._rob_target
    monkeypatch.setattr(
        motion,
        "_rob_target",
        lambda value: {k: v for k, v in complete(value).items() if k[:3] != "eax"} | axes,
    )
    with Controller(served.address, **served.keywords) as controller:
        assert controller.rob_target().extax == (0, 1, 2, 3, 4, 5)


def test_restart_too_slow_is_reported(served):
    with Controller(served.address, **served.keywords) as controller:
        controller.panel()
        with pytest.raises(RobotTimeout):
            controller.wait_ready(wait=0)


@pytest.mark.parametrize(
    ("text", "address"),
    [("[::1]:80", "rws://[::1]:80"), ("rwss://[fe80::1%25eth0]", "rwss://[fe80::1%25eth0]")],
)
def test_an_address_may_be_of_ipv6(text, address):
    assert str(parse_address(text)) == address


# -- logins ----------------------------------------------------------------------------------------


def test_without_a_password_nothing_is_sent():
    with pytest.raises(LoginFailed) as caught:
        Controller("rws://192.0.2.1").connect()  # an address without a server
    assert caught.value.diagnostics[0].code == "RG651"


def test_a_wrong_password_is_tried_once(served):
    with pytest.raises(LoginFailed) as caught:
        Controller(served.address, **{**served.keywords, "password": "SECRET"}).connect()
    assert "SECRET" not in str(caught.value)
    assert served.on_controller(lambda: served.runner.now) > 0


def test_a_certificate_is_agreed_to_before_a_password_is_sent(served_two, tmp_path):
    address = served_two.address
    requests = []
    with pytest.raises(LoginFailed) as caught:
        Controller(address, password="robotics", pin_file=tmp_path / "p").connect()
    assert caught.value.diagnostics[0].code == "RG652"
    seen = []

    def agree(where, fingerprint):
        seen.append(fingerprint)
        return True

    with Controller(address, password="robotics", confirm=agree, pin_file=tmp_path / "p") as c:
        requests.append(c.panel())
    assert seen[0].replace(":", "").lower() == served_two.service.host_key
    where = address.removeprefix("rws://")
    assert known(tmp_path / "p", where) == served_two.service.host_key
    # A known certificate: no question.
    Controller(address, password="robotics", pin_file=tmp_path / "p").connect().close()
    (tmp_path / "p").write_text(f"{where} {'0' * 64}\n")
    with pytest.raises(LoginFailed) as caught:
        Controller(address, password="robotics", confirm=agree, pin_file=tmp_path / "p").connect()
    notes = caught.value.diagnostics[0].notes
    assert "00:00" in notes[0]
    assert seen[0] in notes[1]
    assert len(seen) == 1


def test_a_controller_with_a_known_certificate_is_not_talked_to_in_the_clear(tmp_path, served):
    if served.generation is not Generation.ONE:
        return
    where = served.address.removeprefix("rws://")
    (tmp_path / "p").write_text(f"{where} {'0' * 64}\n")
    with pytest.raises(LoginFailed):
        Controller(served.address, password="robotics", pin_file=tmp_path / "p").connect()
    with pytest.raises(LoginFailed):
        Controller(f"rwss://{where}", password="robotics", pin_file=tmp_path / "q").connect()


def test_who_is_no_controller_gets_no_password(tmp_path):
    import http.server

    requested = []

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            requested.append(dict(self.headers))
            self.send_response(401)
            self.send_header("WWW-Authenticate", self.server.challenge)
            self.send_header("Content-Length", "0")
            self.end_headers()

        def log_message(self, *_):
            pass

    with http.server.HTTPServer(("127.0.0.1", 0), Handler) as server:
        thread = threading.Thread(target=server.serve_forever, daemon=True)
        thread.start()
        for server.challenge, error in (("Basic realm=x", LoginFailed), ("Bearer", NotRws)):
            with pytest.raises(error):
                Controller(
                    f"rws://127.0.0.1:{server.server_port}",
                    password="SECRET",
                    pin_file=tmp_path / "p",
                ).connect()
        server.shutdown()
    assert requested
    assert not any("Authorization" in headers for headers in requested)


def test_proxies_of_the_environment_are_ignored(served, monkeypatch):
    for name in ("HTTP_PROXY", "HTTPS_PROXY", "ALL_PROXY", "http_proxy", "https_proxy"):
        monkeypatch.setenv(name, "http://127.0.0.1:1")
    with Controller(served.address, **served.keywords) as controller:
        assert controller.panel().mode == "AUTO"
