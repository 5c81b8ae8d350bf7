"""Message queues (DIPC) between clients, and to and from the tasks' own RMQ_<task>.

Fields as abb_robot_client sends and reads them [code], and as RobotWare 7 wants them [VC 7.21].
"""

import pytest
from served import STARTED, Caller, code_of, make_application, make_runner

from rapidgen.wire.rws import media
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.codes import CODES

MAIN = """MODULE MainModule
    VAR rmqslot sender;
    VAR rmqmessage message;
    VAR rmqheader header;
    PERS num got := 0;
    VAR num value;
    PROC main()
        RMQReadWait message;
        RMQGetMsgHeader message \\Header:=header \\SenderId:=sender;
        RMQGetMsgData message, value;
        got := value;
        RMQSendMessage sender, "thanks";
    ENDPROC
ENDMODULE
"""


@pytest.fixture(params=[Generation.ONE, Generation.TWO], ids=["one", "two"])
def caller(request, tmp_path):
    with make_runner(tmp_path, request.param, program=MAIN) as controller_runner:
        yield Caller(make_application(controller_runner, request.param))


def create(caller, name, size="4"):
    form = {"dipc-queue-name": name, "dipc-queue-size": size, "dipc-max-msg-size": "444"}
    return caller.send("POST", f"/rw/dipc{'?action=dipc-create' if caller.is_one else ''}", form)


def send(caller, target, data, source="mine"):
    form = {
        "dipc-src-queue-name": source, "dipc-cmd": "111", "dipc-userdef": "5",
        "dipc-msgtype": "1", "dipc-data": data,
    }  # fmt: skip
    action = "?action=dipc-send" if caller.is_one else ""
    return caller.send("POST", f"/rw/dipc/{target}{action}", form)


def read(caller, name):
    reply = caller.send("GET", f"/rw/dipc/{name}/{'?action=dipc-read' if caller.is_one else ''}")
    assert reply.status in (200, 204)
    result = media.read(reply.body, reply.header("content-type")).items if reply.body else ()
    return [(i.text("dipc-data"), i.text("dipc-cmd"), i.text("dipc-userdef")) for i in result]


def test_a_message_reaches_the_program_which_answers(caller):
    controller = caller.application.runner.controller
    assert create(caller, "mine").status == 201
    assert (
        caller.post(
            f"/rw/rapid/execution{'?action=start' if caller.is_one else '/start'}",
            {**STARTED, "cycle": "once"},
        )
        == 204
    )
    assert send(caller, "RMQ_T_ROB1", "num;42").status == 204
    controller.run_for(0.5)
    assert controller.tasks["T_ROB1"]["got"] == 42
    assert read(caller, "mine") == [('string;"thanks"', "0", "0")]
    assert read(caller, "mine") == []


def test_messages_between_clients_are_any_text_and_gone_when_read(caller):
    assert create(caller, "mine").status == create(caller, "other", "1").status == 201
    assert send(caller, "other", "hello <&>").status == 204
    assert code_of(send(caller, "other", "more")) == CODES["E_QUEUEFULL"]
    assert read(caller, "other") == [("hello <&>", "111", "5")]
    assert read(caller, "other") == []
    names = [item.text("queue-name") for item in caller.get("/rw/dipc")]
    assert names == ["mine", "other"]
    assert caller.send("DELETE", "/rw/dipc/other").status == 204
    assert send(caller, "other", "more").status == 404


def test_the_largest_message_and_what_each_generation_wants(caller):
    assert create(caller, "mine").status == 201
    empty = caller.send("GET", f"/rw/dipc/mine{'?action=dipc-read' if caller.is_one else ''}")
    assert empty.status == (200 if caller.is_one else 204)
    assert send(caller, "mine", "\u00e9" * 222).status == 204
    assert code_of(send(caller, "mine", "\u00e9" * 223)) == CODES["E_BUFFER_OVERFLOW"]
    action = "?action=dipc-send" if caller.is_one else ""
    assert caller.post(f"/rw/dipc/mine{action}", {"dipc-data": "x"}) == (
        204 if caller.is_one else 400  # dipc-userdef is missing [VC 7.21]
    )


@pytest.mark.parametrize("data", ["num;seven", "nothing;1", "num", "x" * 445])
def test_what_is_no_message_for_a_task_is_refused(caller, data):
    assert send(caller, "RMQ_T_ROB1", data).status == 400


def test_a_name_is_taken_once_and_ends_with_the_session(caller):
    assert create(caller, "mine").status == 201
    assert code_of(create(caller, "mine")) == CODES["E_INVALIDARG"]  # [code: abb_robot_client]
    assert create(caller, "RMQ_T_ROB1").status == 400
    caller.send("GET", "/logout")
    other = Caller(caller.application)
    assert other.get("/rw/dipc") == ()
    assert create(other, "mine").status == 201


def test_an_event_brings_the_message(caller):
    """abb_robot_client reads `dipc-data` before `dipc-userdef` out of one line [code]."""
    assert create(caller, "mine").status == 201
    form = {"resources": "1", "1": "/rw/dipc/mine", "1-p": "1"}
    assert caller.post("/subscription", form) == 201
    events = []
    caller.application.groups.listen("1", caller.session, events.append)
    assert send(caller, "mine", "hello").status == 204
    (event,) = events
    assert b'href="/rw/dipc/mine"' in event
    assert event.index(b'"dipc-data">hello<') < event.index(b'"dipc-userdef">5<')
