"""Socket data in words: split frames, other bytes, faulty connections."""

import pytest

from rapidgen.client import Robot
from rapidgen.machine.network.fault_injection import FaultyNetwork, NetworkRule
from rapidgen.machine.network.memory import MemoryNetwork
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.viewer.socket_log import Interpreter, SocketPiece
from rapidgen.wire.simple_message import encode, messages
from tests.viewer.bench import STATE, until

POINT = encode(messages.JointPosition(7, (0.25,) * 10))
# A page whose `listen` is delayed (`held`), and that receives messages by `push`.
HELD = """
window.held = [];
const Real = WebSocket;
window.WebSocket = class extends Real {
  constructor(...given) {
    super(...given);
    window.push = (message) => this.onmessage({ data: JSON.stringify([message]) });
  }
  send(text) {
    if (text.includes('"listen"')) held.push(JSON.parse(text)); else super.send(text);
  }
};
"""
LISTED = "document.querySelector('.data').textContent"


def piece_of(data, way="in"):
    return SocketPiece(1.0, way, "T_ROB1", "127.0.0.1:11000", "127.0.0.1:5", data)


def names(*pieces):
    interpreter = Interpreter()
    return [
        (line.name, line.fault) for piece in pieces for line in interpreter.lines(piece_of(piece))
    ]


@pytest.mark.parametrize("cut", [0, 1, 4, 15, 16, 40])
def test_a_frame_is_read_in_whatever_pieces_it_comes(cut):
    assert names(POINT[:cut], POINT[cut:]) == [("JOINT_POSITION", False)]
    assert names(POINT + POINT[:cut], POINT[cut:]) == [("JOINT_POSITION", False)] * 2


def test_socket_log_shows_message_fields():
    (line,) = Interpreter().lines(piece_of(POINT, "out"))
    assert line.way == "out"
    assert line.text.startswith("sequence 7, joints [0.25 0.25")


def test_bytes_that_are_no_frame_are_shown_and_the_next_ones_tried_anew():
    text = "<script>alert(1)</script>"
    interpreter = Interpreter()
    (raw,) = interpreter.lines(piece_of(text.encode()))
    assert (raw.name, raw.text) == ("", text)
    (good,) = interpreter.lines(piece_of(POINT))
    assert good.name == "JOINT_POSITION"
    (binary,) = interpreter.lines(piece_of(b"\xff\xff\xff\xff\x00"))
    assert binary.text == "ff ff ff ff 00"
    assert len(next(iter(interpreter.lines(piece_of(b"a" * 99_999)))).text) <= 401


def test_a_frame_that_does_not_fit_its_type_is_a_fault():
    short = (len(POINT) - 8).to_bytes(4, "little") + POINT[4:-4]
    assert names(short) == [("JOINT_POSITION", True)]
    other = POINT[:4] + (4711).to_bytes(4, "little") + POINT[8:]
    assert names(other, POINT) == [("type 4711", True), ("JOINT_POSITION", False)]


def test_a_running_connection_is_made_ill_and_well_again():
    scheduler = Scheduler()
    inner = MemoryNetwork(scheduler)
    network = FaultyNetwork(inner, scheduler, ())
    server = network.bind("127.0.0.1", 11000)
    network.listen(server)

    def passes(seconds):
        scheduler.advance(scheduler.now + round(seconds * S))

    peer = inner.connect("127.0.0.1", 11000)
    passes(0.1)
    own = network.accept(server)
    inner.send(peer, b"before")
    passes(0.1)
    assert network.receive(own, 100) == b"before"
    network.inject_fault(own, NetworkRule("delay", seconds=0.5))
    inner.send(peer, b"late")
    passes(0.1)
    network.inject_fault(own, NetworkRule("delay", seconds=0.0))
    inner.send(peer, b"well")
    passes(0.1)
    assert network.receive(own, 100) is None
    passes(0.6)
    assert network.receive(own, 100) == b"latewell"
    network.inject_fault(own, NetworkRule("silent"))
    inner.send(peer, b"lost")
    passes(1.0)
    assert network.receive(own, 100) is None


@pytest.mark.browser
def test_socket_data_is_listed_and_connection_silenced(irb120, open_page):
    page = open_page(irb120["view"])
    until(page, STATE)
    page.get_by_role("tab", name="Network").click()
    page.get_by_label("Capture").check()
    address = "127.0.0.1:{motion},{state},{control}".format(**irb120["ports"]["rob1"])
    with Robot("irb120", address=address) as robot:
        until(page, LISTED, lambda text: "STATUS" in text and "JOINT_POSITION" in text)
        page.get_by_placeholder("Filter").last.fill("status")
        until(page, LISTED, lambda text: "STATUS" in text and "JOINT_POSITION" not in text)
        state = robot.address.state
        row = page.locator(".sockets tr", has_text=f":{state}").filter(has=page.locator("select"))
        row.locator("select").select_option("silent")
        until(
            page,
            "[...document.querySelectorAll('.sockets select')].map(s => s.value)",
            lambda values: "silent" in values,
        )
        page.get_by_label("Capture").uncheck()
        row.get_by_role("button", name="Disconnect").click()
        until(
            page,
            "[...document.querySelectorAll('.sockets select')].map(s => s.value)",
            lambda values: "silent" not in values,
        )


@pytest.mark.browser
def test_a_box_shows_what_was_asked_until_that_is_answered(irb120, open_page):
    """A message sent before the request arrived does not reset the box.

    A refusal does.
    """
    page = open_page(irb120["view"], before=HELD)
    until(page, STATE)
    page.get_by_role("tab", name="Network").click()
    box = page.get_by_label("Capture")

    def push(**message):
        page.evaluate("message => push(message)", message)

    def answered(error):
        (requested,) = page.evaluate("held.splice(0)")
        push(type="reply", id=requested["id"], error=error, text="")
        return requested["request"]["on"]

    box.check()
    push(type="conversation", listening=False, lines=[])
    assert box.is_checked()
    assert answered("listening is off") is True
    assert not box.is_checked()
    box.check()
    assert answered("") is True
    push(type="conversation", listening=True, lines=[])
    assert box.is_checked()
    push(type="conversation", listening=False, lines=[])  # by another page
    assert not box.is_checked()
