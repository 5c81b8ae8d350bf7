"""A URDF with further configuration, loaded."""

import pytest

from rapidgen.config import load_config
from rapidgen.diagnostics import DiagnosticError


@pytest.fixture
def check(tmp_path):
    """Load a URDF with further configuration; (config or None, findings by code)."""

    def run(text, more="", *, head="", urdf="", suffix=".urdf", package_paths=()):
        (tmp_path / f"robot{suffix}").write_text(text)
        config = f"{head}\nurdf:\n  file: robot{suffix}\n{urdf}\n{more}\n"
        (tmp_path / "cell.yaml").write_text(config)
        try:
            made = load_config(tmp_path / "cell.yaml", package_paths=package_paths)
        except DiagnosticError as fault:
            return None, {d.code: d for d in reversed(fault.diagnostics)}
        return made, {d.code: d for d in made.diagnostics}

    return run
