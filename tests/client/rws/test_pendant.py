"""Pendant dialogs and message queues, as a client meets them."""

import asyncio

import pytest

from rapidgen.client.errors import RobotTimeout
from rapidgen.client.rws import AsyncController, Controller, RwsError, topics
from rapidgen.client.rws.errors import NotConfirmed


def test_a_program_is_answered_and_answers(asking):
    with Controller(asking.address, **asking.keywords) as controller:
        assert controller.dialog() is None
        with pytest.raises(RwsError) as result:
            controller.answer_dialog(1)
        assert result.value.status == 404
        with controller.subscribe(topics.dialogs()) as events:
            controller.start(cycle="once")
            event = events.next(30)
            assert (event.resource, event.value) == ("dialogs", "TPReadFK")
        waiting = controller.dialog()
        assert (waiting.kind, waiting.task) == ("TPReadFK", "T_ROB1")
        assert waiting.parameters["TPFK2"] == '"Right"'
        controller.answer_dialog(2)
        assert controller.dialog().kind == "TPReadNum"
        with pytest.raises(RwsError):
            controller.answer_dialog("many")
        assert controller.dialog().kind == "TPReadNum"
        controller.answer_dialog(7.5)
        controller.answer_dialog('say "a"')
        assert controller.symbol("T_ROB1/key") == 2
        assert controller.symbol("T_ROB1/number") == 7.5
        assert controller.symbol("T_ROB1/text") == 'say "a"'

        controller.make_queue("mine")
        assert controller.queues() == ("mine",)
        with pytest.raises(RobotTimeout):
            controller.receive_message("mine")
        controller.send_message("RMQ_T_ROB1", "num;42", sender="mine")
        assert controller.receive_message("mine", wait=30).data == 'string;"thanks"'
        assert controller.symbol("T_ROB1/got") == 42
        controller.send_message("mine", "to myself", user=5)
        with controller.subscribe(topics.queue("mine")) as events:
            controller.send_message("mine", "again")
            assert [events.next(30).value for _ in range(2)] == ["to myself", "again"]
        controller.delete_queue("mine")
        assert controller.queues() == ()


def test_a_program_is_answered_on_asyncio(asking):
    async def answered():
        async with AsyncController(asking.address, **asking.keywords) as controller:
            await controller.start(cycle="once")
            while await controller.dialog() is None:
                pass
            await controller.answer_dialog(1)
            return await controller.symbol("T_ROB1/key")

    assert asyncio.run(answered()) == 1


def test_answer_accepted_but_ineffective_is_reported(asking):
    with Controller(asking.address, **asking.keywords) as controller:
        controller.start(cycle="once")
        while controller.dialog() is None:
            pass
        operator = asking.runner.controller.operator
        asking.on_controller(lambda: setattr(operator, "answer", lambda *_: None))
        with pytest.raises(NotConfirmed):
            controller.answer_dialog(1)


def test_a_backup_is_restored(served):
    with Controller(served.address, **served.keywords) as controller:
        controller.write_file("HOME/a.txt", b"old")
        path = controller.backup("b")
        controller.write_file("HOME/a.txt", b"new")
        with pytest.raises(RwsError):
            controller.restore("BACKUP/none")
        assert controller.holder("cfg") is None
        controller.restore(path, wait=60)
        assert controller.read_file("HOME/a.txt") == b"old"


def test_restart_accepted_but_missing_is_reported(served):
    served.on_controller(lambda: setattr(served.runner, "ask_restart", lambda: None))
    with Controller(served.address, **served.keywords) as controller:
        with pytest.raises(NotConfirmed):
            controller.restart(wait=0.1)
        assert controller.holder("cfg") is None
