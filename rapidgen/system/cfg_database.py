"""The cfg database of one controller: all domains, their instances and defaults.

RAPID (ReadCfgData, WriteCfgData, SaveCfgData), Robot Web Services, backups and the mechanics read
this one database. It has two parts:

- `cfg`: what the files of a backup contain. Changes take effect at the next restart.
- `internal`: instances that a controller has and does not save, such as the joints of a robot
  model. They can be read, not changed.

An instance of a file hides the internal one with the same name.
"""

from collections.abc import Mapping

from rapidgen.system.base.releases import DOMAINS
from rapidgen.system.cfg import Attribute, CfgText, Instance, Scalar, write_cfg
from rapidgen.system.cfg_defaults import DEFAULTS, default_of
from rapidgen.system.cfg_loading import identity
from rapidgen.system.controller_cfg import ControllerCfg


class CfgDatabase:
    """The cfg of a running controller. Types, instances and attributes have no case."""

    def __init__(self, cfg: ControllerCfg, internal: tuple[CfgText, ...] = ()) -> None:
        self.cfg = cfg
        self._internal = {text.domain: text for text in internal}

    @property
    def domains(self) -> tuple[str, ...]:
        """Names of the domains, sorted."""
        return tuple(sorted(DOMAINS))

    def types(self, domain: str) -> tuple[str, ...]:
        """Return the types of a domain that have instances, those of the file first."""
        texts = (self.cfg.domain(domain.upper()), self._internal.get(domain.upper()))
        sections = (s for text in texts if text is not None for s in text.sections if s.instances)
        names = {section.name.casefold(): section.name for section in sections}
        return tuple(names.values())

    def instances(self, domain: str, section: str) -> tuple[Instance, ...]:
        """Return the instances of a type: those of the file, then internal ones."""
        saved = tuple(self.cfg.instances(domain.upper(), section))
        internal = self._internal.get(domain.upper())
        if internal is None:
            return saved
        names = {identity(section, instance) for instance in saved}
        return saved + tuple(
            instance
            for instance in internal.instances(section)
            if identity(section, instance) not in names
        )

    def instance(self, domain: str, section: str, name: str) -> Instance | None:
        """Return an instance by its attribute Name."""
        for instance in self.instances(domain, section):
            if instance.text("Name").casefold() == name.casefold():
                return instance
        return None

    def find(self, path: str) -> tuple[str, str, tuple[Instance, ...]]:
        """Return domain, type and instances of `/DOMAIN/TYPE/INSTANCE`.

        Without an instance, return those of every instance of `/DOMAIN/TYPE`. An unknown path has
        no instances.
        """
        domain, _, rest = path.strip("/").partition("/")
        section, has_name, name = rest.partition("/")
        if not has_name:
            return domain.upper(), section, self.instances(domain, section) if section else ()
        match = self.instance(domain, section, name)
        return domain.upper(), section, () if match is None else (match,)

    def is_internal(self, domain: str, section: str, instance: Instance) -> bool:
        """Return True if an instance belongs to the controller and cannot be changed."""
        return not any(known is instance for known in self.cfg.instances(domain.upper(), section))

    def change(
        self,
        domain: str,
        section: str,
        instance: Instance,
        values: Mapping[str, Scalar | bool | None],
    ) -> Instance:
        """Set attributes of an instance of the file and return it; None removes one.

        ValueError: the instance is internal.
        """
        if self.is_internal(domain, section, instance):
            raise ValueError(f"{section} {instance.text('Name')} is internal")
        names = {name.casefold() for name in values}
        kept = [a for a in instance.attributes if a.name.casefold() not in names]
        new = [
            Attribute(name, () if value is True else (value,))
            for name, value in values.items()
            if value is not None and value is not False
        ]
        changed = Instance((*kept, *new), instance.line)
        rows = self.cfg.instances(domain.upper(), section)
        self.cfg = self.cfg.with_instances(
            domain.upper(), section, tuple(changed if row is instance else row for row in rows)
        )
        return changed

    def text(self, domain: str) -> str:
        """Return a domain as its file would be saved."""
        return write_cfg(self.cfg.domain(domain.upper()))


def with_defaults(domain: str, section: str, instance: Instance) -> tuple[Attribute, ...]:
    """Return the attributes of an instance, then those that its file leaves out."""
    names = {attribute.name.casefold() for attribute in instance.attributes}
    rows = DEFAULTS.get((domain.upper(), section.upper()), {})
    return instance.attributes + tuple(
        Attribute(row.name, (row.value,)) for key, row in rows.items() if key not in names
    )


def value_of(domain: str, section: str, instance: Instance, name: str) -> Scalar | bool | None:
    """Return an attribute's value, or its default; None if neither is known.

    A flag is True.
    """
    for attribute in instance.attributes:
        if attribute.name.casefold() == name.casefold():
            return attribute.values[0] if attribute.values else True
    default = default_of(domain, section, name)
    return default.value if default is not None else None
