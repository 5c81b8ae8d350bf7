"""Read YAML and URDF into one frozen, checked model of the robot."""

from pathlib import Path
from typing import TYPE_CHECKING

from rapidgen.config.manifest import from_manifest, to_manifest
from rapidgen.config.registry import find_shipped, shipped_names

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rapidgen.config.layers import Overrides
    from rapidgen.config.model import RobotConfig

__all__ = ["find_shipped", "from_manifest", "load_config", "shipped_names", "to_manifest"]


def load_config(
    path_or_name: str | Path,
    *,
    overrides: "Overrides" = (),
    package_paths: "Sequence[str | Path]" = (),
) -> "RobotConfig":
    """Read and check a configuration.

    See `rapidgen.config.load`, which needs pydantic.
    """
    from rapidgen.config import load

    return load.load_config(path_or_name, overrides=overrides, package_paths=package_paths)
