"""`python -m rapidgen.ros`: its exit code says how it ended."""

import sys
from importlib.machinery import ModuleSpec

import pytest

from rapidgen.ros.__main__ import main


@pytest.mark.parametrize("code", [0, 1])
def test_the_exit_code_is_that_of_the_node(driver_type, monkeypatch, code):
    given = []

    def run(arguments):
        given.append(arguments)
        return code

    monkeypatch.setattr(sys.modules["rclpy"], "__spec__", ModuleSpec("rclpy", None))
    monkeypatch.setattr(sys.modules["rapidgen.ros.node"], "run", run)
    monkeypatch.setattr(sys, "argv", ["driver", "--ros-args"])
    finished = main()
    assert (type(finished), finished, given) == (int, code, [["driver", "--ros-args"]])


def test_without_ros_it_says_what_to_source(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "rclpy", None)
    assert main() == 2
    message = capsys.readouterr().err
    assert "RG691" in message
    assert "setup.bash" in message
