"""How much a client may subscribe to [RWS 1.0 and 2.0 manuals, subscription service]."""

from itertools import pairwise

import pytest
from served import Caller, code_of, make_application, make_runner

from rapidgen.servers.rws import subscriptions
from rapidgen.wire.rws.codes import CODES
from rapidgen.wire.rws.events import WantedResource, write_wanted

TOO_MANY = CODES["E_MAX_LIMIT_REACHED"]
SPEED = "/rw/rapid/execution;ctrlexecstate"
SIGNAL = "/rw/iosystem/signals/aoSpeed;state"


def ask(caller, *wanted, group=None):
    form = write_wanted([WantedResource(*one) for one in wanted])
    if group is None:
        return caller.send("POST", "/subscription", form)
    return caller.send("PUT", f"/subscription/{group}", form)


def number(reply):
    return reply.header("location").rpartition("/")[2]


@pytest.fixture(params=["one", "two"])
def caller(request):
    return request.getfixturevalue(request.param)


def test_a_session_has_two_groups_at_most_and_another_session_its_own(caller):
    first = ask(caller, (SPEED, 1))
    assert first.status == 201
    assert ask(caller, (SPEED, 1)).status == 201
    refused = ask(caller, (SPEED, 1))
    assert (refused.status, code_of(refused)) == (503, TOO_MANY)
    assert [ask(Caller(caller.application), (SPEED, 1)).status for _ in range(2)] == [201, 201]
    assert len(caller.get("/subscription")) == 2
    assert caller.send("DELETE", f"/subscription/{number(first)}").status == 200
    assert ask(caller, (SPEED, 1)).status == 201


@pytest.mark.parametrize(("limit", "priority"), [("MOST_RESOURCES", 1), ("MOST_HIGH", 2)])
def test_a_group_has_so_many_resources(caller, monkeypatch, limit, priority):
    assert (subscriptions.MOST_RESOURCES, subscriptions.MOST_HIGH) == (1000, 64)
    monkeypatch.setattr(subscriptions, limit, 3)
    refused = ask(caller, *[(SIGNAL, priority)] * 4)
    assert (refused.status, code_of(refused)) == (503, TOO_MANY)
    group = ask(caller, *[(SIGNAL, priority)] * 3)
    assert group.status == 201
    more = ask(caller, (SIGNAL, priority), group=number(group))
    assert (more.status, code_of(more)) == (503, TOO_MANY)
    assert len(caller.get(f"/subscription/{number(group)}")) == 3
    assert len(caller.get("/subscription")) == 1


def test_so_many_sessions_have_a_websocket(caller):
    groups = caller.application.groups
    made = []
    for _ in range(subscriptions.MOST_SOCKETS + 1):
        session = Caller(caller.application)
        made.append(groups.find(number(ask(session, (SPEED, 1))), session.session))
    for group in made[:-1]:
        groups.listen(str(group.number), group.session, lambda event: None)
    assert len(made) == 20
    with pytest.raises(subscriptions.RequestDenied) as denied:
        groups.listen(str(made[-1].number), made[-1].session, lambda event: None)
    assert denied.value.status == 503


RECORDED = [(2, 400, 0.05), (1, 50, 0.4), (0, 3, 5.25)]
"""Priority, events in 20 s, s between them: two persistents changed every 50 ms, RobotWare 6, real
controller (Clement-RACINET/abb-rws-client-python-rw6, result of example 8)."""
CHANGING = """MODULE MainModule
    PERS num x := 0;
    PERS num y := 0;
    PROC main()
        WHILE TRUE DO
            x := x + 1;
            y := y + 1;
            WaitTime 0.05;
        ENDWHILE
    ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(("priority", "count", "apart"), RECORDED)
def test_events_come_as_often_as_recorded(tmp_path, priority, count, apart):
    with make_runner(tmp_path, program=CHANGING) as runner:
        caller = Caller(make_application(runner))
        names = [f"/rw/rapid/symbol/data/RAPID/T_ROB1/MainModule/{n};value" for n in "xy"]
        subscribed = ask(caller, *((name, priority) for name in names))
        groups = caller.application.groups
        times = {"/x": [], "/y": []}

        def received(data):
            for end, own in times.items():
                if f"MainModule{end}" in data.decode():
                    own.append(runner.now)

        groups.listen(number(subscribed), caller.session, received)
        runner.controller.start_program()
        runner.controller.run_for(20)
        for own in times.values():
            gaps = [b - a for a, b in pairwise(own)]
            assert abs(len(own) - count) <= 2
            # The program's own statements take some µs between two waits.
            assert gaps == pytest.approx([apart] * len(gaps), abs=0.003)
