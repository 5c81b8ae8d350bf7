"""The generated irb120 folder, booted, driven by frames written by hand, over real sockets."""

import pytest

from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.generate import build, write
from tests.acceptance.driving import Ports, next_state, read, too_many, until
from tests.acceptance.frames import (
    FIVE_POINTS,
    JOINT_AT_LAST,
    JOINT_AT_ZERO,
    LAST_JOINTS,
    STATUS_IDLE,
    STATUS_MOVING,
    STOP,
    STOP_REPLY,
)


@pytest.fixture
def boot(tmp_path):
    started = []

    def start(**overrides):
        config = load_config("irb120", overrides=[f"{k}={v}" for k, v in overrides.items()])
        write(build(config), tmp_path / "irb120")
        controller = VirtualController.from_folder(
            tmp_path / "irb120", clock="real", ports="auto", speed=8
        )
        started.append(controller)
        return Ports(controller)

    yield start
    for controller in started:
        controller.close()


def positions(ports):
    return ports.controller.call(ports.controller.motion.group("rob1").positions)


def test_five_points_and_the_state_in_the_bytes_of_the_real_nodes(boot):
    ports = boot()
    with ports.connect(ports.state) as state, ports.connect(ports.motion) as motion:
        until(state, JOINT_AT_ZERO, STATUS_IDLE)
        motion.sendall(b"".join(FIVE_POINTS))
        seen = until(state, JOINT_AT_LAST, STATUS_IDLE)
        assert any(status == STATUS_MOVING for _, status in seen)
        assert positions(ports) == pytest.approx(LAST_JOINTS, abs=1e-6)
        motion.sendall(STOP)
        assert read(motion, len(STOP_REPLY)) == STOP_REPLY


def test_a_101st_point_of_100_moves_nothing(boot):
    ports = boot(**{"trajectory.capacity": 100})
    with ports.connect(ports.state) as state, ports.connect(ports.motion) as motion:
        until(state, JOINT_AT_ZERO, STATUS_IDLE)
        motion.sendall(too_many(101))
        refused = next_state(state)
        while refused[1] == STATUS_IDLE:
            refused = next_state(state)
        joint, status = refused
        assert joint == JOINT_AT_ZERO
        # error_code 1 (capacity), in_error 1, not in motion
        assert status[24:28] + status[28:32] + status[32:36] == bytes.fromhex(
            "010000000100000000000000"
        )
        for _ in range(20):
            assert next_state(state)[0] == JOINT_AT_ZERO
        assert positions(ports) == (0.0,) * 6
