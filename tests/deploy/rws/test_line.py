"""From an empty controller to a moved robot without a pendant, on each generation."""

import pytest

from rapidgen.cli.driver_query import hello
from rapidgen.client import Robot, Trajectory
from rapidgen.client.address import Address
from rapidgen.config import load_config
from rapidgen.deploy.online.verify import PostRestartCheck
from rapidgen.wire.simple_message.spec import TriState

SPEED = 10


def test_empty_deployed_started_moved(rws, generation, tmp_path):
    wanted, model = rws.build(generation), load_config("irb120")
    group = model.groups[0]
    with rws.empty_runner(
        tmp_path, generation, clock="real", speed=SPEED, ports="auto"
    ) as controller_runner:
        controller_runner.start()
        transport = rws.connect(rws.Line(controller_runner, generation, on_thread=True))

        def at(port):
            match = controller_runner.controller.network.listeners.get(port)
            if match is None:
                raise ConnectionRefusedError
            return match[1]

        message = []
        proof = PostRestartCheck(lambda host, port: hello(host, at(port)), "127.0.0.1")
        rws.run(transport, wanted, proof=proof, message=message)
        assert message[-1] == "read back: cell has it"  # and every pointer could be set
        services = transport.services
        services.motors(True)
        services.start()
        motion, state = at(group.ports.motion), at(group.ports.state)
        address = Address("127.0.0.1", motion, state)
        with Robot(rws.model(generation), address=address, group=group.name) as robot:
            robot.wait_until(lambda s: s.status.motion_possible is TriState.TRUE, 20)
            start = robot.state.joints
            goal = [start[0] + 0.2, *start[1:]]
            path = Trajectory([0.0, 1.0], [start, goal], robot.group.names)
            robot.execute(path).result(20)
            assert robot.state.joints[0] == pytest.approx(goal[0], abs=1e-3)
        transport.close()
