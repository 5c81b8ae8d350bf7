"""The cfg files of a build, loaded in addition to the controller's.

Rows that no controller's file was seen to have go into files of their own, `*_open.cfg`: a
controller may reject them as a whole, and the driver works without them.
"""

from dataclasses import replace

from rapidgen.config.model import RobotConfig
from rapidgen.diagnostics import Diagnostic, DiagnosticError, error
from rapidgen.generate.layout import open_signals
from rapidgen.system import Attribute, CfgText, Instance, Section, System, eio_cfg, sys_cfg
from rapidgen.system.releases import known_digits

OPEN_FILES = ("EIO_open.cfg", "SYS_open.cfg")
_FIREWALL_SINCE = 7
_SERVICE_PORT = "192.168.125.1"


def cfg_files(config: RobotConfig, system: System) -> tuple[tuple[str, CfgText], ...]:
    """Return name and content of each file, in the order of loading.

    Raises DiagnosticError RG105 when the first line of a file is not known for this RobotWare.
    """
    opened = open_signals(config)
    sure = replace(
        system,
        signals=tuple(s for s in system.signals if s.name not in opened),
        outputs=tuple(o for o in system.outputs if o.signal not in opened),
    )
    unsure = System(
        system.name,
        (),
        signals=tuple(s for s in system.signals if s.name in opened),
        outputs=tuple(o for o in system.outputs if o.signal in opened),
        robotware=system.robotware,
    )
    texts = [
        ("EIO.cfg", eio_cfg(sure)),
        ("SYS.cfg", sys_cfg(sure, on_top=True)),
        *zip(OPEN_FILES, (eio_cfg(unsure), sys_cfg(unsure, on_top=True)), strict=True),
    ]
    if config.robotware[0] >= _FIREWALL_SINCE:
        texts.append(("SIO.cfg", _firewall(config)))
    present = [(name, text) for name, text in texts if text.sections]
    given = {name: (major, minor) for name, major, minor in config.cfg_header}
    digits = {
        text.domain: given.get(text.domain) or known_digits(text.domain, config.robotware)
        for _, text in present
    }
    missing = [_unknown(config, domain) for domain, known in digits.items() if known is None]
    if missing:
        raise DiagnosticError(missing)
    return tuple((n, replace(t, version=digits[t.domain] or t.version)) for n, t in present)


def _firewall(config: RobotConfig) -> CfgText:
    """Return the firewall rule for RAPID's sockets on RobotWare 7.

    Its WAN counts as a public net. The instance exists on every controller: loading replaces it
    (files that ABB ships, backups of 7.5 and 7.6).
    """
    public = config.bind not in ("service", _SERVICE_PORT)
    rule = Instance(
        (
            Attribute("Name", ("RapidSockets",)),
            Attribute("EnableOnPrivateNet"),
            *((Attribute("EnableOnPublicNet"),) if public else ()),
        )
    )
    return CfgText("SIO", (7, 0), (Section("FIREWALL_MANAGEMENT", (rule,)),))


def _unknown(config: RobotConfig, domain: str) -> Diagnostic:
    major, minor = config.robotware
    return error(
        "RG105",
        None,
        f"the first line of {domain}.cfg is not known for RobotWare {major}.{minor:02d}",
        f"it is the first line of SYSPAR/{domain}.cfg in a backup of the controller (or save "
        f"the parameters from RobotStudio, Controller, Configuration): if that reads "
        f"'{domain}:CFG_1.0:{major}:0::', write "
        f'`controller: {{cfg_header: {{{domain}: "{major}:0"}}}}`',
        notes=(
            "a file with other digits is refused by the controller (event 120003)",
            "known without it: 5.15, 5.61, and every RobotWare 6 and 7",
        ),
    )
