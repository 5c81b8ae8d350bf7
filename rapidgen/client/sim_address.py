"""`sim` as an address: this user's running simulator on this machine."""

import logging

from rapidgen._simulator_registry import Simulator, running
from rapidgen.client.address import Address, parse_address
from rapidgen.client.errors import InvalidTarget, fault
from rapidgen.config import shipped_names

SIMULATOR = "sim"
"""Keyword accepted as an address."""
_LOG = logging.getLogger("rapidgen.client")


def find_simulator(name: str = "", group: str = "") -> Address:
    """Return the address of a motion group of a running simulator.

    It is found by its robot's name, or without a name if only one runs. Entries of simulators that
    were killed are removed and logged. Raises InvalidTarget RG642.
    """
    result, left = running()
    for path in left:
        _LOG.warning("removed the entry %s of a simulator that no longer runs", path)
    own = [one for one in result if name in ("", one.name)]
    if len(own) != 1:
        raise _unclear(name, own, result)
    (simulator,) = own
    addresses = simulator.addresses
    if not group and len(addresses) == 1:
        (group,) = addresses
    if group not in addresses:
        message = f"no motion group '{group}'" if group else "several motion groups, or none"
        raise InvalidTarget(
            fault(
                "RG642",
                f"the simulator of '{simulator.name}' has {message}",
                f"--group {' or '.join(addresses)}" if addresses else "it serves no driver",
            ),
            exit_code=2,
        )
    return parse_address(addresses[group])


def find_web_services() -> Simulator:
    """Return the only running simulator that serves Robot Web Services.

    Raises InvalidTarget RG642.
    """
    result, _ = running()
    own = [one for one in result if one.web_services]
    if len(own) == 1:
        return own[0]
    if own or not result:
        raise _unclear("", own, result)
    displayed = tuple(f"{one.name} (process {one.pid})" for one in result)
    message = "no simulator of yours serves Robot Web Services"
    help = "add --rws 1 (RobotWare 6) or --rws 2 (RobotWare 7) to `rapidgen sim`"
    raise InvalidTarget(fault("RG642", message, help, *displayed), exit_code=1)


def _unclear(name: str, own: list[Simulator], result: list[Simulator]) -> InvalidTarget:
    displayed = tuple(f"{one.name} (process {one.pid}): {_places(one)}" for one in own or result)
    if own:
        message, help = f"{len(own)} simulators run", "end the others, or add --to with an address"
    elif result:
        message = f"no simulator of '{name}' runs, but others do"
        help = f"`rapidgen sim` with the configuration of '{name}', or the other configuration here"
    else:
        message = "no simulator of yours runs on this machine"
        # The name is that of a robot; only a shipped model's name starts a simulator too.
        config = name if name in shipped_names() else "CONFIG"
        help = f"`rapidgen sim {config} --ports auto` in another terminal"
    return InvalidTarget(fault("RG642", message, help, *displayed), exit_code=1)


def _places(simulator: Simulator) -> str:
    return ", ".join(simulator.addresses.values()) or "no driver's ports"
