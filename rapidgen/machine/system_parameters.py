"""System parameters and text tables."""

import re

from rapidgen.config.model import GroupConfig, Joint
from rapidgen.system import CfgText, System, eio_cfg, sys_cfg
from rapidgen.system.cfg import Attribute, Instance, Scalar, Section, write_cfg

# -- System parameters -----------------------------------------------------------------------------
#
# System parameters for ReadCfgData.
#
# SYS and EIO are those of the system. MOC contains ARM with the axis limits (rad, m), because
# programs read them. A written value is stored here without a reconfiguration.


_Values = dict[str, Scalar | bool]


class SystemParameters:
    """Instances by domain, type and name, without case."""

    def __init__(self, system: System, groups: tuple[GroupConfig, ...]) -> None:
        self._texts = {text.domain: text for text in (sys_cfg(system), eio_cfg(system))}
        version = next(iter(self._texts.values())).version
        arms = tuple(_arm(group, joint) for group in groups for joint in group.joints)
        self._texts["MOC"] = CfgText("MOC", version, (Section("ARM", arms),))
        self._types: dict[tuple[str, str], list[_Values]] = {}
        self._named: dict[tuple[str, str, str], _Values] = {}
        for domain, text in self._texts.items():
            for section in text.sections:
                kind = (domain.lower(), section.name.lower())
                for instance in section.instances:
                    values: _Values = {
                        a.name.lower(): a.values[0] if a.values else True
                        for a in instance.attributes
                    }
                    self._types.setdefault(kind, []).append(values)
                    self._named.setdefault((*kind, instance.text("Name").lower()), values)

    @property
    def domains(self) -> tuple[str, ...]:
        """Names of the domains."""
        return tuple(self._texts)

    def find(self, path: str) -> list[_Values]:
        """Return attributes of `/DOMAIN/TYPE/INSTANCE`.

        Without an instance, return those of every instance of `/DOMAIN/TYPE`. The caller may change
        them. Empty: unknown path.
        """
        parts = [part.lower() for part in path.strip("/").split("/")]
        if len(parts) == 2:
            return self._types.get((parts[0], parts[1]), [])
        match = self._named.get((parts[0], parts[1], parts[2])) if len(parts) == 3 else None
        return [] if match is None else [match]

    def text(self, domain: str) -> str:
        """Return a domain as cfg text, or raise KeyError."""
        return write_cfg(self._texts[domain])


def _arm(group: GroupConfig, joint: Joint) -> Instance:
    return Instance(
        (
            Attribute("Name", (arm_name(group, joint),)),
            Attribute("upper_joint_bound", (joint.upper,)),
            Attribute("lower_joint_bound", (joint.lower,)),
        )
    )


def arm_name(group: GroupConfig, joint: Joint) -> str:
    """Return the ARM name of a joint, as in backups and public RAPID.

    rob1_1 to rob1_6 of ROB_1, rob_R_7 the seventh axis of a YuMi. An external axis has the name of
    its mechanical unit, with a number if the unit has several.
    """
    kind, _, axis = joint.axis.partition("_")
    robot = group.mechanical_unit
    robot = robot.lower().replace("_", "") if robot[-1:].isdigit() else f"rob{robot[3:]}"
    if kind == "rax":
        return f"{robot}_{axis}"
    if not group.external_units:
        return f"{robot}_{7 + 'abcdef'.index(axis)}"
    external = [j for j in group.joints if j.axis.startswith("eax_")]
    if len(external) == len(group.external_units):
        return group.external_units[external.index(joint)]
    return f"{group.external_units[0]}_{1 + external.index(joint)}"


# -- Text tables -----------------------------------------------------------------------------------
#
# Text tables that programs install from files [K §15].


_TABLE_NAME = re.compile(r"(\S.{0,79})::")
_INDEX = re.compile(r"(\d+):")


class TextTables:
    """Installed text tables: names, numbers from 1, texts by index."""

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {}
        self._texts: list[dict[int, str]] = []

    def number(self, name: str) -> int | None:
        """Return the number of a table."""
        return self._numbers.get(name)

    def text(self, number: int, index: int) -> str | None:
        """Return a text."""
        if not 1 <= number <= len(self._texts):
            return None
        return self._texts[number - 1].get(index)

    def install(self, text: str) -> None:
        """Install the tables of a file [K §15], or extend existing ones.

        ValueError: a line of another format.
        """
        table: dict[int, str] | None = None
        index: int | None = None
        for number, line in enumerate(text.splitlines(), 1):
            if index is not None and table is not None:
                table[index] = line.replace("\\n", "\n")
                index = None
            elif not line.strip() or line.startswith("#"):
                continue
            elif match := _TABLE_NAME.fullmatch(line.strip()):
                table = self._table(match[1])
            elif (match := _INDEX.fullmatch(line.strip())) and table is not None:
                index = int(match[1])
            else:
                raise ValueError(f"line {number}")

    def _table(self, name: str) -> dict[int, str]:
        number = self._numbers.setdefault(name, len(self._texts) + 1)
        if number > len(self._texts):
            self._texts.append({})
        return self._texts[number - 1]
