"""Model to files: `build` makes them, `compare` and `write` bring them to a folder."""

from typing import TYPE_CHECKING

from rapidgen.generate.output import Change, Output, OutputFile, compare, write

if TYPE_CHECKING:
    from collections.abc import Collection

    from rapidgen.config.model import RobotConfig
    from rapidgen.generate.existing_controller import Cell
    from rapidgen.system import System
    from rapidgen.system.build_loading import BaseController

__all__ = ["Change", "Output", "OutputFile", "build", "compare", "make_system", "write"]


def build(config: "RobotConfig", cell: "Cell | None" = None) -> Output:
    """All files for one controller: see `rapidgen.generate.builder.build`, which needs Jinja."""
    from rapidgen.generate import builder

    return builder.build(config, cell)


def make_system(
    config: "RobotConfig",
    output: Output,
    *,
    under: "BaseController | None" = None,
    without: "Collection[str]" = (),
    open_words: bool = True,
) -> "System":
    """The controller that the output makes, as `system.read_folder` without the disk: loaded
    onto a delivered controller, or onto `under`; the other two as in `read_folder`.

    Raises DiagnosticError RG720..RG723 for a cfg file that it would not load.
    """
    from rapidgen.generate import builder

    return builder.make_system(config, output, under=under, without=without, open_words=open_words)
