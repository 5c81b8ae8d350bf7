"""A gripper: set and read signals, by hand and within a program."""

from pathlib import Path

from rapidgen.client import Program
from rapidgen.config import load_config
from trying import robot_of

config = load_config(Path(__file__).with_name("gripper.yaml"))
ABOVE, AT = [0.0, 0.1, 0.1, 0.0, 0.9, 0.0], [0.0, 0.15, 0.1, 0.0, 0.85, 0.0]

with robot_of(config) as robot:
    print("a part is there:", bool(robot.read_signal("diPart")))

    pick = Program(speed=0.8).move_joints(ABOVE).move_joints(AT, zone="fine")
    pick.set("doGrip", 1).wait(0.2).move_joints(ABOVE, zone="fine")
    robot.run(pick).result()
    print("the gripper is closed:", bool(robot.read_signal("doGrip")))

    robot.write_signal("doGrip", 0)
    print("and open:", not robot.read_signal("doGrip"))
