"""Accessibility of the page: keyboard, and contrast of all texts.

Light and dark theme [WCAG 2.2: 1.4.3, 2.1.1].
"""

import pytest

from tests.viewer.bench import DOCS, STATE, until

pytestmark = pytest.mark.browser
TABS = ("Pendant", "Program", "Jog", "Signals", "Log", "Path", "Collisions", "Network")

# Of each visible text: its contrast with its background, and the required one.
CONTRASTS = """() => {
  const parts = (text) => (text.match(/[\\d.]+/g) ?? []).map(Number);
  const linear = (v) => (v /= 255) <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  const light = ([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
  const rgba = (text) => {
    const canvas = Object.assign(document.createElement("canvas"), { width: 1, height: 1 });
    const pen = canvas.getContext("2d", { willReadFrequently: true });
    pen.fillStyle = text;
    pen.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = pen.getImageData(0, 0, 1, 1).data;
    return [r, g, b, a / 255];
  };
  const over = (top, below) => top.slice(0, 3).map((v, i) => v * top[3] + below[i] * (1 - top[3]));
  const up = (element) => element.parentElement ?? element.getRootNode().host ?? null;
  const behind = (element) => {
    const layers = [];
    for (let at = element; at; at = up(at)) {
      const layer = rgba(getComputedStyle(at).backgroundColor);
      if (layer[3] > 0) layers.push(layer);
      if (layer[3] === 1) break;
    }
    return layers.reverse().reduce((below, layer) => over(layer, below), [255, 255, 255]);
  };
  const found = [];
  const look = (root) => {
    const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT | NodeFilter.SHOW_ELEMENT);
    for (let node = walker.nextNode(); node; node = walker.nextNode()) {
      if (node.shadowRoot) look(node.shadowRoot);
      const field = node instanceof Element
        && node.matches("select, input:not([type=range], [type=checkbox], [type=file])");
      if (!field && (node.nodeType !== Node.TEXT_NODE || !node.textContent.trim())) continue;
      const element = field ? node : node.parentElement;
      if (!element?.checkVisibility({ visibilityProperty: true })) continue;
      if (element.closest(":disabled, [aria-hidden=true], option, style")) continue;
      if (!element.getClientRects().length) continue;
      const style = getComputedStyle(element);
      const below = behind(element);
      const [a, b] = [light(over(rgba(style.color), below)), light(below)].sort((x, y) => y - x);
      const size = parseFloat(style.fontSize);
      const large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
      const text = (node.textContent || element.value).slice(0, 40);
      found.push([(a + 0.05) / (b + 0.05), large ? 3 : 4.5, text]);
    }
  };
  look(document.body);
  return found;
}"""


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_every_text_stands_out(irb120, open_page, scheme):
    page = open_page(irb120["view"], color_scheme=scheme, reduced_motion="reduce")
    until(page, STATE)
    read = 0
    for tab in TABS:
        page.get_by_role("tab", name=tab).click()
        page.mouse.move(5, 5)
        texts = page.evaluate(CONTRASTS)
        assert [text for text in texts if text[0] < text[1]] == [], tab
        read += len(texts)
    assert read > 150
    # The other theme by the button is measured like that of the system.
    page.get_by_title("Light or dark").click()
    assert [text for text in page.evaluate(CONTRASTS) if text[0] < text[1]] == []


def test_everything_is_reached_by_the_keyboard(irb120, open_page):
    page = open_page(irb120["view"])
    until(page, STATE)
    page.get_by_role("tab", name="Pendant").focus()
    for tab in TABS:
        displayed = page.get_by_role("tab", name=tab)
        assert displayed.get_attribute("aria-selected") == "true"
        wanted = page.evaluate(
            "() => { const all = [...document.querySelectorAll('button, input, select, canvas')]"
            ".filter(e => e.checkVisibility() && !e.disabled && e.tabIndex >= 0);"
            " all.forEach((e, i) => { e.dataset.wanted = i }); return all.length }"
        )
        seen = set()
        for _ in range(2 * wanted + 20):
            page.keyboard.press("Tab")
            number, line = page.evaluate(
                "[document.activeElement.dataset.wanted,"
                " getComputedStyle(document.activeElement).outlineStyle]"
            )
            if number is not None:
                assert line != "none"
                seen.add(int(number))
            if len(seen) == wanted:
                break
        assert len(seen) == wanted, tab
        page.evaluate(
            "document.querySelectorAll('[data-wanted]').forEach(e => { delete e.dataset.wanted })"
        )
        displayed.focus()
        page.keyboard.press("ArrowRight")


def test_nothing_is_cut_off_at_1280_by_720(irb120, open_page):
    page = open_page(irb120["view"])
    until(page, STATE)
    for tab in TABS:
        page.get_by_role("tab", name=tab).click()
        wide = page.evaluate(
            "[...document.querySelectorAll('header, main, aside, .view, .toolbar, .status')]"
            ".filter(e => e.checkVisibility() && e.scrollWidth > e.clientWidth + 1)"
            ".map(e => e.className || e.tagName)"
        )
        assert wide == [], tab
        assert page.evaluate("document.documentElement.scrollHeight") <= 720


def test_a_narrow_window_is_used_over_its_whole_width(irb120, open_page):
    """The wider panels of some tabs need a window with space for the robots."""
    page = open_page(irb120["view"])
    page.set_viewport_size({"width": 400, "height": 850})
    until(page, STATE)
    for tab in TABS:
        page.get_by_role("tab", name=tab).click()
        widths = page.evaluate(
            "[document.documentElement.scrollWidth,"
            " document.querySelector('aside').getBoundingClientRect().width]"
        )
        assert widths == [400, 400], tab


def test_the_emergency_stop_works_by_the_keyboard(irb120, open_page):
    page = open_page(irb120["view"])
    until(page, STATE)
    page.get_by_role("button", name="Emergency stop").first.focus()
    page.keyboard.press("Enter")
    until(page, "document.querySelector('header').textContent", lambda t: "Emergency stop" in t)
    # The same key again resets nothing.
    page.keyboard.press("Enter")
    page.get_by_role("button", name="Reset emergency stop").focus()
    page.keyboard.press("Enter")
    until(page, "document.querySelector('header').textContent", lambda t: "Motors off" in t)
    page.get_by_role("button", name="On", exact=True).focus()
    page.keyboard.press("Space")
    until(page, "document.querySelector('header').textContent", lambda t: "Motors on" in t)


def test_documented_keys_are_those_of_the_help(irb120, open_page):
    page = open_page(irb120["view"])
    until(page, STATE)
    page.keyboard.press("?")
    rows = page.get_by_role("dialog").locator("tbody tr").all()
    shown = [tuple(row.locator("th, td").all_inner_texts()) for row in rows]
    page.keyboard.press("Escape")
    assert page.get_by_role("dialog").count() == 0
    text = (DOCS / "view.md").read_text(encoding="utf-8").split("## Keyboard")[1].split("##")[0]
    lines = [line for line in text.splitlines() if line.startswith("|")][2:]
    assert [tuple(cell.strip() for cell in line.strip("|").split("|")) for line in lines] == shown
