"""Trial: the ROS 2 node with a real rclpy, on each available RMW.

    python -m tools.interop.ros2 PYTHON [CASE...] [--goals N]
    (or: make interop PROGRAM=ros2 FOREIGN=PYTHON)

PYTHON has rclpy (its workspace is sourced in this shell) and rapidgen. Each case boots `rapidgen
sim` on an address of loopback and starts `python -m rapidgen.ros`, as a user does; an rclpy client
drives it. Exit code 1: a case has failed.
"""

import argparse
import os
import subprocess
import sys
from importlib.util import find_spec

RMWS = ("rmw_cyclonedds_cpp", "rmw_fastrtps_cpp")


def main(arguments: list[str]) -> int:
    """Run each RMW in a process of its own."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("python")
    parser.add_argument("cases", nargs="*")
    parser.add_argument("--goals", type=int, default=300)
    parser.add_argument("--here", action="store_true", help=argparse.SUPPRESS)
    requested = parser.parse_args(arguments)
    if find_spec("rclpy") is None:
        os.execv(requested.python, [requested.python, "-m", "tools.interop.ros2", *arguments])
    if requested.here:
        from tools.interop.ros2_cases import run_all

        return run_all(requested.cases, requested.goals)
    from ament_index_python.packages import get_packages_with_prefixes

    target = [name for name in RMWS if name in get_packages_with_prefixes()]
    failed = 0
    for name in target:
        print(f"# {os.environ.get('ROS_DISTRO', 'ROS 2')}, {name}", flush=True)
        environment = os.environ | {
            "RMW_IMPLEMENTATION": name,
            "ROS_LOCALHOST_ONLY": "1",
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        }
        command = [sys.executable, "-m", "tools.interop.ros2", *arguments, "--here"]
        failed += bool(subprocess.run(command, env=environment, check=False).returncode)
    return 1 if failed or not target else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
