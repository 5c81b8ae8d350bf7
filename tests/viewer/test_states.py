"""States of the page: one sentence each, no message over a control, panels of one width, axe-core.

`walk` goes through the states of a simulator and yields the name of each. The short test measures
boxes; the long one also runs axe-core in both themes and at three sizes, and looks at a robot, a
recording and an empty simulator.
"""

import signal
from pathlib import Path

import pytest

from rapidgen.viewer.server import ASSETS
from tests.viewer.bench import STATE, served, simulator, until
from tests.viewer.conftest import absent

pytestmark = pytest.mark.browser
AXE = ASSETS.parent / "page" / "node_modules" / "axe-core" / "axe.min.js"
TABS = ("Pendant", "Program", "Jog", "Signals", "Log", "Path", "Collisions", "Network")
NAME = "document.body.dataset.state"
COUNT = "Number(document.querySelector('.message').dataset.count)"
QUESTION = """MODULE p
  PROC main()
    VAR num answer;
    TPReadNum answer, "How many?";
    Stop;
  ENDPROC
ENDMODULE
"""

# Controls that something else covers, and messages outside of their bar.
COVERED = """() => {
  const inside = (a, b) =>
    b.left < a.right && a.left < b.right && b.top < a.bottom && a.top < b.bottom;
  const found = [];
  for (const element of document.querySelectorAll('button, input, select, summary, [role=tab]')) {
    if (!element.checkVisibility({ visibilityProperty: true })) continue;
    const box = element.getBoundingClientRect();
    const x = box.left + box.width / 2, y = box.top + box.height / 2;
    const view = element.closest('.view, main, header, .status')?.getBoundingClientRect();
    // What is scrolled out of its panel cannot be covered.
    if (!view || y < view.top || y > view.bottom) continue;
    if (y >= innerHeight - 1 || x >= innerWidth) continue;
    const top = document.elementFromPoint(x, y);
    const own = top === element || element.contains(top) || top?.contains(element);
    if (!own && !element.closest('.view')?.querySelector('.tools')?.contains(top))
      found.push([element.ariaLabel || element.textContent, top?.className]);
  }
  const message = document.querySelector('.message').getBoundingClientRect();
  for (const part of document.querySelectorAll('header, .whole')) {
    if (inside(message, part.getBoundingClientRect())) found.push(['message', part.className]);
  }
  return found;
}"""
BOXES = """() => ['aside', '.whole'].map(name => {
  const { left, top, width, height } = document.querySelector(name).getBoundingClientRect();
  return [left, top, width, height].map(Math.round);
})"""


def named(page, name):
    until(page, NAME, lambda now: now == name)
    return name


def walk(page, process):
    """Go through the states of a simulator with its driver; the last one is without it."""
    yield named(page, "running")
    page.get_by_role("tab", name="Jog", exact=True).click()
    for count in (1, 2, 3):
        page.get_by_label("joint_1 +").click()
        until(page, COUNT, lambda now, count=count: now == count)
    # The same rejection is one message.
    assert page.locator(".message").count() == 1
    assert "stop it first" in page.locator(".message").inner_text()
    yield "rejected"
    page.get_by_role("button", name="Close the message").click()
    page.get_by_role("tab", name="Pendant").click()
    page.get_by_role("button", name="Pause").first.click()
    yield named(page, "paused")
    page.get_by_role("button", name="Resume").first.click()
    page.get_by_role("button", name="Stop", exact=True).click()
    yield named(page, "stopped")
    page.get_by_role("button", name="Off", exact=True).click()
    yield named(page, "motors-off")
    page.get_by_role("button", name="Emergency stop", exact=True).click()
    yield named(page, "e-stop")
    assert page.get_by_role("button", name="Reset emergency stop").is_enabled()
    page.get_by_role("button", name="Reset emergency stop").click()
    named(page, "motors-off")
    process.send_signal(signal.SIGKILL)
    process.wait()
    yield named(page, "offline")


def test_no_state_covers_controls_or_moves_panels(open_page):
    with simulator("irb120") as (ready, process):
        page = open_page(ready["view"])
        until(page, STATE)
        box = page.evaluate(BOXES)
        for tab in TABS:
            page.get_by_role("tab", name=tab, exact=True).click()
            assert page.evaluate(BOXES) == box, tab
        page.get_by_role("tab", name="Pendant").click()
        names = []
        for name in walk(page, process):
            names.append(name)
            assert page.evaluate(COVERED) == [], name
            assert page.evaluate(BOXES) == box, name
        assert names[-1] == "offline"
        # Without the simulator no control works, and one sentence says why.
        for tab in TABS:
            page.get_by_role("tab", name=tab, exact=True).click()
            enabled = page.locator(".view:visible :is(button, input, select):enabled")
            assert enabled.count() == (2 if tab == "Log" else 0), tab
        assert page.locator(".message").get_attribute("data-kind") == "none"
        page.close()
    open_page.faults.clear()


@pytest.mark.long
def test_jog_in_frames_moves_along_their_axes(irb120, open_page):
    page = open_page(irb120["view"])
    until(page, STATE)
    page.get_by_role("tab", name="Jog", exact=True).click()
    page.get_by_role("button", name="Stop program").click()
    until(page, f"{STATE}.groups[0].blocked === ''")
    # Away from the singular zero position.
    page.get_by_label("joint_5 in °").fill("30")
    page.get_by_label("joint_5 in °").press("Enter")
    until(page, f"{STATE}.groups[0].axes[4]", lambda angle: abs(angle - 0.5235987) < 1e-6)
    tcp = f"{STATE}.groups[0].tcp"
    page.get_by_role("button", name="10", exact=True).click()
    before = page.evaluate(tcp)["position"]
    page.get_by_label("z + of rob1", exact=True).click()
    until(page, f"{tcp}.position[2]", lambda z: abs(z - before[2] - 0.01) < 1e-6)
    # z of the tool is 30 degrees below x of the base.
    page.get_by_role("button", name="Tool", exact=True).click()
    page.get_by_label("z − of rob1", exact=True).click()
    until(page, f"{tcp}.position[0]", lambda x: abs(x - before[0] + 0.01 * 0.8660254) < 1e-6)
    assert page.evaluate(f"{tcp}.position[2]") == pytest.approx(before[2] + 0.01 + 0.005, abs=1e-6)
    page.get_by_role("button", name="Base", exact=True).click()
    field = page.get_by_label("TCP rotation about z of rob1 in °")
    turned = page.evaluate(tcp)["orientation"]
    angle = float(field.input_value()) - 5
    field.fill(str(angle))
    field.press("Enter")
    # The scalar product of two unit quaternions is the cosine of half the angle between them.
    until(
        page,
        f"{tcp}.orientation",
        lambda q: abs(abs(sum(a * b for a, b in zip(q, turned, strict=True))) - 0.99904822) < 1e-6,
    )
    assert float(field.input_value()) == pytest.approx(angle, abs=0.01)
    page.get_by_role("tab", name="Pendant").click()
    page.get_by_role("button", name="Start").click()
    named(page, "running")


def faults_of_axe(page):
    """Return serious and critical violations of axe-core: rule, and places."""
    page.evaluate(AXE.read_text(encoding="utf-8"))
    result = page.evaluate("axe.run(document, { resultTypes: ['violations'] })")
    return [
        (found["id"], [node["html"][:120] for node in found["nodes"]])
        for found in result["violations"]
        if found["impact"] in ("serious", "critical")
    ]


def check_all(page, name):
    """Check boxes at three sizes, and axe-core in two themes with each tab."""
    for width, height in ((390, 844), (1280, 720), (2560, 1440)):
        page.set_viewport_size({"width": width, "height": height})
        assert page.evaluate(COVERED) == [], (name, width)
        assert page.evaluate("document.documentElement.scrollWidth") <= width, (name, width)
    page.set_viewport_size({"width": 1280, "height": 720})
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
        assert faults_of_axe(page) == [], (name, scheme)


@pytest.mark.long
def test_axe_finds_no_serious_fault_in_any_state(open_page, tmp_path):
    if not AXE.is_file():
        absent("axe-core: `make page` installs it")
    with simulator("irb120") as (ready, process):
        page = open_page(ready["view"])
        until(page, STATE)
        for tab in TABS:
            page.get_by_role("tab", name=tab, exact=True).click()
            check_all(page, tab)
        page.keyboard.press("?")
        page.get_by_role("dialog").wait_for()
        assert faults_of_axe(page) == []
        page.keyboard.press("Escape")
        page.get_by_role("tab", name="Pendant").click()
        ports = "127.0.0.1:{motion},{state},{control}".format(**ready["ports"]["rob1"])
        with served("view", "irb120", "--to", ports) as (robot, _):
            other = open_page(robot["view"])
            until(other, STATE)
            check_all(other, named(other, "robot"))
            other.close()
        for name in walk(page, process):
            check_all(page, name)
        page.close()
    program = Path(tmp_path / "p.mod")
    program.write_text(QUESTION)
    record = tmp_path / "run.mcap"
    with simulator(str(program), "--record", str(record)) as (ready, _):
        page = open_page(ready["view"])
        check_all(page, named(page, "asking"))
        page.close()
    with served("view", str(record)) as (ready, _):
        page = open_page(ready["view"])
        until(page, STATE)
        check_all(page, named(page, "recording"))
        page.close()
    open_page.faults.clear()
