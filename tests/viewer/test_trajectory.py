"""A trajectory on the page: checked, drawn, executed by the simulator's driver."""

import numpy as np
import pytest

from tests.viewer.bench import STATE, until

pytestmark = pytest.mark.browser
NAMES = ",".join(f"joint_{i}" for i in range(1, 7))
GOAL = [0.4, 0.2, -0.1, 0.3, 0.5, -0.6]
SHOWN = "document.querySelector('#panel-trajectory').innerText"


def csv(*rows):
    return "\n".join([f"time,{NAMES}", *(",".join(map(str, row)) for row in rows)]).encode()


def drop(page, name, text):
    file = {"name": name, "mimeType": "text/csv", "buffer": text}
    page.get_by_label("Trajectory file").set_input_files(file)


def test_a_trajectory_is_checked_drawn_and_executed(irb120, open_page):
    page = open_page(irb120["view"])
    start = until(page, STATE)["groups"][0]["joints"]
    page.get_by_role("tab", name="Path").click()
    drop(page, "<b>far.csv", csv([0, *start], [1, 9, *GOAL[1:]]))
    shown = until(page, SHOWN, lambda text: "Rejected." in text)
    assert "joint_1" in shown
    assert page.get_by_role("button", name="Execute").is_disabled()
    drop(page, "good.csv", csv([0, *start], [2, *GOAL]))
    shown = until(page, SHOWN, lambda text: "Ready to execute." in text)
    assert "good.csv: 2 points in 2." in shown
    assert "mm/s" in shown
    page.get_by_role("button", name="Execute").click()
    until(page, SHOWN, lambda text: "Executed." in text)
    until(page, f"{STATE}.groups[0].joints", lambda now: np.allclose(now, GOAL, atol=1e-5))
    page.get_by_role("button", name="Remove").click()
    until(page, "document.querySelector('#panel-trajectory section:last-child').hidden")
