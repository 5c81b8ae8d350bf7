"""After a rejected command the page's controls show the robot's real state."""

from pathlib import Path

import pytest

from tests.viewer.bench import STATE, simulator, until

pytestmark = pytest.mark.browser
CELL = Path(__file__).parents[2] / "tools" / "cell.yaml"
FAULTS = "Number(document.querySelector('.message').dataset.count)"


def pressed(page, group):
    """Return the texts of the pressed buttons of a choice, once it shows any."""
    buttons = f"""[...document.querySelectorAll('[role=group][aria-label="{group}"] button')]"""
    return until(page, f"{buttons}.filter((b) => b.ariaPressed === 'true').map((b) => b.innerText)")


def rejected(page):
    """Wait for the message of a rejection, and close it."""
    until(page, FAULTS, lambda count: count == 1)
    page.get_by_role("button", name="Close the message").click()


def test_rejected_commands_leave_controls_at_robot_state(open_page):
    with simulator(str(CELL)) as (ready, _):
        page = open_page(ready["view"])
        until(page, STATE)
        page.get_by_role("tab", name="Pendant").click()
        page.get_by_role("button", name="Emergency stop").first.click()
        until(page, "document.querySelector('header').innerText", lambda t: "Emergency stop" in t)
        assert pressed(page, "Motors") == ["Off"]
        page.get_by_role("button", name="On", exact=True).click()
        rejected(page)
        assert pressed(page, "Motors") == ["Off"]
        page.get_by_role("button", name="Start").click()
        rejected(page)
        page.get_by_role("tab", name="Signals").click()
        code = page.get_by_label("Set code")
        shown = code.input_value()
        for text in ("1e10", "-1", "0.5"):
            code.fill(text)
            code.press("Enter")
            rejected(page)
            assert code.input_value() == shown
        page.close()
