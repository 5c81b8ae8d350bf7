"""Resolution of a connection target: configuration, name or address."""

from os import PathLike

from rapidgen.client.address import LOOPBACK, Address, parse_address
from rapidgen.client.core.group import Group
from rapidgen.client.errors import InvalidTarget
from rapidgen.client.sim_address import SIMULATOR, find_simulator
from rapidgen.config import load_config, shipped_names
from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.diagnostics import DiagnosticError, suggest

_SUFFIXES = (".yaml", ".yml")


def resolve(
    target: "str | PathLike[str] | RobotConfig", address: str | Address | None, group: str
) -> tuple[Address, Group | None]:
    """Return address and known data of a target (None: ask the driver).

    A RobotConfig, a path that ends in .yaml, or a shipped name is a configuration; its robot is
    expected at `address`, else on this machine. Any other text is an address. `sim` as an address
    is the running simulator. Raises InvalidTarget.
    """
    if not isinstance(address, str | Address | None):
        raise _no_text(address, "address", "HOST, HOST:MOTION,STATE, or `sim`")
    if isinstance(target, RobotConfig):
        config = target
    elif not isinstance(target, str | PathLike):
        raise _no_text(target, "target", "a configuration's path, a shipped name, or an address")
    else:
        text = str(target)
        if not (text.endswith(_SUFFIXES) or text in shipped_names()):
            if address is not None or group:
                raise InvalidTarget.because(
                    "RG607",
                    f"'{text}' is no configuration and no shipped name",
                    suggest(text, shipped_names()) or "`rapidgen robots` lists the names",
                    exit_code=2,
                )
            if text == SIMULATOR:
                return find_simulator(), None
            return _by_name(text), None
        try:
            config = load_config(text)
        except DiagnosticError as error:
            raise InvalidTarget(error.diagnostics, exit_code=error.exit_code) from error
    chosen = _group(config, group)
    if isinstance(address, Address):
        return address, Group.of(config, chosen)
    if address == SIMULATOR:
        return find_simulator(config.name, chosen.name), Group.of(config, chosen)
    return parse_address(address or LOOPBACK, chosen.ports), Group.of(config, chosen)


def configuration_of(target: "str | PathLike[str] | RobotConfig") -> RobotConfig | None:
    """Return the configuration of a target that `resolve` accepts; None for an address."""
    if isinstance(target, RobotConfig):
        return target
    text = str(target)
    return load_config(text) if text.endswith(_SUFFIXES) or text in shipped_names() else None


def _no_text(value: object, what: str, help: str) -> InvalidTarget:
    message = f"the {what} is a text, not {type(value).__name__}"
    return InvalidTarget.because("RG607", message, help, exit_code=2)


def _by_name(text: str) -> Address:
    """Resolve an address; reject a host name close to a model's name.

    Raises InvalidTarget RG607.
    """
    meant = suggest(text, shipped_names()) if "." not in text and ":" not in text else ""
    if meant:
        raise InvalidTarget.because(
            "RG607",
            f"'{text}' is no configuration and no shipped name",
            f"{meant}; a host of this name is {text}:11000",
            exit_code=2,
        )
    return parse_address(text)


def groups_of(target: str) -> list[str]:
    """Motion groups of a configuration; one without a name for an address."""
    if target.endswith(_SUFFIXES) or target in shipped_names():
        return [group.name for group in load_config(target).groups]
    return [""]


def _group(config: RobotConfig, name: str) -> GroupConfig:
    names = [group.name for group in config.groups]
    if not name and len(names) == 1:
        return config.groups[0]
    for group in config.groups:
        if group.name == name:
            return group
    message = f"'{config.name}' has no motion group '{name}'" if name else "which motion group?"
    raise InvalidTarget.because(
        "RG608", message, suggest(name, names) or f"the groups are: {', '.join(names)}", exit_code=2
    )
