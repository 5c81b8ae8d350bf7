"""The page: `python benchmarks/view.py [--seconds 10]`.

Needs Chromium, and the built page. Navigation to the first state, pictures a second at 800x600 in
software rendering while the robot moves, delay of states (median, p99), CPU of the simulator for
ten viewers against one, and the size of the bundle.
"""

import argparse
import asyncio
import gzip
import json
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import urlsplit

import aiohttp
import numpy as np
from playwright.sync_api import sync_playwright

from rapidgen.viewer.server import ASSETS

ARGUMENTS = (
    "--no-sandbox --disable-gpu --use-gl=angle --use-angle=swiftshader "
    "--enable-unsafe-swiftshader --disable-background-networking"
)
ROUNDS = 7
"""One viewer and ten in turn, so that other load affects both."""
PROGRAM = """MODULE Loop
  PROC main()
    WHILE TRUE DO
      MoveAbsJ [[60,20,-20,60,40,90],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;
      MoveAbsJ [[-60,-20,20,-60,-40,-90],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;
    ENDWHILE
  ENDPROC
ENDMODULE
"""


@contextmanager
def simulator(folder):
    program = Path(folder) / "Loop.mod"
    program.write_text(PROGRAM)
    process = subprocess.Popen(
        [sys.executable, "-m", "rapidgen.cli", "sim", str(program), "--ports", "auto", "--view"],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    try:
        yield json.loads(process.stdout.readline().removeprefix("ready ")), process.pid
    finally:
        process.terminate()
        process.wait()


def offset(ready):
    """Return wall time minus the controller's, s, by the fastest question."""
    best = (9.0, 0.0)
    with socket.create_connection(("127.0.0.1", ready["control"])) as control:
        lines = control.makefile("rw")
        for _ in range(50):
            requested = time.time()
            lines.write('{"do": "status"}\n')
            lines.flush()
            now = json.loads(lines.readline())["result"]["time"]
            took = time.time() - requested
            best = min(best, (took, requested + took / 2 - now))
    return best[1]


def browse(ready, seconds):
    with sync_playwright() as driver:
        chromium = driver.chromium.launch(
            executable_path=shutil.which("chromium"), args=ARGUMENTS.split()
        )
        # The space next to the panels is 800x600 then.
        page = chromium.new_context(viewport={"width": 1208, "height": 647}).new_page()
        began = time.monotonic()
        page.goto(ready["view"])
        while not page.evaluate("window.rapidgen && rapidgen.state() !== null"):
            time.sleep(0.005)
        first = time.monotonic() - began
        page.evaluate(
            "() => { window.seen = []; rapidgen.link.on('positions', now =>"
            " seen.push([(performance.timeOrigin + performance.now()) / 1000, now.time])) }"
        )
        time.sleep(1)
        before = page.evaluate("[rapidgen.stage.drawn.pictures, performance.now()]")
        time.sleep(seconds)
        after = page.evaluate("[rapidgen.stage.drawn.pictures, performance.now()]")
        seen = np.array(page.evaluate("window.seen"))
        size = page.evaluate(
            "[rapidgen.stage.element.clientWidth, rapidgen.stage.element.clientHeight]"
        )
        chromium.close()
    rate = (after[0] - before[0]) / (after[1] - before[1]) * 1000
    late = (seen[:, 0] - seen[:, 1] - offset(ready)) * 1000
    text = len(seen) / (seconds + 1)
    median, last = np.median(late), np.percentile(late, 99)
    print(f"navigation to first state   {first:6.2f} s")
    print(f"pictures a second           {rate:6.1f}   ({size[0]}x{size[1]}, {text:.1f} states/s)")
    print(f"state late by               {median:6.1f} ms median, {last:.1f} ms p99")


async def watch(url, count, seconds, pid):
    """Return s of CPU of the simulator per second, with `count` viewers."""
    parts = urlsplit(url)
    origin = f"http://{parts.netloc}"
    headers = {"Origin": origin}
    async with aiohttp.ClientSession(cookie_jar=aiohttp.CookieJar(unsafe=True)) as session:
        token = parts.fragment.removeprefix("token=")
        await session.post(f"{origin}/session", data=token, headers=headers)

        async def look():
            async with session.ws_connect(f"{origin}/link", headers=headers) as link:
                async for _ in link:
                    pass

        viewers = [asyncio.ensure_future(look()) for _ in range(count)]
        await asyncio.sleep(1)
        began = spent(pid)
        await asyncio.sleep(seconds)
        used = spent(pid) - began
        for viewer in viewers:
            viewer.cancel()
        await asyncio.gather(*viewers, return_exceptions=True)
    return used / seconds


def spent(pid):
    """Return CPU s of all threads; ticks would be too coarse."""
    threads = Path(f"/proc/{pid}/task").iterdir()
    return sum(int((own / "schedstat").read_text().split()[0]) for own in threads) / 1e9


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=10)
    seconds = parser.parse_args().seconds
    with tempfile.TemporaryDirectory() as folder, simulator(folder) as (ready, pid):
        browse(ready, seconds)
        rounds = [
            [asyncio.run(watch(ready["view"], count, seconds, pid)) for count in (1, 10)]
            for _ in range(ROUNDS)
        ]
        one, ten = np.median(rounds, axis=0)
        print(f"CPU of the simulator       {one:7.4f} s/s with one viewer")
        print(f"                           {ten:7.4f} s/s with ten ({ten / one:.3f} x, by turns)")
    sizes = {p.name: len(gzip.compress(p.read_bytes())) for p in ASSETS.iterdir() if p.is_file()}
    page = sum(sizes[name] for name in ("index.html", "page.js", "page.css", "icon.svg"))
    print(f"bundle                      {page / 1000:6.0f} kB compressed")


if __name__ == "__main__":
    main()
