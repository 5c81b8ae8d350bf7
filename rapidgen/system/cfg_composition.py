"""Compose the cfg database of a controller from its system and robots."""

from collections.abc import Sequence

from rapidgen.config.model import GroupConfig
from rapidgen.system.base import Robot, base_system
from rapidgen.system.base.mechanics_cfg import delivered_sections, internal_cfg
from rapidgen.system.cfg import CfgText
from rapidgen.system.cfg_database import CfgDatabase
from rapidgen.system.cfg_loading import identity
from rapidgen.system.cfg_writer import eio_cfg, sys_cfg
from rapidgen.system.controller_cfg import ControllerCfg
from rapidgen.system.model import System


def database_of(system: System, groups: Sequence[GroupConfig]) -> CfgDatabase:
    """Return the database of a controller.

    It has the cfg that the system was read from, with the tasks and signals that a cell adds, or
    that of a delivered controller with these robots.
    """
    cfg = system.cfg if system.cfg is not None else _delivered(system, groups)
    for own in (sys_cfg(system), eio_cfg(system)):
        cfg = _with_missing(cfg, own)
    if not any(cfg.instances("MOC", "ARM")):
        # Of a delivered controller, or a backup without MOC.cfg.
        for section in delivered_sections(groups):
            cfg = cfg.with_instances("MOC", section.name, section.instances)
    return CfgDatabase(cfg, internal_cfg(cfg, groups))


def _delivered(system: System, groups: Sequence[GroupConfig]) -> ControllerCfg:
    robots = [
        Robot(group.task, group.mechanical_unit, tuple(group.external_units))
        for group in groups
        if group.mechanical_unit
    ]
    base = base_system(system.robotware, robots)
    for own in (sys_cfg(system), eio_cfg(system)):
        base = _with_sections(base, own)
    return base


def _with_sections(cfg: ControllerCfg, text: CfgText) -> ControllerCfg:
    """Return the cfg with the sections of a text in place of its own."""
    for section in text.sections:
        cfg = cfg.with_instances(text.domain, section.name, section.instances)
    return cfg


def _with_missing(cfg: ControllerCfg, text: CfgText) -> ControllerCfg:
    """Return the cfg with the signals and tasks that it lacks."""
    for section in text.sections:
        if section.name in ("EIO_SIGNAL", "CAB_TASKS"):
            present = tuple(cfg.instances(text.domain, section.name))
            names = {identity(section.name, instance) for instance in present}
            added = tuple(i for i in section.instances if identity(section.name, i) not in names)
            if added:
                cfg = cfg.with_instances(text.domain, section.name, (*present, *added))
    return cfg
