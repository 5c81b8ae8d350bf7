"""`python -m rapidgen.ros --ros-args -p config:=robot.yaml`.

It runs the node without a workspace.
"""

import sys
from importlib.util import find_spec

from rapidgen.diagnostics import error
from rapidgen.diagnostics.render import render


def main() -> int:
    """Run the node; exit code 2 without a sourced ROS 2."""
    if find_spec("rclpy") is None:
        finding = error(
            "RG691",
            None,
            "no rclpy in this Python: ROS 2 is not sourced",
            "source /opt/ros/DISTRIBUTION/setup.bash, and use its Python "
            "(a venv with --system-site-packages)",
        )
        sys.stderr.write(render([finding]))
        return 2
    from rapidgen.ros.node import run

    return run(sys.argv)


if __name__ == "__main__":
    sys.exit(main())
