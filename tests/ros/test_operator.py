"""The operator's services against Robot Web Services of a virtual controller."""

import asyncio
import sys
import threading
from contextlib import asynccontextmanager
from dataclasses import replace
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "servers" / "rws"))

from served import MAIN, make_runner

from rapidgen.client.errors import ConnectionFailed, NotReady, RequestRefused, RobotError
from rapidgen.client.rws.flows.request import ask
from rapidgen.diagnostics import DiagnosticError
from rapidgen.ros.operator_services import GUARDED, OperatorAccess, OperatorServices
from rapidgen.ros.parameters import DECLARED, PASSWORD, read
from rapidgen.servers.rws.server import serve_rws
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation

SPEED = 60
"""Simulated seconds in a second: the limit of requests is on the controller's clock."""


IDS = ["rws1", "rws2"]


@pytest.fixture(params=[(Generation.ONE, MAIN), (Generation.TWO, MAIN)], ids=IDS)
def served(request, tmp_path, monkeypatch):
    """A controller with its web services, and how the node reaches it."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    generation, program = request.param
    with make_runner(tmp_path, generation, program, clock="real", speed=SPEED) as runner:
        runner.start()
        service = serve_rws(runner, generation)
        address = f"rws://{service.host}:{service.port}"
        access = OperatorAccess(
            address, "Default User", service.password, service.host_key, GUARDED
        )
        yield runner, access
        service.close()


@asynccontextmanager
async def operator(access, moving=False):
    made = OperatorServices(access, lambda: moving)
    try:
        yield made
    finally:
        await made.close()


def test_program_is_started_and_stopped(served):
    _, access = served

    async def tried():
        async with operator(access) as o:
            await o.motors_on()
            await o.pp_to_main()
            await o.start_program()
            with pytest.raises(NotReady, match="stop_program first"):
                await o.pp_to_main()
            first = float(await o.read_symbol("T_ROB1/MainModule/count"))
            while float(await o.read_symbol("T_ROB1/MainModule/count")) == first:
                await asyncio.sleep(0.01)
            await o.stop_program()
            assert await o.write_symbol("T_ROB1/MainModule/x", "5") == "5"
            assert await o.set_speed_ratio(30.0) == 30.0

    asyncio.run(tried())


def test_nothing_starts_with_motors_off_or_after_an_emergency_stop(served):
    runner, access = served

    async def tried():
        async with operator(access) as o:
            await o.motors_off()
            with pytest.raises(NotReady, match="motors are not on"):
                await o.start_program()
            pressed = threading.Event()
            assert runner.post(lambda: (runner.controller.set_e_stop(True), pressed.set()))
            assert pressed.wait(60)
            with pytest.raises(NotReady, match="emergency stop is active"):
                await o.motors_on()

    asyncio.run(tried())


def test_what_may_move_the_robot_needs_permission(served):
    """Anyone who calls a service of the node would have the operator's authority."""
    _, access = served
    nothing = replace(access, allowed=frozenset())

    async def tried():
        async with operator(nothing) as o:
            for call in (
                o.motors_on(),
                o.start_program(),
                o.pp_to_main(),
                o.set_speed_ratio(10.0),
                o.write_symbol("T_ROB1/MainModule/x", "2"),
            ):
                with pytest.raises(RequestRefused, match="is not permitted here"):
                    await call
            assert await o.read_symbol("T_ROB1/MainModule/x") == "1"
            await o.stop_program()
        async with operator(access, moving=True) as o:
            with pytest.raises(NotReady, match="a goal is executed"):
                await o.write_symbol("T_ROB1/MainModule/x", "2")
        async with operator(access) as o:
            for value in (-1.0, 100.5, 50.5, float("nan")):
                with pytest.raises(ValueError, match="from 0 to 100"):
                    await o.set_speed_ratio(value)
            with pytest.raises(ValueError, match="no literal"):
                await o.write_symbol("T_ROB1/MainModule/x", "1;2")
            with pytest.raises(NotReady, match="TASK/MODULE/NAME"):
                await o.read_symbol("x")

    asyncio.run(tried())


def test_signals_of_the_controller_are_read_and_set(served):
    _, access = served

    async def tried():
        async with operator(access) as o:
            for value in (1.0, 0.0):
                assert await o.write_signal("aoSpeed", value) == value
                assert await o.read_signal("aoSpeed") == value
            with pytest.raises(RobotError, match="noSuch"):
                await o.read_signal("noSuch")
            with pytest.raises(ValueError, match="finite"):
                await o.write_signal("aoSpeed", float("nan"))
        async with operator(replace(access, allowed=frozenset())) as o:
            with pytest.raises(RequestRefused, match="is not permitted here"):
                await o.write_signal("aoSpeed", 1.0)
            assert await o.read_signal("aoSpeed") == 0.0

    asyncio.run(tried())


PROGRAM = """MODULE MainModule
    PERS tooldata gripper := [TRUE,[[0,0,100],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];
    PERS loaddata part := [1,[0,0,10],[1,0,0,0],0,0,0];
    PERS num key := 0;
    PROC main()
        TPReadFK key, "Which one?", "Left", "Right", "", "", "None";
        TPReadNum key, "How many?";
    ENDPROC
ENDMODULE
"""
PROGRAMS = [(Generation.ONE, PROGRAM), (Generation.TWO, PROGRAM)]
GRIPPER = "[TRUE,[[0,0,120],[1,0,0,0]],[3,[0,0,60],[1,0,0,0],0,0,0]]"
PART = "[2.5,[0,0,10],[1,0,0,0],0,0.01,0]"


async def choose(operator, unit="ROB_1", **chosen):
    """Choose at the pendant."""
    async with operator._connected() as controller:
        await controller.take_mastership("motion")
        await controller._run(ask(controller._core, ops.SET_MECHUNIT, {"unit": unit}, chosen))
        await controller.give_mastership("motion")


@pytest.mark.parametrize("served", PROGRAMS, indirect=True, ids=IDS)
def test_only_the_dialog_that_was_read_is_acknowledged(served):
    """An answer to another question was not given by the caller."""
    runner, access = served

    async def tried():
        async with operator(access) as o:
            assert await o.read_dialog() is None
            with pytest.raises(NotReady, match="no dialog is open"):
                await o.acknowledge("RAPID/T_ROB1", "1")
            await o.motors_on()
            await o.pp_to_main()
            await o.start_program()
            while (dialog := await o.read_dialog()) is None:
                await asyncio.sleep(0.01)
            assert (dialog.kind, dialog.task) == ("TPReadFK", "T_ROB1")
            with pytest.raises(NotReady, match="TPReadFK is open at"):
                await o.acknowledge(dialog.stack + "x", "2")
            with pytest.raises(ValueError, match="no literal"):
                await o.acknowledge(dialog.stack, "")
            async with operator(replace(access, allowed=GUARDED - {"acknowledge"})) as other:
                with pytest.raises(RequestRefused, match="acknowledge is not permitted here"):
                    await other.acknowledge(dialog.stack, "2")
            async with operator(access, moving=True) as other:
                with pytest.raises(NotReady, match="a goal is executed"):
                    await other.acknowledge(dialog.stack, "2")
            assert (await o.read_dialog()).kind == "TPReadFK"
            await o.acknowledge(dialog.stack, "2")
            assert (await o.read_dialog()).kind == "TPReadNum"
            assert await o.read_symbol("T_ROB1/MainModule/key") == "2"
            changed = threading.Event()
            assert runner.post(
                lambda: (runner.controller.set_mode("manual_reduced"), changed.set())
            )
            assert changed.wait(60)
            with pytest.raises(NotReady, match="the operating mode is MANR"):
                await o.acknowledge(dialog.stack, "2")

    asyncio.run(tried())


@pytest.mark.parametrize("served", PROGRAMS, indirect=True, ids=IDS)
def test_tool_and_load_are_read_and_set_whole(served):
    _, access = served

    async def tried():
        async with operator(access) as o:
            found = await o.read_tool("ROB_1")
            assert (found.tool, found.load) == ("tool0", "load0")
            with pytest.raises(NotReady, match="tool0 is predefined"):
                await o.write_tool("ROB_1", GRIPPER, "")
            await choose(o, tool="gripper")
            with pytest.raises(NotReady, match="load0 is predefined"):
                await o.write_tool("ROB_1", GRIPPER, PART)
            await choose(o, payload="part")
            before = await o.read_tool("ROB_1")
            assert before.tool == "T_ROB1/MainModule/gripper"
            assert "[2,[0,0,50]" in before.tool_data
            for unit in ("", "ROB_1/x", "../x"):
                with pytest.raises(NotReady, match="is no mechanical unit"):
                    await o.read_tool(unit)
            with pytest.raises(RobotError, match="ROB_9"):
                await o.read_tool("ROB_9")
            async with operator(replace(access, allowed=frozenset())) as other:
                with pytest.raises(RequestRefused, match="write_tool is not permitted here"):
                    await other.write_tool("ROB_1", GRIPPER, PART)
            async with operator(access, moving=True) as other:
                with pytest.raises(NotReady, match="a goal is executed"):
                    await other.write_tool("ROB_1", GRIPPER, PART)
            for wrong in ("[0,[0,0,10],[1,0,0,0],0,0,0]", "[1,[0,0,10],[1,0,0,0],0,-1,0]",
                          "[1,[0,0,10],[1,1,0,0],0,0,0]", "[TRUE,[0,0,1],[1,0,0,0],0,0,0]",
                          "[1,[0,0],[1,0,0,0],0,0,0]", GRIPPER, "5"):  # fmt: skip
                with pytest.raises(ValueError, match=r"no loaddata|above 0 kg"):
                    await o.write_tool("ROB_1", GRIPPER, wrong)
            for wrong in (PART, GRIPPER.replace("[1,0", "[2,0", 1), GRIPPER.replace("TRUE", "1")):
                with pytest.raises(ValueError, match="no tooldata"):
                    await o.write_tool("ROB_1", wrong, "")
            assert await o.read_tool("ROB_1") == before
            after = await o.write_tool("ROB_1", GRIPPER, PART)
            assert (after.tool_data, after.load_data) == (GRIPPER, PART)
            assert await o.read_symbol("T_ROB1/MainModule/part") == PART

    asyncio.run(tried())


def test_new_events_are_published_each_once(served):
    _, access = served

    async def tried():
        published, notes = [], []
        async with operator(access) as o:
            following = asyncio.ensure_future(o.follow_log(published.append, notes.append))
            while not any(event.code == 10010 for event in published):
                await o.motors_off()
                await o.motors_on()
                await asyncio.sleep(0.05)
            following.cancel()
            await asyncio.gather(following, return_exceptions=True)
        numbers = [event.number for event in published]
        assert numbers == sorted(set(numbers))
        assert notes == []

    asyncio.run(tried())


def test_unreachable_controller_is_noted_once():
    access = OperatorAccess("rws://127.0.0.1:9", "Default User", "", "", GUARDED)

    async def tried():
        notes, noted = [], asyncio.Event()

        def note(text):
            notes.append(text)
            noted.set()

        async with operator(access) as o:
            following = asyncio.ensure_future(o.follow_log(lambda event: None, note))
            await noted.wait()
            following.cancel()
            await asyncio.gather(following, return_exceptions=True)
            with pytest.raises(ConnectionFailed):
                await o.motors_off()
        assert len(notes) == 1
        assert "no event log" in notes[0]

    asyncio.run(tried())


def test_parameters_name_what_is_permitted_and_hide_the_password():
    values = {name: value for name, value, _ in DECLARED}
    given = {**values, "config": "irb120", "controller": "10.0.0.1", "operate": ["motors_on"]}
    parameters = read(given, {PASSWORD: "secret"})
    assert parameters.operator.allowed == {"motors_on"}
    assert parameters.operator.password == "secret"
    assert "secret" not in repr(parameters)
    assert read({**values, "config": "irb120"}, {}).operator is None
    with pytest.raises(DiagnosticError, match="operate names 'motors_onn'"):
        read({**given, "operate": ["motors_onn"]}, {})
    with pytest.raises(DiagnosticError, match="operate is set without controller"):
        read({**given, "controller": ""}, {})
