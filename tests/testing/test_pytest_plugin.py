"""The plugin, as users' tests see it."""

import re
import subprocess
import sys
from importlib.metadata import entry_points

PLUGIN = "rapidgen.testing.pytest_plugin"

pytest_plugins = ["pytester"]

TEST = '''
import pytest

MODULE = """MODULE m
  PERS num n := 0;
  PROC main()
    FOR i FROM 1 TO 10 DO
      n := n + 1;
    ENDFOR
  ENDPROC
ENDMODULE
"""

def test_plain(virtual_controller, tmp_path):
    path = tmp_path / "m.mod"
    path.write_text(MODULE)
    controller = virtual_controller(path, cycle="once")
    assert controller.run(max_time=5) == "finished"
    assert controller.task("T_ROB1")["m:n"] == 10

@pytest.mark.virtual_seeds(12)
def test_race(virtual_controller, tmp_path):
    path = tmp_path / "m.mod"
    path.write_text(MODULE)
    controller = virtual_controller(
        {"T1": [path], "T2": [path]}, cycle="once", switch_at_pers=True
    )
    controller.run(max_time=5)
    assert controller.task("T1")["m:n"] == 20
'''


def test_fixture_and_seeds(pytester) -> None:
    pytester.makepyfile(TEST)
    installed = any(e.value == PLUGIN for e in entry_points(group="pytest11"))
    plugins = ("-p", "no:cacheprovider", *(() if installed else ("-p", PLUGIN)))
    result = pytester.runpytest_inprocess(*plugins, "-q")
    outcomes = result.parseoutcomes()
    assert outcomes["passed"] >= 1
    assert outcomes["failed"] >= 1
    assert outcomes["passed"] + outcomes["failed"] == 13
    seed = re.search(r"FAILED .*\[seed(\d+)\]", result.stdout.str())[1]
    again = pytester.runpytest_inprocess(*plugins, "-q", f"--virtual-seed={seed}", "-k", "race")
    assert again.parseoutcomes()["failed"] == 1
    assert "passed" not in again.parseoutcomes()


def test_the_plugin_imports_no_controller() -> None:
    code = f"import sys, {PLUGIN}; sys.exit('rapidgen.controller.controller' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
