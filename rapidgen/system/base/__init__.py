"""The cfg of delivered controllers, onto which a folder is loaded."""

from rapidgen.system.base.factory_cfg import Robot, base_system
from rapidgen.system.base.releases import header_digits

__all__ = ["Robot", "base_system", "header_digits"]
