"""A real browser (the system's Chromium, headless) before a simulator in a process of its own."""

import os
import shutil

import pytest

from rapidgen.viewer.server import ASSETS
from tests.viewer.bench import simulator

ARGUMENTS = [
    "--no-sandbox",
    "--disable-gpu",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]


def absent(what):
    """Fail under CI, skip elsewhere."""
    if os.environ.get("CI") == "true":
        pytest.fail(f"this machine has no {what}")
    pytest.skip(f"this machine has no {what}")


# Of a module, not of the session: while the driver runs, no other test of this process can have an
# event loop.
@pytest.fixture(scope="module")
def browser():
    path = shutil.which("chromium")
    if path is None:
        absent("Chromium: run .ci/browser, or install it")
    if not (ASSETS / "index.html").is_file():
        absent("built page: `make page`")
    sync_api = pytest.importorskip("playwright.sync_api")
    with sync_api.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=path, args=ARGUMENTS)
        yield browser
        browser.close()


@pytest.fixture
def open_page(browser):
    """Opens an address in a window of its own; what the page complains of is a fault at the end."""
    contexts, faults = [], []

    def opened(url, before="", **options):
        context = browser.new_context(viewport={"width": 1280, "height": 720}, **options)
        contexts.append(context)
        if before:
            context.add_init_script(before)
        page = context.new_page()
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.on(
            "console",
            lambda message: faults.append(message.text) if message.type == "error" else None,
        )
        page.goto(url)
        return page

    opened.faults = faults
    yield opened
    for context in contexts:
        context.close()
    assert faults == []


@pytest.fixture(scope="module")
def irb120():
    with simulator("irb120") as (ready, _):
        yield ready
