"""The node with Robot Web Services, on rclpy, real or a stand-in."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "servers" / "rws"))

from served import make_runner

from rapidgen.ros.parameters import PASSWORD
from rapidgen.servers.rws.server import serve_rws
from rapidgen.wire.rws.bodies import Generation


def test_operator_services_and_event_log(driver_type, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    with make_runner(tmp_path, Generation.ONE, clock="real", speed=60) as runner:
        runner.start()
        service = serve_rws(runner, Generation.ONE)
        monkeypatch.setenv(PASSWORD, service.password)
        parameters = {
            "config": "irb120",
            "address": "127.0.0.1:1,1",
            "controller": f"rws://{service.host}:{service.port}",
            "operate": ["motors_on", "write_rapid_symbol"],
        }
        node = driver_type(parameter_overrides=parameters)
        try:
            events = node.topics["event_log"]
            assert node.services["motors_off"]().success
            assert node.services["motors_on"]().success
            refused = node.services["start_program"]()
            assert (refused.success, "not permitted" in refused.message) == (False, True)
            path = "T_ROB1/MainModule/x"
            written = node.services["write_rapid_symbol"](path=path, value="7")
            assert (written.success, written.value) == (True, "7")
            assert node.services["read_rapid_symbol"](path=path).value == "7"
            refused = node.services["set_speed_ratio"](percent=10.0)
            assert not refused.success
            assert node.services["read_dialog"]().dialog == ""
            refused = node.services["acknowledge"](dialog="x", answer="1")
            assert (refused.success, "not permitted" in refused.message) == (False, True)
            found = node.services["read_tool"](unit="ROB_1")
            assert (found.success, found.tool, found.load) == (True, "tool0", "load0")
            refused = node.services["write_tool"](unit="ROB_1", load_data=found.load_data)
            assert (refused.success, "not permitted" in refused.message) == (False, True)
            node.services["motors_off"]()
            assert events.wait(lambda event: event.level in (20, 30)).name == "controller"
        finally:
            node.destroy_node()
            service.close()
