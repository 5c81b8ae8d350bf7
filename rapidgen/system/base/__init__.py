"""Controllers as they are delivered: the cfg that a generated folder is loaded onto."""

from rapidgen.system.base.factory_cfg import Robot, base_system
from rapidgen.system.base.releases import header_digits

__all__ = ["Robot", "base_system", "header_digits"]
