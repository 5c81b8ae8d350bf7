"""Trial: bristolroboticslab/OpenABB-FDM with its Python client abb.py.

    python -m tools.interop.open_abb FOLDER

FOLDER is a checkout. The server runs on a robot with a track and a positioner of the name that its
program expects, and the client sends every kind of command.
"""

import importlib.util
import sys
from pathlib import Path

from tools.interop.programs import furnished, programs
from tools.interop.serving import served


def main(folder: Path) -> None:
    """Send every kind of command of the client."""
    spec = importlib.util.spec_from_file_location("abb", folder / "abb.py")
    abb = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(abb)
    program = next(programs(folder))
    system = furnished(program.read())
    print(program.name)
    track = ("TRACK_1", "STN1")
    with served(system, "irb120_track", units=track) as (controller, (port,)):
        robot = abb.Robot("127.0.0.1", port)
        robot.set_joints([10, 20, -10, 0, 40, 5])
        while robot.get_joints() != [10.0, 20.0, -10.0, 0.0, 40.0, 5.0]:
            pass
        robot.set_tool([[0, 0, 100], [1, 0, 0, 0]])
        current, turned = robot.get_cartesian()
        robot.set_speed([500, 100, 500, 100])
        robot.set_cartesian([[current[0], current[1], current[2] + 30], turned], fineMotion=True)
        up, _ = robot.get_cartesian()
        assert abs(up[2] - current[2] - 30) < 0.1, (current, up)
        poses = [[[current[0], current[1] + y, current[2]], turned] for y in (10, 20, 30)]
        assert robot.buffer_set(poses)
        robot.buffer_offset([0, 0, 5])
        robot.buffer_save(1)
        robot.buffer_load(1)
        assert robot.buffer_read_value(3)[0][2] - current[2] - 5 < 0.1
        robot.set_zone(point_motion=True)
        robot.buffer_execute()
        end, _ = robot.get_cartesian()
        assert abs(end[1] - current[1] - 30) < 0.1, (current, end)
        assert robot.check_position(poses[0])
        robot.rotate_z(15)
        robot.check_j6()
        robot.set_external_axis([25, 0])
        print("external axes", robot.get_external_axis()[:2])
        robot.set_dio(1)
        print("robot info", robot.get_robotinfo())
        robot.reset_position(0)
        robot.sock.close()
        for line in list(controller.log)[-3:]:
            print("    ", line)
    print("connected, moved, buffered and asked with its own abb.py")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
