"""A simulator with its page in a process of its own, and waiting for what a page shows."""

import io
import json
import os
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

from PIL import Image

DOCS = Path(__file__).parents[2] / "docs" / "use"
TIME_LIMIT = 60.0


@contextmanager
def simulator(*arguments, environment=None):
    """`rapidgen sim ... --view` in a process of its own; what `ready` says, and the process."""
    with served("sim", *arguments, "--ports", "auto", "--view", environment=environment) as result:
        yield result


@contextmanager
def served(*arguments, environment=None):
    """`rapidgen ...` that serves something; what `ready` says, and the process."""
    process = subprocess.Popen(
        [sys.executable, "-m", "rapidgen.cli", *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        env={**os.environ, **(environment or {})},
    )
    try:
        line = process.stdout.readline()
        assert line.startswith("ready "), line
        yield json.loads(line.removeprefix("ready ")), process
    finally:
        process.terminate()
        process.wait(TIME_LIMIT)
        process.stdout.close()


def until(page, expression, wanted=lambda value: value):
    """The value of an expression of the page, once it is as wanted.

    Asked for again and again: what waits within a page needs `eval`, which its CSP forbids.
    """
    end = time.monotonic() + TIME_LIMIT
    while not wanted(value := page.evaluate(expression)):
        assert time.monotonic() < end, (expression, value)
        page.wait_for_timeout(20)
    return value


STATE = "window.rapidgen && rapidgen.state()"


def picture_for_docs(page, name):
    """docs/use/NAME.png as the page is now, where RAPIDGEN_PICTURES asks for it."""
    if os.environ.get("RAPIDGEN_PICTURES"):
        shot = Image.open(io.BytesIO(page.screenshot()))
        shot.quantize(160, dither=Image.Dither.NONE).save(DOCS / f"{name}.png", optimize=True)
