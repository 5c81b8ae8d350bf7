"""The page commands a simulator: pendant, dialogs, two viewers, a restart; hostile texts."""

import signal

import pytest

from tests.viewer.bench import STATE, simulator, until

pytestmark = pytest.mark.browser
HOSTILE = "<img src=x onerror=window.hacked=1><b>bold</b>"
MODULE = f"""MODULE Hostile
  PROC main()
    VAR num answer;
    TPWrite "{HOSTILE}";
    answer := UIMessageBox(\\Header:="{HOSTILE}" \\Message:="{HOSTILE}" \\Buttons:=btnYesNo);
    ErrWrite "{HOSTILE}", "{HOSTILE}";
    TPWrite "answered";
    WaitTime 100000;
  ENDPROC
ENDMODULE
"""


def text(page, selector):
    return page.locator(selector).inner_text()


def test_two_pages_see_one_emergency_stop(irb120, open_page):
    one, two = open_page(irb120["view"]), open_page(irb120["view"], color_scheme="dark")
    for page in (one, two):
        until(page, STATE)
    one.get_by_role("button", name="Emergency stop").first.click()
    for page in (one, two):
        until(page, "document.querySelector('header').innerText", lambda t: "Emergency stop" in t)
        page.get_by_role("tab", name="Log").click()
        until(page, "document.querySelector('.log').innerText", lambda t: "10013" in t)
    two.get_by_role("tab", name="Pendant").click()
    two.get_by_role("button", name="Reset emergency stop").click()
    two.get_by_role("button", name="On", exact=True).click()
    two.get_by_role("button", name="Start").click()
    one_bar = "document.querySelector('header').innerText"
    until(one, one_bar, lambda t: "Motors on" in t and "Running" in t)


def test_refusal_is_shown_and_axis_is_jogged(irb120, open_page):
    page = open_page(irb120["view"])
    until(page, STATE)
    page.get_by_role("tab", name="Jog").click()
    slider = page.get_by_role("slider").first
    slider.fill("0.5")
    until(page, "document.querySelector('.message').innerText", lambda t: "stop it first" in t)
    page.get_by_role("tab", name="Pendant").click()
    page.get_by_role("button", name="Stop", exact=True).click()
    until(page, "document.querySelector('header').innerText", lambda t: "Stopped" in t)
    page.get_by_role("tab", name="Jog").click()
    slider.fill("0.5")
    until(page, f"{STATE}.groups[0].axes[0]", lambda value: value == 0.5)
    slider.fill("0")
    until(page, f"{STATE}.groups[0].axes[0]", lambda value: value == 0)
    page.get_by_role("tab", name="Pendant").click()
    page.get_by_role("button", name="Start").click()
    until(page, "document.querySelector('header').innerText", lambda t: "Running" in t)


def test_refused_jog_is_not_executed_by_a_later_key(irb120, open_page):
    """After a refusal all controls show the robot, and a key moves it by one step."""
    page = open_page(irb120["view"])
    axes = f"{STATE}.groups[0].axes.map((value) => value * 180 / Math.PI)"
    until(page, STATE)
    page.get_by_role("tab", name="Jog").click()
    slider = page.get_by_role("slider").first
    figure = page.get_by_label("joint_1 in °")
    place = page.get_by_label("TCP x of rob1 in mm")
    refusals = "Number(document.querySelector('.message').dataset.count)"
    before = page.evaluate(axes)
    values = slider.input_value(), figure.input_value(), place.input_value()
    for count in range(1, 6):
        slider.press("ArrowRight")
        until(page, refusals, lambda shown, count=count: shown == count)
    for control, text in ((slider, "0.7"), (figure, "40"), (place, "300")):
        count = page.evaluate(refusals)
        control.fill(text)
        control.press("Enter")
        until(page, refusals, lambda shown, count=count: shown > count)
        until(
            page,
            "[...document.querySelectorAll('.axis input, .place input')].map((e) => e.value)",
            lambda displayed: (displayed[0], displayed[1], displayed[12]) == values,
        )
    assert page.evaluate(axes) == before
    page.get_by_role("tab", name="Pendant").click()
    page.get_by_role("button", name="Stop", exact=True).click()
    until(page, "document.querySelector('header').innerText", lambda t: "Stopped" in t)
    page.get_by_role("tab", name="Jog").click()
    at = before[0]
    for name, presses, control in (("1", 1, slider), ("5", 2, slider), ("0.1", 3, figure)):
        page.get_by_role("button", name=name, exact=True).click()
        for _ in range(presses):
            control.press("ArrowUp")
        at += presses * float(name)
        until(page, axes, lambda now, at=at: abs(now[0] - at) < 1e-9)
    slider.press("End")
    figure.fill("-20")
    figure.press("Enter")
    until(page, axes, lambda now: abs(now[0] + 20) < 1e-9)
    assert page.evaluate(axes)[1:] == before[1:]
    figure.fill("0")
    figure.press("Enter")
    until(page, axes, lambda now: now[0] == 0)
    page.get_by_role("tab", name="Pendant").click()
    page.get_by_role("button", name="Start").click()
    until(page, "document.querySelector('header').innerText", lambda t: "Running" in t)


def test_hostile_texts_stay_texts(tmp_path, open_page):
    program = tmp_path / "Hostile.mod"
    program.write_text(MODULE)
    with simulator(str(program)) as (ready, _):
        page = open_page(ready["view"])
        dialog = until(page, "document.querySelector('.dialogs')?.innerText")
        assert HOSTILE in dialog
        page.get_by_role("button", name="Yes").click()
        screen = until(
            page, "document.querySelector('.screen').textContent", lambda t: "answered" in t
        )
        assert HOSTILE in screen.replace("\n", "")
        page.get_by_role("tab", name="Log").click()
        log = until(page, "document.querySelector('.log').innerText", lambda t: "<img" in t)
        assert HOSTILE in log
        hacked = page.evaluate("[window.hacked, document.querySelectorAll('img, b b').length]")
        assert hacked == [None, 0]
        page.close()


ASKS = """MODULE {task}
  PROC main()
    VAR num typed;
    WaitTime {after};
    TPReadNum typed, "{task}?";
    WaitTime 1000;
  ENDPROC
ENDMODULE
"""


def test_an_answer_that_is_typed_stays_as_another_task_asks(tmp_path, open_page):
    files = []
    for task, after in (("one", 0), ("two", 4)):
        files.append(tmp_path / f"{task}.mod")
        files[-1].write_text(ASKS.format(task=task, after=after))
    with simulator(str(files[0]), "--task", f"T_BACK={files[1]}") as (ready, _):
        page = open_page(ready["view"])
        page.get_by_label("one?").fill("42")
        page.get_by_label("two?").wait_for()
        assert page.get_by_label("one?").input_value() == "42"
        page.close()


def test_a_simulator_that_comes_back_is_found_again(open_page, monkeypatch):
    token = {"RAPIDGEN_VIEW_TOKEN": "0123456789abcdef-test"}
    with simulator("irb120", environment=token) as (ready, process):
        page = open_page(ready["view"])
        until(page, STATE)
        process.send_signal(signal.SIGKILL)
        process.wait()
        until(page, "document.body.dataset.state", lambda now: now == "offline")
    port = ready["view"].split(":")[2].split("/")[0]
    open_page.faults.clear()
    with simulator("irb120", "--view-port", port, environment=token):
        until(page, "document.body.dataset.state === 'running'")
        until(page, STATE)
        open_page.faults.clear()
    other = {"RAPIDGEN_VIEW_TOKEN": "fedcba9876543210-test"}
    with simulator("irb120", "--view-port", port, environment=other):
        until(page, "document.body.dataset.state", lambda now: now == "refused")
        page.close()
        open_page.faults.clear()


def test_browser_without_webgl_is_reported(irb120, open_page):
    unmonitored = "HTMLCanvasElement.prototype.getContext = () => null"
    page = open_page(irb120["view"], before=unmonitored)
    until(page, STATE)
    assert "no WebGL" in text(page, "main")
    until(page, "document.querySelector('header').innerText", lambda t: "Motors on" in t)
    open_page.faults.clear()
