"""Send STOP before anything else is imported.

`rapidgen stop` first sends STOP from here, to the motion and the control port at once. The command
then checks its arguments, sends STOP again, waits until the robot has stopped, and reports. This
module does not guess: arguments and files that it does not fully understand are left to the
command.
"""

import os
import re
import select
import socket
import time
from collections.abc import Sequence
from contextlib import suppress
from struct import pack

from rapidgen._reading import read_foreign

STOP = pack("<5i12f", 64, 11, 2, 0, -4, *[0.0] * 12)
"""JOINT_TRAJ_PT as a request, sequence -4; a test compares it with the codec's."""
_CONNECT = 2.0
_OTHERS = 0.25
_ANSWER = 1.0
"""Seconds for the first connection, for further ones, and for the reply: if the connection closes
at once, the controller may lose the STOP unread."""
_PORTS = (11000, 11002, 11001)
"""Motion, state, control."""
_STEP = 10
_ONE = "rob1"
"""Default name of the only group."""
_KEYS_READ = ("groups", "ports", "model")
_ADDRESS = re.compile(
    r"(\[[0-9A-Fa-f:.]+\]|[\w.-]+)(?::(\d{1,5})(?:,(\d{1,5})(?:,(\d{1,5}))?)?)?", re.ASCII
)
_LINE = re.compile(r"( *)(\w+):(?: +(.*?))?(?: +#.*)? *")
_FLOW = re.compile(r"\{ *(?:\w+: *\d{1,5} *(?:, *\w+: *\d{1,5} *)*)?\}")
_PAIR = re.compile(r"(\w+): *(\d{1,5})")

Keys = dict[tuple[str, ...], str]
Ports = tuple[int, int, int]
"""Motion, state and control port of a group; control 0: none or unknown."""
Place = tuple[str, Ports]


def send(text: Sequence[str]) -> None:
    """Send STOP to all ports that the arguments of `stop` name, at once and without output.

    A port that does not answer delays no other. The command reports errors afterwards.
    """
    opening = [
        link
        for host, port in (*addresses(text), *control_addresses(text))
        for link in _opening(host, port)
    ]
    links, requested = [*opening], list[socket.socket]()
    until = time.monotonic() + _CONNECT
    hung_up = until + _ANSWER
    while opening or requested:
        now = time.monotonic()
        if now >= until:
            opening = []
        if now >= hung_up or not (opening or requested):
            break
        end = until if opening else hung_up
        answered, open_now, _ = select.select(requested, opening, [], max(0.0, end - now))
        for link in open_now:
            opening.remove(link)
            with suppress(OSError):
                link.send(STOP)
                requested.append(link)
                until = min(until, time.monotonic() + _OTHERS)
                hung_up = time.monotonic() + _ANSWER
        requested = [link for link in requested if link not in answered]
    for link in links:
        link.close()


def _opening(host: str, port: int) -> list[socket.socket]:
    """Begin a connection to each address of a host."""
    result = []
    with suppress(OSError, UnicodeError):
        for family, kind, protocol, _, address in socket.getaddrinfo(
            host, port, type=socket.SOCK_STREAM
        ):
            link = socket.socket(family, kind, protocol)
            result.append(link)
            link.setblocking(False)
            link.connect_ex(address)
    return result


def addresses(text: Sequence[str]) -> list[tuple[str, int]]:
    """Return host and motion port of each group; none if the arguments are not simple."""
    return [(host, ports[0]) for host, ports in _places(text)]


def control_addresses(text: Sequence[str]) -> list[tuple[str, int]]:
    """Return host and control port of each group that is known to have one."""
    return [(host, ports[2]) for host, ports in _places(text) if ports[2]]


def _places(words: Sequence[str]) -> list[Place]:
    text: dict[str, str] = {}
    remaining = list(words)
    while remaining:
        word = remaining.pop(0)
        name, equals, value = word.partition("=")
        if name in ("--to", "--group"):
            value = value if equals else remaining.pop(0) if remaining else ""
        elif word.startswith("-") and word not in ("--json", "--rad"):
            return []
        elif not word.startswith("-"):
            name, value = "target", word
        if name in text:
            return []
        text[name] = value
    return _groups(text.get("target", ""), text.get("--to", ""), text.get("--group", ""))


def _groups(target: str, to: str, group: str) -> list[Place]:
    if target == "sim":
        return [] if to or group else _simulated([])
    is_file = target.endswith((".yaml", ".yml"))
    if not is_file and not os.path.isfile(_shipped(target)):
        return [] if to or group else _at(target, [_PORTS])
    ports = group_ports(target if is_file else _shipped(target))
    if group:
        ports = {name: three for name, three in ports.items() if name == group}
    if to == "sim":
        return _simulated(list(ports)) if ports else []
    return _at(to or "127.0.0.1", list(ports.values()))


def _at(address: str, ports: list[Ports]) -> list[Place]:
    hit = _ADDRESS.fullmatch(address)
    if hit is None:
        return []
    requested = [_addressed(ports[0] if len(ports) == 1 else _PORTS, hit)] if hit[2] else ports
    return [(hit[1].strip("[]"), three) for three in requested if 0 < three[0] < 65_536]


def _addressed(own: Ports, hit: re.Match[str]) -> Ports:
    """Return the ports of an address; defaults as in `parse_address`."""
    motion = int(hit[2])
    state = int(hit[3]) if hit[3] else motion + 2
    moved = motion - own[0]
    if hit[4]:
        control = int(hit[4])
    else:
        control = own[2] + moved if own[2] and state - own[1] == moved else 0
    return motion, state, control if 0 < control < 65_536 else 0


def _simulated(groups: list[str]) -> list[Place]:
    from rapidgen._simulator_registry import running

    result, _ = running()
    if len(result) != 1:
        return []
    text = result[0].addresses
    return [place for name in groups or text if name in text for place in _at(text[name], [_PORTS])]


def _shipped(name: str) -> str:
    from rapidgen._data import data_folder

    return f"{data_folder('robots')}/{name}.yaml" if re.fullmatch(r"\w+", name) else ""


def motion_ports(path: str) -> dict[str, int]:
    """Return the motion port of each group; none if the configuration is not simple."""
    return {name: ports[0] for name, ports in group_ports(path).items()}


def group_ports(path: str) -> dict[str, Ports]:
    """Return the ports of each group; none if the configuration is not simple."""
    keys = _keys(path) or {}
    groups = list(dict.fromkeys(names[1] for names in keys if names[0] == "groups"))
    result: dict[str, Ports] = {}
    for index, group in enumerate(groups):
        texts = [
            keys.get(("groups", group, "ports", name), str(default + _STEP * index))
            for name, default in zip(("motion", "state", "control"), _PORTS, strict=True)
        ]
        if not all(re.fullmatch(r"\d{1,5}", text) for text in texts):
            return {}
        motion, state, control = map(int, texts)
        result[group] = motion, state, control
    return result


def _keys(path: str) -> Keys | None:
    """Merge the keys of a configuration over those of its model, all below `groups`."""
    try:
        keys = read_keys(read_foreign(path, 1_000_000).decode())
    except (OSError, ValueError):
        return None
    if keys is None:
        return None
    below: Keys | None = {}
    model = _shipped(keys.pop(("model",), ""))
    if model:
        # A model without a file is one arm.
        below = _keys(model) if os.path.isfile(model) else {("groups", _ONE): ""}
    if below is None:
        return None
    groups = list(dict.fromkeys(n[1] for n in (*below, *keys) if n[0] == "groups"))
    if len(groups) > 1 and any(names[0] == "ports" for names in keys):
        return None
    above: Keys = {("groups", name): "" for name in groups or (_ONE,)}
    only = next(names[1] for names in above)
    for names, value in keys.items():
        above[names if names[0] == "groups" else ("groups", only, *names)] = value
    return {**below, **above}


def read_keys(text: str) -> Keys | None:
    """Read groups, ports and model by their path from simple YAML, line by line."""
    result: Keys = {}
    path: list[tuple[int, str]] = []
    for line in text.splitlines():
        bare = line.lstrip(" ")
        if not bare or bare.startswith("#"):
            continue
        hit = _LINE.fullmatch(line)
        if hit is None:
            # Texts and lists below other keys are skipped; a group contains none.
            if line == bare or (path[0][1] in _KEYS_READ and not bare.startswith("- ")):
                return None
            continue
        depth, key, value = len(hit[1]), hit[2], hit[3] or ""
        path = [(d, k) for d, k in path if d < depth] + [(depth, key)]
        names = tuple(k for _, k in path)
        if names[0] not in _KEYS_READ or names == ("groups",) or len(names) > 4:
            if names == ("groups",) and value:
                return None
            continue
        is_group = names[0] == "groups"
        if names in result or (is_group and len(names) == 2 and value):
            return None
        if names[-1] == "ports" and value:
            if _FLOW.fullmatch(value) is None:
                return None
            result |= {(*names, name): number for name, number in _PAIR.findall(value)}
            value = ""
        if not is_group or len(names) == 2 or names[2] == "ports":
            result[names] = value
    return result
