"""Grants and remote writing in manual mode, as a client meets them, on three generations."""

import pytest

from rapidgen.client.errors import NotReady, NotSupported
from rapidgen.client.rws import Controller, RwsError
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.grants import GRANTS


def test_grants_are_uas_names(served):
    with Controller(served.address, **served.keywords) as controller:
        assert controller.grants() == frozenset(GRANTS)


def manual(served):
    served.on_controller(lambda: served.runner.controller.set_mode("manual_reduced"))


def operator(served):
    return served.runner.controller.operator


def answered(served, text):
    """Answer a question of the pendant as soon as it appears."""

    def attach():
        pendant = operator(served)
        pendant.attach()
        pendant.asked.add(
            lambda: [pendant.answer(q.number, text) for q in pendant.questions if not q.answered]
        )

    served.on_controller(attach)


def test_manual_mode_is_written_in_when_the_pendant_grants_it(served):
    manual(served)
    with Controller(served.address, **served.keywords) as controller:
        with pytest.raises(RwsError) as result:
            controller.set_symbol("T_ROB1/x", 2)
        assert result.value.symbol == "E_MODE_REJECT"
        if served.generation is Generation.EIGHT:
            with pytest.raises(NotSupported):
                controller.ask_rmmp()
            return
        answered(served, "Grant")
        controller.ask_rmmp()
        controller.set_symbol("T_ROB1/x", 2)
        controller.cancel_rmmp()
        with pytest.raises(RwsError):
            controller.set_symbol("T_ROB1/x", 3)


def test_rmmp_denied_at_pendant_is_reported(served):
    manual(served)
    if served.generation is Generation.EIGHT:
        pytest.skip("RobotWare 8 has none that works")
    answered(served, "Deny")
    with Controller(served.address, **served.keywords) as controller:
        with pytest.raises(NotReady) as result:
            controller.ask_rmmp("exec")
        assert result.value.diagnostics[0].code == "RG661"


def test_automatic_mode_needs_no_grant(served):
    with Controller(served.address, **served.keywords) as controller:
        controller.ask_rmmp()
        assert not operator(served).questions
