"""`rapidgen view`: a robot is watched, and nothing of it can be moved from the page."""

import pytest

from tests.viewer.bench import STATE, served, until


def address(ready):
    return "127.0.0.1:{motion},{state},{control}".format(**ready["ports"]["rob1"])


@pytest.mark.browser
def test_a_robot_is_watched_and_not_moved(irb120, open_page):
    """The driver of the simulator stands for a robot's: only its state port is known here."""
    with served("view", "irb120", "--to", address(irb120)) as (ready, _):
        page = open_page(ready["view"])
        seen = until(page, STATE)
        assert seen["groups"][0]["tcp"] is not None
        until(page, "document.querySelector('header').innerText", lambda t: "Can move" in t)
        displayed = page.locator("[role=tab]:visible").all_inner_texts()
        assert displayed == ["Axes", "Log"]
        assert page.locator("input[type=range]:enabled:visible").count() == 0
        for request in (
            {"do": "jog", "group": "rob1", "axes": [0.1] * 6},
            {"do": "act", "action": "stop"},
            {"do": "override", "value": 0},
        ):
            requested = "request => rapidgen.link.ask(request).catch(why => why.message)"
            assert "accepts no such request" in page.evaluate(requested, request)
        copy = {"do": "copy", "group": "rob1", "form": "jointtarget"}
        text = page.evaluate("request => rapidgen.link.ask(request)", copy)
        assert text.endswith(",[9E9,9E9,9E9,9E9,9E9,9E9]]")
        page.close()
