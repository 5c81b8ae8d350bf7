"""Public clients of RWS 1.0, unmodified, against the strict face.

rwsuis 0.2 (prinsWindy/ABB-Robot-Machine-Vision) and abb_robot_client 0.4 (rpiRobotics), as they
are published. The controller's clock runs fast, so that they keep below its limit of requests.
"""

import threading

import pytest
from abb_robot_client import rws as rpi
from rwsuis import RWS
from served import make_runner

from rapidgen.servers.rws.server import serve_rws
from rapidgen.wire.rws.bodies import Generation


@pytest.fixture
def url(tmp_path):
    with make_runner(tmp_path, clock="real", speed=200) as runner:
        runner.start()
        service = serve_rws(runner, Generation.ONE)
        yield f"http://{service.host}:{service.port}"
        service.close()


def test_rwsuis(url, capsys):
    robot = RWS.RWS(url)
    with robot.session:
        assert (robot.get_operation_mode(), robot.get_controller_state()) == ("AUTO", "motoron")
        robot.request_mastership()
        robot.set_rapid_variable("x", 5)
        assert robot.get_rapid_variable("x") == "5"
        robot.set_robtarget_translation("puck_target", [10, 20, 30])
        assert robot.get_robtarget_variables("puck_target")[0] == [10, 20, 30]
        robot.set_speed_ratio(50)
        robot.motors_off()
        robot.motors_on()
        robot.start_RAPID()
        assert robot.is_running()
        robot.stop_RAPID()
        assert not robot.is_running()
        robot.release_mastership()
    message = capsys.readouterr().out
    assert "Could not" not in message
    assert "Program pointer reset to main" in message
    assert "RAPID execution started from main" in message


def test_abb_robot_client(url):
    robot = rpi.RWS(url)
    assert robot.get_controller_state() == "motoron"
    assert robot.get_tasks()["T_ROB1"].motiontask
    robot.set_rapid_variable("x", "7")
    assert robot.get_rapid_variable("x") == "7"
    assert {v["name"] for v in robot.get_rapid_variables()} >= {"x", "puck_target"}
    folder = robot.get_ramdisk_path()
    robot.upload_file(f"{folder}/a.mod", b"MODULE a\nENDMODULE\n")
    assert robot.read_file(f"{folder}/a.mod") == b"MODULE a\nENDMODULE\n"
    assert "a.mod" in robot.list_files(folder)
    robot.delete_file(f"{folder}/a.mod")
    robot.set_digital_io("diStart", 1)
    assert robot.get_digital_io("diStart") == 1
    robot.set_speedratio(30)
    assert robot.get_speedratio() == 30
    # Joints are those of the robot in degrees.
    assert list(robot.get_jointtarget().robax) == [0.0] * 6
    assert robot.get_robtarget().trans[2] > 0
    assert robot.read_event_log()[0].title
    # It reads the type of every answer that is not 204, also of one without a body.
    assert robot.try_create_ipc_queue("mine")
    robot.send_ipc_message("mine", "num;1", "mine")
    assert [message.data for message in robot.read_ipc_message("mine")] == ["num;1"]
    received, both = [], threading.Event()

    def hear(event):
        received.append(event)
        if len(received) >= 3:
            both.set()

    kinds, priorities = rpi.SubscriptionResourceType, rpi.SubscriptionResourcePriority
    wanted = [
        rpi.SubscriptionResourceRequest(kinds.ExecutionState, priorities.Medium),
        rpi.SubscriptionResourceRequest(kinds.PersVar, priorities.High, "x"),
        rpi.SubscriptionResourceRequest(kinds.Signal, priorities.High, "diStart"),
    ]
    subscription = robot.subscribe(wanted, hear)
    robot.set_rapid_variable("x", "8")
    robot.set_digital_io("diStart", 0)
    robot.start(cycle="forever", tasks=["T_ROB1"])
    assert both.wait(60)
    subscription.close()
    robot.stop()
    assert rpi.VariableValue("T_ROB1", "8", "x") in received
    assert rpi.Signal("diStart", "0") in received
    assert any(isinstance(e, rpi.RAPIDExecutionState) for e in received)
    robot.close()
