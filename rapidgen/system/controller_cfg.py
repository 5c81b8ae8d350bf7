"""The cfg of one controller, all domains, onto which files are loaded."""

from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace

from rapidgen.system.cfg import CfgText, Instance, Section


@dataclass(frozen=True, slots=True)
class ControllerCfg:
    """The domains of a controller with this release."""

    robotware: tuple[int, int]
    domains: tuple[CfgText, ...]

    def domain(self, name: str) -> CfgText:
        """Return one domain; an empty one if the controller has no such file."""
        for text in self.domains:
            if text.domain == name:
                return text
        return CfgText(name, (self.robotware[0], 0), ())

    def instances(self, domain: str, section: str) -> Iterator[Instance]:
        """Yield the instances of a section."""
        return self.domain(domain).instances(section)

    def names(self, domain: str, section: str) -> frozenset[str]:
        """Return the names of a section's instances, without case.

        HONG: rob_R and rob_r are one.
        """
        result = (instance.text("Name") for instance in self.instances(domain, section))
        return frozenset(name.casefold() for name in result if name)

    @property
    def tasks(self) -> frozenset[str]:
        """Return the names of the tasks, without case."""
        return self.names("SYS", "CAB_TASKS")

    @property
    def unit_groups(self) -> frozenset[str]:
        """Return mechanical unit groups, without case; empty without 604-1."""
        return self.names("SYS", "MECHANICAL_UNIT_GROUP")

    @property
    def units(self) -> frozenset[str]:
        """Return the names of the mechanical units, without case."""
        sections = ("ROBOT", "SINGLE", "MECHANICAL_UNIT")
        return frozenset().union(*(self.names("MOC", section) for section in sections))

    def signal(self, name: str) -> Instance | None:
        """Return the signal of this name, found without case."""
        for instance in self.instances("EIO", "EIO_SIGNAL"):
            if instance.text("Name").casefold() == name.casefold():
                return instance
        return None

    def plus(self, file: CfgText) -> "ControllerCfg":
        """Return the cfg with the sections of a file appended."""
        own = self.domain(file.domain)
        merged = replace(own, sections=(*own.sections, *file.sections))
        others = tuple(text for text in self.domains if text.domain != file.domain)
        return replace(self, domains=(*others, merged))

    def with_instances(
        self, domain: str, section: str, instances: tuple[Instance, ...]
    ) -> "ControllerCfg":
        """Return the cfg with the instances of a type replaced; without any, the type is gone."""
        own = self.domain(domain)
        at = [i for i, s in enumerate(own.sections) if s.name.casefold() == section.casefold()]
        sections = [None if i in at else s for i, s in enumerate(own.sections)]
        if instances and at:
            sections[at[0]] = Section(own.sections[at[0]].name, instances)
        elif instances:
            sections.append(Section(section, instances))
        changed = replace(own, sections=tuple(s for s in sections if s is not None))
        if any(text.domain == domain for text in self.domains):
            domains = tuple(changed if t.domain == domain else t for t in self.domains)
        else:
            domains = (*self.domains, changed)
        return replace(self, domains=domains)

    def without(self, domain: str, gone: Collection[Instance]) -> "ControllerCfg":
        """Return the cfg without these instances of a domain."""
        own = self.domain(domain)
        sections = tuple(
            Section(s.name, tuple(i for i in s.instances if i not in gone)) for s in own.sections
        )
        others = tuple(text for text in self.domains if text.domain != domain)
        return replace(self, domains=(*others, replace(own, sections=sections)))
