"""From a configuration to what boots: the one place of this room that knows the generator."""

from os import PathLike

from rapidgen.config import load_config
from rapidgen.config.model import RobotConfig
from rapidgen.controller.cell import in_its_cell
from rapidgen.system.model import System


def generated_system(
    config: "RobotConfig | str | PathLike[str]", overrides: tuple[str, ...] = ()
) -> tuple[System, RobotConfig]:
    """The system that `rapidgen build` makes of a configuration, a file of one, or a shipped name,
    in its cell.

    Raises DiagnosticError.
    """
    from rapidgen.generate import build, make_system

    if not isinstance(config, RobotConfig):
        config = load_config(str(config), overrides=overrides)
    return in_its_cell(make_system(config, build(config)), config), config
