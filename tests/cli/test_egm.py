"""The command `egm`, with frames of a controller that a thread sends."""

import contextlib
import json
import socket
import threading
import time

import pytest

from rapidgen.cli.app import main
from rapidgen.client.egm import checks
from rapidgen.wire.egm.codec import encode_robot
from rapidgen.wire.egm.values import AxisPositions, CartesianPose, RobotMessage

PLACE = CartesianPose((364.0, 0.0, 594.0))


def frame(
    number, joints=(0.0, 0.0, 0.0, 0.0, 30.0, 0.0), release=(7, 6), state="running", period=4
):
    axes = AxisPositions(joints, pose=PLACE, time=number * period / 1000)
    message = RobotMessage(
        number, number * period, axes, axes, True, state, True, False, 12.0, None, 0, False
    )
    return encode_robot(message, release)


class Controller:
    """Sends a frame every 4 ms until it is closed."""

    def __init__(self, **options):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            probe.bind(("127.0.0.1", 0))
            self.port = probe.getsockname()[1]
        self.options, self.ended, self.answers = options, threading.Event(), 0
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def run(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as link:
            link.bind(("127.0.0.1", 0))
            link.setblocking(False)
            number = 0
            while not self.ended.wait(0.004):
                with contextlib.suppress(ConnectionRefusedError, BlockingIOError):
                    link.recv(65_536)
                    self.answers += 1
                link.sendto(frame(number, **self.options), ("127.0.0.1", self.port))
                number += 1

    def close(self):
        self.ended.set()
        self.thread.join()


@pytest.fixture
def controller():
    made = []

    def make(**options):
        made.append(Controller(**options))
        return made[-1]

    yield make
    for one in made:
        one.close()


def checked(capsys, one, *words):
    code = main(
        ["egm", "irb120", "--port", str(one.port), "--seconds", "0.4", "--wait", "60", *words]
    )
    return code, capsys.readouterr()


def test_set_up_in_order(controller, capsys, tmp_path):
    one, path = controller(), tmp_path / "frames.csv"
    code, texts = checked(capsys, one, "--record", str(path))
    assert code == 0
    lines = {line.split()[1]: line for line in texts.out.splitlines() if line[0] != " "}
    assert set(lines) == {
        "release", "rate", "answers", "feedback", "planned", "state", "utilization"
    }  # fmt: skip
    assert "RobotWare 7.06 or later" in lines["release"]
    assert "guidance active" in lines["state"]
    assert one.answers > 0
    head, *rows = path.read_text().splitlines()
    assert head.startswith("time,joint_1,")
    assert {len(row.split(",")) for row in rows} == {len(head.split(","))}


def test_faults_of_a_set_up(controller, capsys):
    one = controller(release=(6, 0), joints=(0.0, 0.0, 0.0, 0.0, 200.0, 0.0), state="stopped")
    code, texts = checked(capsys, one, "--json")
    assert code == 1
    found = {row["area"]: row for row in json.loads(texts.out)}
    assert found["release"]["verdict"] == found["feedback"]["verdict"] == "fail"
    assert "mixes rad and deg" in found["release"]["found"]
    assert "joint_5 = 3.491" in found["feedback"]["found"]
    assert found["state"]["verdict"] == "warn"


@pytest.mark.parametrize(
    ("change", "area", "verdict"),
    [
        ({"controller_time": 0.012}, "rate", "warn"),
        ({"time": 0.012}, "rate", "warn"),
        ({"answer_time": 0.003}, "answers", "warn"),
        ({"utilization": 101.0}, "utilization", "warn"),
        ({}, "rate", "ok"),
        ({}, "answers", "ok"),
    ],
)
def test_verdicts(change, area, verdict):
    """Figures that a frame of each kind has: sample rate, network, computer, limits."""
    from dataclasses import replace

    from rapidgen.axes.mapping import JointMap
    from rapidgen.client.egm import Envelope
    from rapidgen.client.egm.exchange import PartnerExchange
    from rapidgen.config import load_config

    group = load_config("irb120").groups[0]
    envelope = Envelope.of(group)
    exchange = PartnerExchange(JointMap.of(group), envelope, 0.1)
    states = []
    for number in range(40):
        exchange.answer(frame(number), number * 0.004)
        state = exchange.state(0.0002)
        if "controller_time" in change:
            state = replace(state, controller_time=number * change["controller_time"])
        elif "time" in change and number > 20:
            state = replace(state, time=state.time + change["time"])
        elif change:
            state = replace(state, **change)
        states.append(state)
    found = {check.area: check.verdict for check in checks.check_set_up(states, envelope)}
    assert found[area] == verdict


def test_no_frame(capsys, tmp_path):
    begin = time.monotonic()
    path = tmp_path / "none.csv"
    words = ["egm", "irb120", "--port", "0", "--wait", "0.2", "--record", str(path)]
    assert main(words) == 1
    assert "error[RG683]: no frame of a controller within 0.2 s" in capsys.readouterr().err
    assert not path.exists()
    assert time.monotonic() - begin < 60
