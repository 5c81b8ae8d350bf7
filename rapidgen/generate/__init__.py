"""Model to files: `build` makes them, `compare` and `write` bring them to a folder."""

from typing import TYPE_CHECKING

from rapidgen.generate.output import Change, Output, OutputFile, compare, write

if TYPE_CHECKING:
    from rapidgen.config.model import RobotConfig
    from rapidgen.system import System

__all__ = ["Change", "Output", "OutputFile", "build", "compare", "make_system", "write"]


def build(config: "RobotConfig") -> Output:
    """All files for one controller: see `rapidgen.generate.builder.build`, which needs Jinja."""
    from rapidgen.generate import builder

    return builder.build(config)


def make_system(config: "RobotConfig", output: Output) -> "System":
    """The System that the output describes, without a detour over the disk."""
    from rapidgen.generate import builder

    return builder.make_system(config, output)
