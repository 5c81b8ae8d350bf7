"""`sim` as an address: the simulator that runs on this machine for this user."""

import logging

from rapidgen._simulator_registry import Simulator, running
from rapidgen.client.address import Address, parse_address
from rapidgen.client.errors import InvalidTarget, fault
from rapidgen.config import shipped_names

SIMULATOR = "sim"
"""The word for it, where an address is asked for."""
_LOG = logging.getLogger("rapidgen.client")


def find_simulator(name: str = "", group: str = "") -> Address:
    """Address of a motion group of the simulator with a robot's name; without one, of the only one.

    What simulators left behind that ended without a word is removed and logged. Raises
    InvalidTarget RG642.
    """
    found, left = running()
    for path in left:
        _LOG.warning("%s was left behind by a simulator that ended without a word: removed", path)
    own = [one for one in found if name in ("", one.name)]
    if len(own) != 1:
        raise _unclear(name, own, found)
    (simulator,) = own
    addresses = simulator.addresses
    if not group and len(addresses) == 1:
        (group,) = addresses
    if group not in addresses:
        said = f"no motion group '{group}'" if group else "several motion groups, or none"
        raise InvalidTarget(
            fault(
                "RG642",
                f"the simulator of '{simulator.name}' has {said}",
                f"--group {' or '.join(addresses)}" if addresses else "it serves no driver",
            ),
            exit_code=2,
        )
    return parse_address(addresses[group])


def _unclear(name: str, own: list[Simulator], found: list[Simulator]) -> InvalidTarget:
    shown = tuple(f"{one.name} (process {one.pid}): {_places(one)}" for one in own or found)
    if own:
        message, mend = f"{len(own)} simulators run", "end the others, or say --to with an address"
    elif found:
        message = f"no simulator of '{name}' runs, but others do"
        mend = f"`rapidgen sim` with the configuration of '{name}', or the other configuration here"
    else:
        message = "no simulator of yours runs on this machine"
        # The name is a robot's; only that of a shipped model starts a simulator, too.
        config = name if name in shipped_names() else "CONFIG"
        mend = f"`rapidgen sim {config} --ports auto` in another terminal"
    return InvalidTarget(fault("RG642", message, mend, *shown), exit_code=1)


def _places(simulator: Simulator) -> str:
    return ", ".join(simulator.addresses.values()) or "no driver's ports"
