"""A recording in the page: scrubbed there and back, program, signals and robot are as they were."""

import numpy as np
import pytest
from PIL import Image

from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.viewer.appearance import appearance
from rapidgen.viewer.recording.reader import RecordingFile
from rapidgen.viewer.recording.writer import record
from tests.viewer import mesh_files
from tests.viewer.bench import STATE, served, until
from tests.viewer.test_recording import PROGRAM

pytestmark = pytest.mark.browser
SEEN = "rapidgen.panels.recording.seen"
PROGRAM_SEEN = "rapidgen.panels.program.seen"


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    folder = tmp_path_factory.mktemp("recorded")
    text = PROGRAM.replace("SocketAccept", "!").replace("SocketReceive", "!")
    (folder / "m.mod").write_text(text.replace("SocketSend", "!"))
    (folder / "cell.yaml").write_text("signals:\n  do1: {kind: DO}\n")
    config = mesh_files.description(folder, {"link_1": ("one.stl", mesh_files.stl())})
    look = appearance(load_config(config).groups, {"rob1": config})
    with VirtualController.from_files([folder / "m.mod"], cell=folder / "cell.yaml") as controller:
        end = record(controller, folder / "run.mcap", [("T_ROB1", "passes")], look)
        controller.run_for(20.0)
        end()
    return folder / "run.mcap"


@pytest.fixture(scope="module")
def address(recorded):
    with served("view", str(recorded)) as (ready, _):
        yield ready["view"]


@pytest.fixture
def page(address, open_page):
    page = open_page(address)
    page.get_by_role("tab", name="Recording").click()
    until(page, f"window.rapidgen && {SEEN}.time !== undefined")
    yield page
    page.close()


def seek(page, time):
    moment = page.get_by_label("Time in seconds")
    moment.fill(f"{time:.3f}")
    moment.press("Enter")
    until(page, f"{SEEN}.time", lambda now: now is not None and abs(now - time) < 1e-6)


def test_robots_have_the_meshes_that_they_had(page):
    parts = "() => rapidgen.stage.robots.get('rob1').parts()"
    seen = until(page, f"({parts})()", lambda parts: parts["part_1"][0][0] == 12)
    np.testing.assert_allclose(seen["part_1"][0][1:], [[0, 0, 0], [0.2, 0.2, 0.3]], atol=1e-6)
    assert page.locator(".faults").is_hidden()


def test_scrubbed_there_and_back(page, recorded):
    with RecordingFile(recorded) as file:
        moments = {time: file.at(time) for time in (3.0, 17.2, 8.4, 3.0)}
    for time in (3.0, 17.2, 8.4, 3.0):
        moment = moments[time]
        seek(page, time)
        joints = moment.joints["rob1"].actual
        until(page, f"{STATE}.groups[0].axes", lambda axes, j=joints: np.allclose(axes, j))
        until(page, "rapidgen.stage.drawn.time === rapidgen.state().time")
        page.get_by_role("tab", name="Program").click()
        place = moment.tasks["T_ROB1"].stack[-1]
        until(page, f"{PROGRAM_SEEN}.program", lambda line, at=place: line == at.line)
        assert "PROC there" in page.evaluate(f"{PROGRAM_SEEN}.text")
        watched = moment.watch["T_ROB1", "passes"].text
        page.get_by_role("row", name="passes").get_by_text(watched, exact=True).wait_for()
        page.get_by_role("tab", name="Signals").click()
        value = int(moment.signals["do1"])
        lamp = "document.querySelector('[aria-label^=\"Set do1\"]').textContent"
        until(page, lamp, lambda text, value=value: text == str(value))
        page.get_by_role("tab", name="Recording").click()


def test_curves_share_the_cursor_and_a_click_in_one_goes_there(page):
    until(page, f"{SEEN}.charts", lambda count: count == 1)
    seek(page, 5.0)
    before = page.evaluate(f"{SEEN}.cursor")
    seek(page, 15.0)
    target = page.evaluate(f"{SEEN}.cursor")
    assert target > before + 50
    # A page that is opened now shows the same.
    page.reload()
    until(page, f"window.rapidgen && {SEEN}.charts", lambda count: count == 1)
    until(page, f"{SEEN}.cursor", lambda cursor: cursor == pytest.approx(target, abs=1))
    over = page.locator(".curves .u-over")
    width = over.bounding_box()["width"]
    over.click(position={"x": width / 2, "y": 40})
    until(page, f"{SEEN}.time", lambda time: 9 < time < 11)
    page.get_by_label("Curve").select_option("signal do1")
    until(page, "document.querySelector('.curves .u-title').textContent", lambda t: t == "do1")


def test_it_plays_and_refuses_to_command(page):
    seek(page, 1.0)
    page.get_by_label("Rate").select_option("10")
    until(page, f"{SEEN}.time", lambda time: time > 4)
    page.get_by_role("button", name="Pause").click()
    page.get_by_role("button", name="Play").wait_for()
    refused = page.evaluate("rapidgen.link.ask({do: 'act', action: 'start'}).catch(e => e.message)")
    assert "accepts no such request" in refused
    assert not page.get_by_role("button", name="Step in").is_visible()


def test_pictures_and_films_are_saved(page, tmp_path):
    with page.expect_download() as result:
        page.get_by_role("button", name="Save image").click()
    result.value.save_as(tmp_path / "robots.png")
    with Image.open(tmp_path / "robots.png") as picture:
        assert picture.size[0] > 300
        assert len(picture.convert("RGB").getcolors(1 << 20)) > 20
    page.get_by_role("button", name="Record video").click()
    page.get_by_role("button", name="Play").click()
    until(page, f"{SEEN}.time", lambda time: time > 0.5)
    # On a busy machine the browser is late with encoding what was drawn.
    until(page, f"{SEEN}.filmed", lambda size: size > 5000)
    with page.expect_download() as result:
        page.get_by_role("button", name="Stop recording").click()
    result.value.save_as(tmp_path / "robots.webm")
    data = (tmp_path / "robots.webm").read_bytes()
    assert data.startswith(b"\x1a\x45\xdf\xa3")  # EBML, which WebM is
    assert len(data) > 5000
    with page.expect_download() as result:
        page.get_by_role("button", name="Save CSV").click()
    result.value.save_as(tmp_path / "curves.csv")
    assert (tmp_path / "curves.csv").read_text().startswith('"time","joint_1"')
