"""Lines and circles of the tool: a program that the controller executes by itself."""

from rapidgen.client import Program
from trying import robot_of

BENT = [0.0, 0.1, 0.1, 0.0, 0.9, 0.0]

with robot_of("irb120") as robot:
    robot.move_to(BENT, speed=0.8)
    pose = robot.pose

    program = Program(speed=0.3, zone="z10")
    program.move_linear(pose.moved(y=0.04))
    program.move_circular(pose.moved(y=0.06, z=0.02), pose.moved(y=0.04, z=0.04))
    program.move_linear(pose, zone="fine")

    for note in robot.check_program(program):
        print(note.message)
    result = robot.run(program).result()
    print(f"{result.points} instructions in {result.seconds:.2f} s")
