"""A RAPID procedure of your own, called from Python: arguments, results, errors."""

from pathlib import Path

from rapidgen.client import RoutineFailed
from rapidgen.config import load_config
from trying import robot_of

HERE = Path(__file__).parent
config = load_config(HERE / "own_routine.yaml")

with robot_of(config, HERE / "measuring.mod") as robot:
    (height,) = robot.call("measure", 2, 0)
    print(f"height {height:g} mm")
    try:
        robot.call("measure", 0, 0)
    except RoutineFailed as error:
        print(error)
