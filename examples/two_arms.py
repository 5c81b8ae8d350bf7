"""Both arms of a YuMi, started together; when one fails, both are stopped."""

from rapidgen.client import Cell, Robot, Trajectory
from trying import virtual_controller

with virtual_controller("irb14000") as controller:
    arms = {
        name: Robot("irb14000", address=controller.address(name), group=name)
        for name in controller.motion.groups
    }
    with Cell(arms) as cell:
        paths = {}
        for name, arm in arms.items():
            arm.wait_until(lambda state: state.status.motion_possible == 1, timeout=20)
            here = arm.state.joints
            paths[name] = Trajectory.from_points([here, [j + 0.05 for j in here]], seconds=0.5)
        for name, result in cell.execute(paths).result().items():
            print(f"{name}: {result.points} points in {result.seconds:.2f} s")
