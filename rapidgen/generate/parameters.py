"""The cfg files of a build, loaded in addition to the controller's.

Rows that no controller's file was seen to have go into files of their own, `*_open.cfg`: a
controller may reject them as a whole, and the driver works without them.
"""

from dataclasses import replace

from rapidgen.config.model import EgmSettings, RobotConfig
from rapidgen.diagnostics import Diagnostic, DiagnosticError, error
from rapidgen.generate.layout import open_signals
from rapidgen.system import Attribute, CfgText, Instance, Section, System, eio_cfg, sys_cfg
from rapidgen.system.releases import known_digits

UDP_SECTIONS = ("COM_TRP", "UDPUC_HOST")
"""SIO section of UdpUc devices before RobotWare 7, and from then on."""
REMOTE_ADDRESS = ("RemoteAdress", "RemoteAddress")
"""Its attribute with the address of the partner."""
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
    texts.append(("SIO.cfg", CfgText("SIO", (7, 0), (*_firewall(config), *_devices(config)))))
    texts.append(("MOC.cfg", CfgText("MOC", (7, 0), _profiles(config))))
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


def _firewall(config: RobotConfig) -> tuple[Section, ...]:
    """Return the firewall rules of RobotWare 7, for RAPID's sockets and for EGM.

    Its WAN counts as a public net. The instances exist on every controller: loading replaces them
    (files that ABB ships, backups of 7.5 and 7.6).
    """
    if config.robotware[0] < _FIREWALL_SINCE:
        return ()
    public = config.bind not in ("service", _SERVICE_PORT)
    services = ("RapidSockets", "UDPUC") if _guided(config) else ("RapidSockets",)
    rules = (
        Instance(
            (
                Attribute("Name", (name,)),
                Attribute("EnableOnPrivateNet"),
                *((Attribute("EnableOnPublicNet"),) if public else ()),
            )
        )
        for name in services
    )
    return (Section("FIREWALL_MANAGEMENT", tuple(rules)),)


def _guided(config: RobotConfig) -> list[EgmSettings]:
    return [group.egm for group in config.groups if group.egm is not None]


def _devices(config: RobotConfig) -> tuple[Section, ...]:
    """Return the UdpUc devices.

    COM_TRP spells its address with one d (backups of 6.11 to 6.13; of 7.8 for UDPUC_HOST).
    """
    newer = config.robotware[0] >= _FIREWALL_SINCE
    rows = [
        Instance(
            (
                Attribute("Name", (egm.device,)),
                Attribute("Type", ("UDPUC",)),
                *(() if newer else (Attribute("PhyChannel", ("",)),)),
                Attribute(REMOTE_ADDRESS[newer], (egm.address,)),
                Attribute("RemotePortNumber", (egm.port,)),
                # 0: any port. Several devices cannot share one.
                *((Attribute("LocalPortNumber", (0,)),) if newer else ()),
            )
        )
        for egm in _guided(config)
    ]
    return (Section(UDP_SECTIONS[newer], tuple(rows)),) if rows else ()


def _profiles(config: RobotConfig) -> tuple[Section, ...]:
    """Return the external motion interface data [manual 3HAC073318 chapter 4].

    After motors off a session must not go on. Level 1 filters references.
    """
    rows = [
        Instance(
            (
                Attribute("name", (egm.device,)),
                Attribute("ext_motion_level", (1,)),
                Attribute("do_not_restart_after_motors_off"),
                Attribute("ramp_time", (egm.stop_ramp,)),
                Attribute("ext_motion_Kp", (egm.gain,)),
                Attribute("ext_motion_filter_bandwidth", (egm.filter,)),
            )
        )
        for egm in _guided(config)
    ]
    return (Section("EXT_MOTION_DATA", tuple(rows)),) if rows else ()


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
