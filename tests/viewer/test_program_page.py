"""Programs in the page: a breakpoint that the pointer does not pass, steps, values, call stack."""

import pytest

from tests.viewer.bench import simulator, until

pytestmark = pytest.mark.browser

PROGRAM = """MODULE work
  PERS num total := 0;
  VAR pos corner := [1, 2, 3];
  CONST jointtarget a := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget b := [[40,10,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    VAR num i := 0;
    WHILE TRUE DO
      i := i + 1;
      MoveAbsJ a, v1000, fine, tool0;
      there i;
      WaitTime 0.2;
    ENDWHILE
  ENDPROC
  PROC there(num n)
    MoveAbsJ b, v1000, fine, tool0;
    total := total + n;  ! <img src=x onerror=alert(1)>
    corner.x := n / 2;
  ENDPROC
ENDMODULE
"""
SEEN = "rapidgen.panels.program.seen"
HALTED = "(at => !at.hidden && at.textContent)(document.querySelector('.program .halt'))"


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    module = tmp_path_factory.mktemp("work") / "work.mod"
    module.write_text(PROGRAM)
    with simulator(str(module)) as (ready, _):
        yield ready["view"]


@pytest.fixture
def page(address, open_page):
    page = open_page(address)
    page.get_by_role("tab", name="Program").click()
    until(page, f"window.rapidgen && {SEEN}.text", lambda text: text and "MODULE work" in text)
    yield page
    # The next one finds the simulator running, without breakpoints.
    page.get_by_role("tab", name="Program").click()
    points = page.get_by_role("button", name="Remove the breakpoint")
    for _ in range(points.count()):
        left = page.evaluate(f"{SEEN}.breakpoints.length")
        points.first.click()
        until(page, f"{SEEN}.breakpoints.length", lambda count, left=left: count < left)
    if page.evaluate(f"{SEEN}.halted") is not None:
        page.locator("#panel-program").get_by_role("button", name="Resume").click()
    until(page, f"{SEEN}.halted", lambda at: at is None)
    page.close()


def set_breakpoint(page, line):
    page.locator(".cm-lineNumbers .cm-gutterElement", has_text=f"{line}").first.click()
    return until(page, f"{SEEN}.breakpoints", lambda lines: line in lines)


def halted(page, line):
    until(page, HALTED, lambda text: text and f"line {line}" in text)
    until(page, f"{SEEN}.program", lambda at: at == line)


def values(page, label):
    return page.get_by_label(f"Value of {label}", exact=True).input_value()


def test_the_pointer_does_not_pass_a_breakpoint(page):
    until(page, f"{SEEN}.motion", lambda line: line in (10, 16))
    set_breakpoint(page, 17)
    halted(page, 17)
    time = page.evaluate("rapidgen.state().time")
    total = page.get_by_placeholder("Expression")
    total.fill("total * 2")
    total.press("Enter")
    page.get_by_role("row", name="total * 2").wait_for()
    before = values(page, "n")
    page.wait_for_timeout(700)
    assert page.evaluate(f"{SEEN}.program") == 17
    assert page.evaluate("rapidgen.state().time") == time
    page.get_by_role("button", name="Resume").click()
    until(
        page,
        f"({HALTED}) && document.querySelector('[aria-label=\"Value of n\"]').value",
        lambda value: value and value != before,
    )
    halted(page, 17)


# Where its source and the last of its controls stand, and how far the source is scrolled, whenever
# the program's pointer has moved.
STANDS = """() => {
  const source = document.querySelector(".source"), { link, panels } = rapidgen;
  const control = document.getElementById("counts");
  const at = [], stands = [];
  link.on("pointers", () => requestAnimationFrame(() => {
    const { top } = source.getBoundingClientRect(), now = panels.program.seen.program;
    if (now === at.at(-1)) return;
    at.push(now);
    const scrolled = source.shadowRoot.querySelector(".cm-scroller").scrollTop;
    stands.push(`${top} ${scrolled} ${control.getBoundingClientRect().top}`);
  }));
  window.stood = { at, stands };
}"""


def test_lines_and_controls_stay_under_the_mouse(page):
    """The source was scrolled to where the program was, each time that this went on, and what is
    below the call stack moved with each call: a click that was held up hit something else."""
    page.evaluate(STANDS)
    seen = until(page, "stood", lambda stood: len(set(stood["at"])) >= 3 and len(stood["at"]) > 9)
    assert len(set(seen["stands"])) == 1, seen


def test_steps_stack_and_setting_a_value(page):
    set_breakpoint(page, 11)
    halted(page, 11)
    page.get_by_role("button", name="Step in").click()
    halted(page, 16)
    assert page.locator(".stack li").count() == 2
    page.get_by_label("Value of n", exact=True).fill("41.5")
    page.get_by_label("Value of n", exact=True).press("Tab")
    # A value that is shown anew takes the focus with it: keys act wherever it is.
    page.evaluate("document.activeElement.blur()")
    page.keyboard.press("F10")
    halted(page, 17)
    assert values(page, "n") == "41.5"
    page.locator(".stack button", has_text="main").click()
    until(page, f"{SEEN}.program", lambda line: line == 11)
    page.get_by_label("Value of i", exact=True).wait_for()
    page.get_by_role("button", name="Step out").click()
    halted(page, 12)
    page.get_by_placeholder("Expression").fill("total")
    page.get_by_placeholder("Expression").press("Enter")
    page.get_by_label("Value of total", exact=True).wait_for()
    assert float(values(page, "total")) >= 41.5
    page.get_by_label("Value of total", exact=True).fill("absent")
    page.get_by_label("Value of total", exact=True).press("Tab")
    page.get_by_text("not known here").wait_for()


def test_a_condition_a_hover_and_a_log_point(page):
    set_breakpoint(page, 11)
    halted(page, 11)
    before = values(page, "i")
    condition = page.get_by_placeholder("Condition")
    condition.fill("i MOD 3 = 0")
    condition.press("Enter")
    page.get_by_role("button", name="Resume").click()
    until(
        page,
        f"({HALTED}) && document.querySelector('[aria-label=\"Value of i\"]').value",
        lambda value: value and value != before and int(value) % 3 == 0,
    )
    # In a narrow editor a long line would be scrolled to its middle.
    page.set_viewport_size({"width": 1900, "height": 900})
    page.locator(".cm-content").get_by_text("total := total + n").hover(position={"x": 45, "y": 8})
    page.locator(".cm-value").wait_for()
    tell = page.get_by_placeholder("Log message")
    tell.fill("i is {i}")
    tell.press("Enter")
    page.get_by_role("button", name="Resume").click()
    until(
        page,
        "document.querySelector('[aria-label=\"Log points\"]').textContent",
        lambda text: "i is " in text,
    )


def test_what_is_typed_at_a_breakpoint_stays_while_its_passes_are_counted(page):
    set_breakpoint(page, 11)
    halted(page, 11)
    condition, passes = page.get_by_placeholder("Condition"), page.get_by_placeholder("Hit count")
    page.get_by_placeholder("Log message").fill("{i}")
    page.get_by_role("button", name="Resume").click()
    condition.press_sequentially("i < ")
    reached = "document.querySelector('.points small').textContent"
    before = page.evaluate(reached)
    until(page, reached, lambda text: text != before)
    condition.press_sequentially("0")
    assert condition.input_value() == "i < 0"
    condition.press("Tab")
    until(page, reached, lambda text: text == "hit 0 ×")
    passes.press_sequentially("often")
    passes.press("Enter")
    page.get_by_text("no number of passes").wait_for()
    assert page.evaluate(f"{SEEN}.breakpoints") == [11]
    assert condition.input_value() == "i < 0"


# What is asked of breakpoints goes out only after `go()`.
HELD = """() => {
  const { link } = rapidgen, ask = link.ask.bind(link);
  const going = new Promise((go) => { window.go = go; });
  link.ask = async (request) => {
    if (request.do === "break") await going;
    return ask(request);
  };
}"""


def test_older_news_do_not_take_back_what_is_asked_of_a_breakpoint(page):
    set_breakpoint(page, 11)
    halted(page, 11)
    condition = page.get_by_placeholder("Condition")
    page.get_by_placeholder("Log message").fill("{i}")
    page.get_by_role("button", name="Resume").click()
    reached = "document.querySelector('.points small').textContent"
    until(page, f"{SEEN}.halted", lambda at: at is None)
    page.evaluate(HELD)
    condition.fill("i < 0")
    condition.press("Tab")
    before = page.evaluate(reached)
    until(page, reached, lambda text: text != before)
    assert condition.input_value() == "i < 0"
    page.evaluate("go()")
    until(page, reached, lambda text: text == "hit 0 ×")
    assert condition.input_value() == "i < 0"


def test_lines_are_counted(page):
    page.get_by_text("Count executions of lines").click()
    page.locator(".cm-covered .cm-reached").first.wait_for()


def test_the_pendant_and_the_debugger_pause_the_same_and_time_is_stepped(page):
    page.get_by_role("tab", name="Pendant").click()
    pendant = page.locator("#panel-pendant")
    pendant.get_by_role("button", name="Pause").click()
    pendant.get_by_role("button", name="Resume").wait_for()
    halted_at = "rapidgen.panels.program.seen.halted"
    before = until(page, halted_at)
    page.get_by_label("Length of a time step").select_option(label="1 s")
    pendant.get_by_role("button", name="Time step").click()
    after = until(page, halted_at, lambda time: time and time > before)
    # A started statement is executed to its end.
    assert 1 - 1e-6 < after - before < 1.05
    page.get_by_role("tab", name="Program").click()
    until(page, HALTED, lambda text: text and "time step" in text)
    page.locator("#panel-program").get_by_role("button", name="Resume").click()
    page.get_by_role("tab", name="Pendant").click()
    pendant.get_by_role("button", name="Pause").wait_for()
    page.evaluate("() => { rapidgen.link.on('panel', now => { window.pace = now.pace }) }")
    for pace in ("0.1", "100", "1"):
        page.get_by_label("Simulation speed").select_option(pace)
        until(page, "window.pace", lambda pace_shown, wanted=float(pace): pace_shown == wanted)


ASKING = """MODULE first
  PROC main()
    VAR num key;
    TPReadFK key, "Go on?", "yes", stEmpty, stEmpty, stEmpty, stEmpty;
    deep;
  ENDPROC
ENDMODULE
"""
DEEP = f"""MODULE second
  PROC deep()
    WaitTime 0.5;
    {"! Far below." + chr(10) * 96}
    WaitTime 1000;
  ENDPROC
ENDMODULE
"""
# Sources that are asked for come only after `come()`; `at` is where the program is.
LATE = """() => {
  const { link } = rapidgen, ask = link.ask.bind(link);
  const coming = new Promise((come) => { window.come = come; });
  link.ask = async (request) => {
    if (request.do === "source") await coming;
    return ask(request);
  };
  link.on("pointers", ({ tasks }) => { window.at = tasks[0].stack.at(-1); });
}"""
IN_VIEW = """(() => {
  const source = document.querySelector(".source"), frame = source.getBoundingClientRect();
  const lines = source.shadowRoot.querySelectorAll(".cm-lineNumbers .cm-gutterElement");
  return [...lines].filter((line) => {
    const { top, bottom } = line.getBoundingClientRect();
    return top >= frame.top && bottom <= frame.bottom;
  }).map((line) => line.textContent);
})()"""


def test_where_the_program_is_by_then_is_shown_when_its_text_comes(tmp_path, open_page):
    """It was where it had been as the text was asked for."""
    for name, text in (("first", ASKING), ("second", DEEP)):
        (tmp_path / f"{name}.mod").write_text(text)
    last = DEEP[: DEEP.index("WaitTime 1000")].count("\n") + 1
    with simulator(str(tmp_path / "first.mod"), str(tmp_path / "second.mod")) as (ready, _):
        page = open_page(ready["view"])
        page.get_by_role("button", name="yes").wait_for()
        page.get_by_role("tab", name="Program").click()
        until(page, f"{SEEN}.text", lambda text: "MODULE first" in text)
        page.evaluate(LATE)
        page.get_by_role("button", name="yes", include_hidden=True).evaluate("own => own.click()")
        until(page, "window.at", lambda at: at and (at["module"], at["line"]) == ("second", last))
        page.locator("#panel-program").get_by_role("button", name="Pause").click()
        until(page, HALTED)
        page.evaluate("come()")
        until(page, f"{SEEN}.text", lambda text: "MODULE second" in text)
        until(page, IN_VIEW, lambda lines: str(last) in lines)
        page.close()
