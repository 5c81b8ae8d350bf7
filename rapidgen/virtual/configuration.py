"""System parameters as ReadCfgData sees them: what the virtual controller is made of.

SYS and EIO are those of the system; of MOC there is ARM with the axes' limits (rad, m), since
programs ask for them. A written value stays here: nothing is reconfigured by it.
"""

from rapidgen.config.model import MotionGroup
from rapidgen.system import CfgText, System, eio_cfg, sys_cfg
from rapidgen.system.cfg import Attribute, Instance, Scalar, Section, write_cfg

_Values = dict[str, Scalar | bool]


class Configuration:
    """Instances by domain, type and name, without case."""

    def __init__(self, system: System, groups: tuple[MotionGroup, ...]) -> None:
        self._texts = {text.domain: text for text in (sys_cfg(system), eio_cfg(system))}
        version = next(iter(self._texts.values())).version
        arms = tuple(_arm(group, i) for group in groups for i in range(len(group.joints)))
        self._texts["MOC"] = CfgText("MOC", version, (Section("ARM", arms),))
        self._values: dict[tuple[str, str, str], _Values] = {}
        for domain, text in self._texts.items():
            for section in text.sections:
                for instance in section.instances:
                    key = (domain.lower(), section.name.lower(), instance.text("Name").lower())
                    self._values[key] = {
                        a.name.lower(): a.values[0] if a.values else True
                        for a in instance.attributes
                    }

    @property
    def domains(self) -> tuple[str, ...]:
        """Names of the domains."""
        return tuple(self._texts)

    def find(self, path: str) -> _Values | None:
        """Attributes of `/DOMAIN/TYPE/INSTANCE`, or None. They may be changed."""
        parts = [part.lower() for part in path.strip("/").split("/")]
        if len(parts) != 3:
            return None
        return self._values.get((parts[0], parts[1], parts[2]))

    def text(self, domain: str) -> str:
        """A domain as cfg text, as the system was read. KeyError: there is none."""
        return write_cfg(self._texts[domain])


def _arm(group: MotionGroup, index: int) -> Instance:
    joint = group.joints[index]
    return Instance(
        (
            Attribute("Name", (f"{group.name}_{index + 1}",)),
            Attribute("upper_joint_bound", (joint.upper,)),
            Attribute("lower_joint_bound", (joint.lower,)),
        )
    )
