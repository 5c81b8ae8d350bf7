"""Meshes of the user's description in the browser: each format, and those that cannot be had."""

import urllib.error
import urllib.request

import numpy as np
import pytest

from tests.viewer import mesh_files
from tests.viewer.bench import STATE, simulator, until

pytestmark = pytest.mark.browser
SHAPES = (
    """robot => Object.fromEntries(Object.entries(rapidgen.stage.robots.get('rob1').parts()))"""
)


def test_meshes_of_each_format_are_drawn(tmp_path, open_page):
    config = mesh_files.description(
        tmp_path,
        {
            "link_1": ("one.stl", mesh_files.stl()),
            "link_2": ("two.OBJ", mesh_files.obj()),
            "link_3": ("three.dae", mesh_files.dae()),
        },
    )
    with simulator(config) as (ready, _):
        page = open_page(ready["view"])
        until(page, STATE)
        links = ("part_1", "part_2", "part_3")
        seen = until(page, SHAPES, lambda parts: all(parts[i][0][0] == 12 for i in links))
        for link in links:
            corners, lowest, highest = seen[link][0]
            assert corners == 12
            np.testing.assert_allclose([lowest, highest], [[0, 0, 0], [0.2, 0.2, 0.3]], atol=1e-6)
        assert page.locator(".faults").is_hidden()
        colours = page.evaluate("[...rapidgen.stage.robots.get('rob1').colours('part_3')]")
        assert "ff0000" in colours
        name = page.evaluate(
            "performance.getEntriesByType('resource')"
            ".map(r => r.name).find(n => n.includes('files/'))"
        )
        with pytest.raises(urllib.error.HTTPError, match="403"):
            urllib.request.urlopen(name)
        page.close()


def test_missing_meshes_are_reported_and_replaced(tmp_path, open_page):
    config = mesh_files.description(
        tmp_path,
        {
            "link_1": ("short.stl", mesh_files.stl()[:-60]),
            "link_2": ("torn.dae", mesh_files.dae()[:-300]),
            "link_3": ("<img src=x onerror=alert(1)>&.obj", None),
            "link_4": ("nothing.obj", b"nothing"),
            "link_5": ("other.dae", b"<svg/>"),
        },
    )
    with simulator(config) as (ready, _):
        page = open_page(ready["view"])
        page.locator(".faults").wait_for()
        message = until(
            page,
            "document.querySelector('.faults').textContent",
            lambda text: text.startswith("Not drawn as described: 5"),
        )
        assert "<img src=x onerror=alert(1)>&.obj" in message
        assert page.locator(".faults img").count() == 0
        parts = until(page, SHAPES, lambda parts: parts["part_2"][0][0] > 12)
        # A solid from the elbow's joint to the next one.
        assert parts["part_2"][0][2][2] == pytest.approx(0.27, abs=0.01)
        page.close()


def test_what_stands_in_the_cell_is_drawn_and_robots_stand_where_it_says(tmp_path, open_page):
    (tmp_path / "table.stl").write_bytes(mesh_files.stl())
    (tmp_path / "p.mod").write_text("MODULE p\nPROC main()\nWaitTime 1000;\nENDPROC\nENDMODULE\n")
    cell = tmp_path / "cell.yaml"
    cell.write_text(
        "robots:\n  T_ROB1: {model: irb120, base: {position: [0, 500, 250]}}\n"
        "things:\n"
        "  table: {mesh: table.stl, scale: 2, frame: {position: [600, 0, 100]}}\n"
        "  gone: {mesh: ../gone.stl}\n"
        "  other: {mesh: ../../../etc/passwd}\n"
    )
    with simulator(str(tmp_path / "p.mod"), "--cell", str(cell)) as (ready, _):
        page = open_page(ready["view"])
        until(page, "document.querySelector('.faults')?.textContent", lambda t: t and ": 2" in t)
        displayed = until(page, "rapidgen.stage.around()", len)
        assert list(displayed) == ["table"]
        np.testing.assert_allclose(displayed["table"], [[0.6, 0, 0.1], [1.0, 0.4, 0.7]], atol=1e-6)
        poses = page.evaluate("rapidgen.stage.robots.get('rob1').poses()")
        np.testing.assert_allclose(poses["base"][12:15], [0, 0.5, 0.25], atol=1e-9)
        page.close()


# Meshes that do not come before `come()`.
LATE = """
const real = window.fetch;
let come;
const coming = new Promise((came) => { come = window.come = came; });
window.fetch = async (what, ...how) => {
  if (String(what).startsWith("files/")) await coming;
  return real(what, ...how);
};
"""
WIDE = b"v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\n"


@pytest.mark.parametrize("held", [False, True])
def test_meshes_that_come_late_do_not_turn_the_picture_under_a_hand(tmp_path, open_page, held):
    config = mesh_files.description(tmp_path, {"link_1": ("wide.obj", WIDE)})
    with simulator(config) as (ready, _):
        page = open_page(ready["view"], before=LATE)
        until(page, STATE)
        before = page.evaluate("rapidgen.stage.eye()")
        if held:
            page.get_by_role("button", name="Drag TCP").click()
        page.evaluate("come()")
        parts = "rapidgen.stage.robots.get('rob1').parts()['part_1'][0][0]"
        until(page, parts, lambda corners: corners == 3)
        drawn = page.evaluate("rapidgen.stage.drawn.pictures")
        page.get_by_role("button", name="Clear trail").click()
        until(page, "rapidgen.stage.drawn.pictures", lambda pictures: pictures > drawn)
        assert (page.evaluate("rapidgen.stage.eye()") == before) == held
        # Before its simulator goes, which it would tell.
        page.close()
