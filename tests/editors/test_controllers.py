"""The view of controllers in VS Code, before `rapidgen sim` with Robot Web Services."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.editors.test_vscode import PICTURES, wait, workbench
from tests.viewer.bench import served

MODULE = """MODULE count
  PERS num total := 0;
  PROC main()
    total := total + 1;
    WaitTime 0.5;
  ENDPROC
ENDMODULE
"""

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def simulator(tmp_path_factory):
    module = tmp_path_factory.mktemp("controller") / "count.mod"
    module.write_text(MODULE)
    words = [str(module), "--robot", "irb120", "--robotware", "6.15", "--rws", "1"]
    with served("sim", *words, "--ports", "auto") as (ready, _):
        yield ready["rws"]


@pytest.fixture
def opened(simulator, tmp_path):
    """VS Code with the simulator in its setting, without a password."""
    workspace = tmp_path / "workspace"
    workspace.mkdir()
    (workspace / "count.mod").write_text(MODULE.replace("0.5", "0.25"))
    user = tmp_path / "data" / "User"
    user.mkdir(parents=True)
    (user / "settings.json").write_text(
        json.dumps({"rapidgen.controllers": [simulator], "window.dialogStyle": "custom"})
    )
    with workbench(tmp_path, workspace, XDG_STATE_HOME=str(tmp_path / "state")) as (page, log):
        yield page, log, workspace


def picture(page, name):
    if PICTURES:
        page.screenshot(path=str(Path(PICTURES) / f"{name}.png"))


def rows(page):
    return page.locator(".pane-body .monaco-list-row").all_inner_texts()


def row(page, text):
    return page.locator(".pane-body .monaco-list-row", has_text=text).first


def test_connects_on_request_and_loads_the_confirmed_plan(opened, simulator):
    page, log, workspace = opened
    page.locator(".activitybar .action-label[aria-label='RAPID']").click(timeout=60_000)
    row(page, simulator).wait_for(timeout=60_000)
    assert len(rows(page)) == 1  # nothing is asked before it is expanded
    row(page, simulator).click()
    # Without a password: the reason, the fix, and no dialog in a loop.
    row(page, "RG512").wait_for(timeout=30_000)
    picture(page, "no-password")
    row(page, "Enter the password").click()
    page.locator(".quick-input-widget input[type=password]").fill("robotics")
    page.keyboard.press("Enter")
    row(page, "T_ROB1").wait_for(timeout=30_000)
    assert re.search(r"started, count/main:[45]", row(page, "T_ROB1").inner_text())
    row(page, "T_ROB1").click()
    row(page, "count").wait_for()
    module = page.locator(".pane-body .monaco-list-row[aria-level='3'][aria-label^='count']")
    module.wait_for()
    module.click()
    total = row(page, "total")
    total.wait_for(timeout=30_000)
    first = total.inner_text()
    wait(lambda: total.inner_text() != first, log)
    picture(page, "values")

    module.hover()
    module.get_by_role("button", name="Open the module read only").click()
    page.locator(".view-line", has_text="WaitTime 0.5").wait_for(timeout=30_000)
    picture(page, "module")

    # While the program runs the plan is shown and cannot be applied.
    module.hover()
    module.get_by_role("button", name="Upload the module of the workspace").click()
    page.get_by_text("cannot be loaded now").first.wait_for(timeout=30_000)
    environment = {**os.environ, "RAPIDGEN_PASSWORD": "robotics"}
    stop = [sys.executable, "-m", "rapidgen", "stop-program", simulator]
    subprocess.run(stop, env=environment, check=True, capture_output=True, timeout=60)
    page.locator(".monaco-list-row", has_text="stopped, count/main").first.wait_for(timeout=30_000)
    module.hover()
    module.get_by_role("button", name="Upload the module of the workspace").click()
    page.locator(".monaco-dialog-box").wait_for(timeout=30_000)
    picture(page, "plan")
    assert "+    WaitTime 0.25;" in page.locator(".monaco-dialog-box").inner_text()
    page.get_by_role("button", name="Replace", exact=True).click()
    page.get_by_text("count is loaded into T_ROB1").first.wait_for(timeout=30_000)
    show = [sys.executable, "-m", "rapidgen", "symbols", simulator, "T_ROB1/count", "--source"]
    done = subprocess.run(
        show, env=environment, check=True, capture_output=True, text=True, timeout=60
    )
    assert "WaitTime 0.25;" in done.stdout
    assert list((workspace / ".rapidgen" / "before").iterdir())

    module.hover()
    module.get_by_role("button", name="Compare the module with the workspace").click()
    page.locator(".monaco-diff-editor .view-line", has_text="WaitTime 0.25").first.wait_for(
        timeout=30_000
    )
    # The text that was opened before the upload is not the controller's any more.
    assert page.locator(".view-line", has_text="WaitTime 0.5").count() == 0
    picture(page, "compare")
