"""Arc welding equipment of a PROC.cfg: ARC_EQUIP_IO_DI, _DO, _AO and _GO.

Source: PROC.cfg files of public add-ins [code zwj12/AddInPackages].
"""

from typing import Final

from rapidgen.system.cfg import CfgText
from rapidgen.system.model import ArcSignals

_SECTIONS: Final = ("ARC_EQUIP_IO_DI", "ARC_EQUIP_IO_DO", "ARC_EQUIP_IO_AO", "ARC_EQUIP_IO_GO")


def arc_signals(proc: CfgText) -> tuple[ArcSignals, ...]:
    """Return the equipment by instance; an empty name is no signal."""
    result: dict[str, list[tuple[str, str]]] = {}
    for section in _SECTIONS:
        for instance in proc.instances(section):
            names = result.setdefault(instance.text("name"), [])
            names += [
                (attribute.name, str(attribute.values[0]))
                for attribute in instance.attributes
                if attribute.name.lower() != "name" and attribute.values and attribute.values[0]
            ]
    return tuple(ArcSignals(name, tuple(names)) for name, names in result.items())
