"""editors/vscode in VS Code: code-server before headless Chromium, and the grammar without it.

The extension `probe` uses the commands of VS Code instead of the page's elements, which change with
each version, and writes a report.
"""

import json
import os
import shutil
import socket
import subprocess
import sys
import time
import zipfile
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.editors.node import BUILT, MODULES, node
from tests.viewer.bench import until
from tests.viewer.conftest import ARGUMENTS, absent
from tests.viewer.test_program_aspect import TARGETS as POINTS
from tests.viewer.test_program_page import SEEN

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
SERVER = ROOT / "build" / "code-server" / "node_modules" / "code-server" / "out" / "node"
MODULE = """MODULE cell
  PERS num total := 0;
  PROC main()
    VAR num i := 0;
    VAR num answer;
    FOR k FROM 1 TO 4 DO
      work i;
    ENDFOR
    TPReadFK answer, "Go on?", "Yes", "No", stEmpty, stEmpty, stEmpty;
    TPWrite "answered " \\Num:=answer;
  ENDPROC
  PROC work(INOUT num n)
    n := n + 1;
    total := total + n;
  ENDPROC
  PROC unused()
    totl := 1;
  ENDPROC
ENDMODULE
"""

PICTURES = os.environ.get("RAPIDGEN_PICTURES", "")
"""Folder for pictures of the pages, to look at."""

pytestmark = pytest.mark.long


def packed(folder, target):
    """Pack a plain extension as VSIX."""
    about = json.loads((folder / "package.json").read_text())
    manifest = (
        '<PackageManifest Version="2.0.0" xmlns="http://schemas.microsoft.com/developer/vsx-schema/2011">'
        f'<Metadata><Identity Language="en-US" Id="{about["name"]}" Version="{about["version"]}" '
        f'Publisher="{about["publisher"]}"/><DisplayName>probe</DisplayName></Metadata>'
        '<Installation><InstallationTarget Id="Microsoft.VisualStudio.Code"/></Installation>'
        '<Assets><Asset Type="Microsoft.VisualStudio.Code.Manifest" '
        'Path="extension/package.json"/></Assets></PackageManifest>'
    )
    types = (
        '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">'
        '<Default Extension=".json" ContentType="application/json"/>'
        '<Default Extension=".js" ContentType="application/javascript"/>'
        '<Default Extension=".vsixmanifest" ContentType="text/xml"/></Types>'
    )
    with zipfile.ZipFile(target, "w") as archive:
        archive.writestr("extension.vsixmanifest", manifest)
        archive.writestr("[Content_Types].xml", types)
        for name in ("package.json", "extension.js"):
            archive.write(folder / name, f"extension/{name}")
    return target


def settings(folder):
    """Name rapidgen in the settings: VS Code takes PATH from the login shell."""
    program = folder / "rapidgen"
    program.write_text(f'#!/bin/sh\nPYTHONPATH="{ROOT}" exec "{sys.executable}" -m rapidgen "$@"\n')
    program.chmod(0o755)
    # The path of a program is a setting of the machine, which is the server's here.
    machine = folder / "data" / "Machine"
    machine.mkdir(parents=True)
    (machine / "settings.json").write_text(json.dumps({"rapidgen.path": str(program)}))


def test_grammar():
    if not MODULES.is_dir():
        absent("npm packages of editors/vscode: .ci/editors")
    done = subprocess.run(
        [
            *node(),
            str(MODULES / ".bin" / "vscode-tmgrammar-test"),
            "--grammar",
            "syntaxes/rapid.tmLanguage.json",
            "test/grammar/*.mod",
        ],
        cwd=BUILT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout


@contextmanager
def workbench(folder, workspace, probes=(), **environment):
    """VS Code with the extension on a workspace: its page, and its log."""
    vsix, chromium = BUILT / "rapidgen.vsix", shutil.which("chromium")
    if not (SERVER / "entry.js").is_file():
        absent("code-server: .ci/code_server")
    if not vsix.is_file():
        absent("extension: make vsix")
    if chromium is None:
        absent("Chromium: run .ci/browser, or install it")
    sync_api = pytest.importorskip("playwright.sync_api")
    settings(folder)
    environment = {
        **os.environ,
        "PATH": f"{Path(node()[0]).parent}{os.pathsep}{os.environ['PATH']}",
        "HOME": str(folder),
        **environment,
    }
    places = ["--user-data-dir", str(folder / "data"), "--extensions-dir", str(folder / "ext")]
    entry = [*node(), str(SERVER / "entry.js"), *places]
    for one in (vsix, *probes):
        subprocess.run(
            [*entry, "--install-extension", str(one)], env=environment, check=True, timeout=120
        )
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    options = ["--disable-telemetry", "--disable-update-check", "--disable-workspace-trust"]
    log = folder / "log.txt"
    with (
        log.open("w") as output,
        subprocess.Popen(
            [*entry, "--auth", "none", "--bind-addr", f"127.0.0.1:{port}", *options],
            env=environment,
            stdout=output,
            stderr=output,
        ) as server,
    ):
        try:
            wait(lambda: _listens(port), log)
            with sync_api.sync_playwright() as driver:
                browser = driver.chromium.launch(executable_path=chromium, args=ARGUMENTS)
                page = browser.new_page(viewport={"width": 1280, "height": 800})
                page.goto(f"http://127.0.0.1:{port}/?folder={workspace}")
                yield page, log
                browser.close()
        finally:
            server.terminate()


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    """What the probe has seen in VS Code, and what a page of its session has shown."""
    folder = tmp_path_factory.mktemp("vscode")
    workspace = folder / "workspace"
    workspace.mkdir()
    (workspace / "cell.mod").write_text(MODULE)
    (workspace / "go.mod").write_text("module example.org/x\n")
    (workspace / "points.mod").write_text(POINTS)
    seen, address = folder / "report.json", folder / "address.txt"
    own = packed(HERE / "probe", folder / "probe.vsix")
    environment = {"RAPIDGEN_PROBE": str(seen), "RAPIDGEN_PROBE_LSP": "1"}
    shown = folder / "shown.json"
    with workbench(
        folder,
        workspace,
        [own],
        RAPIDGEN_PROBE_PAGE=str(address),
        RAPIDGEN_PROBE_SHOWN=str(shown),
        **environment,
    ) as (page, log):
        wait(lambda: address.is_file() or seen.is_file(), log)
        if address.is_file():
            robot = page.context.browser.new_page(viewport={"width": 1280, "height": 720})
            robot.goto(address.read_text())
            drawn = until(robot, "window.rapidgen && rapidgen.editor.seen", lambda all: all)
            robot.get_by_role("tab", name="Program").click()
            until(robot, f"{SEEN}.breakpoints.length")
            points = robot.evaluate(f"{SEEN}.breakpoints")
            if PICTURES:
                robot.screenshot(path=str(Path(PICTURES) / "target.png"))
            robot.get_by_role("button", name="Pointer in editor").click()
            shown.write_text(json.dumps({"targets": drawn, "breakpoints": points}))
        wait(seen.is_file, log)
    return {**json.loads(seen.read_text()), "page": json.loads(shown.read_text())}


def _listens(port):
    with socket.socket() as own:
        return own.connect_ex(("127.0.0.1", port)) == 0


def wait(condition, log):
    end = time.monotonic() + 180
    while not condition():
        assert time.monotonic() < end, log.read_text()[-3000:]
        time.sleep(0.2)


def test_probe_has_finished(report):
    assert report.get("passed"), report


def test_languages_of_files(report):
    assert report["language"] == "rapid"
    assert report["goMod"] != "rapid"


def test_debug_session(report):
    assert report["stack"] == [13, 7]
    assert report["value"] == "3"
    assert report["afterStep"] == 14
    assert report["output"] == ["T_ROB1: answered 1\n"]


def test_dialog_is_a_quick_pick(report):
    assert report["questionInConsole"] is False


def test_language_server(report):
    assert any(one["line"] == 17 for one in report["findings"])
    assert report["definition"] == [12]
    assert report["renamed"] == [7, 12]
    assert report["fixes"]
    assert {"main", "work", "unused"} <= set(report["symbols"])


def test_target_under_cursor_is_drawn_on_the_page(report):
    assert report["shownTargets"] == ["p10"]
    heights = [round(one["pose"]["position"][2], 6) for one in report["page"]["targets"]]
    assert heights == [0.4, 0.5]
    assert report["lenses"] == [2, 3]


def test_page_shows_breakpoints_of_the_session_and_opens_the_pointer(report):
    assert report["page"]["breakpoints"] == [8]
    assert report["opened"] == ["points.mod", 6]
