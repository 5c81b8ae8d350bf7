"""Model to files: `build` makes them, `compare` and `write` bring them to a folder."""

from typing import TYPE_CHECKING

from rapidgen.generate.output import Change, Output, OutputFile, compare, write

if TYPE_CHECKING:
    from rapidgen.config.model import RobotConfig

__all__ = ["Change", "Output", "OutputFile", "build", "compare", "write"]


def build(config: "RobotConfig") -> Output:
    """All files for one controller: see `rapidgen.generate.builder.build`, which needs Jinja."""
    from rapidgen.generate import builder

    return builder.build(config)
