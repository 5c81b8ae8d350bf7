"""How much a client may subscribe to [RWS 1.0 and 2.0 manuals, subscription service]."""

import pytest
from served import Caller, code_of

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
