"""Generate files from a configuration, compare and write them."""

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
    """Return all files for one controller.

    See `rapidgen.generate.builder.build`, which needs Jinja.
    """
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
    """Return the controller that the output gives, without the disk.

    As `system.read_folder`: loaded onto a delivered controller, or onto `under`; the other two as
    in `read_folder`.

    Raises DiagnosticError RG720..RG723 for a cfg file that a controller rejects.
    """
    from rapidgen.generate import builder

    return builder.make_system(config, output, under=under, without=without, open_words=open_words)
