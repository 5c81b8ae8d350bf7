"""STOP on the wire before anything else is imported.

`rapidgen stop` sends it from here first and then goes its whole way: checks what was said, sends
STOP again, waits until the robot stands, and reports. What is not understood here at a glance is
left to that way: nothing is guessed.
"""

import os
import re
import socket
from collections.abc import Sequence
from contextlib import suppress
from struct import pack

STOP = pack("<5i12f", 64, 11, 2, 0, -4, *[0.0] * 12)
"""JOINT_TRAJ_PT as a request, sequence -4; a test compares it with the codec's."""
_CONNECT = 2.0
_ANSWER = 1.0
"""s for the connection, and for the answer: hung up on at once, a STOP may be lost unread."""
_MOTION = 11000
_STEP = 10
_ONE = "rob1"
"""A group that nobody named."""
_OURS = ("groups", "ports", "model")
_ADDRESS = re.compile(r"(\[[0-9A-Fa-f:.]+\]|[\w.-]+)(?::(\d{1,5})(?:,\d{1,5}){0,2})?", re.ASCII)
_LINE = re.compile(r"( *)(\w+):(?: +(.*?))?(?: +#.*)? *")
_FLOW = re.compile(r"\{ *(?:\w+: *\d{1,5} *(?:, *\w+: *\d{1,5} *)*)?\}")
_PAIR = re.compile(r"(\w+): *(\d{1,5})")

Keys = dict[tuple[str, ...], str]


def send(words: Sequence[str]) -> None:
    """Send STOP to the motion ports that the words behind `stop` name; says nothing."""
    links = []
    for host, port in addresses(words):
        try:
            link = socket.create_connection((host, port), _CONNECT)
            links.append(link)
            link.sendall(STOP)
        except TimeoutError:
            # The others are at the same host.
            break
        except (OSError, UnicodeError):
            # Refused: perhaps another group is there. The whole way tells what was wrong.
            continue
    for link in links:
        with link, suppress(OSError):
            link.settimeout(_ANSWER)
            link.recv(64)


def addresses(words: Sequence[str]) -> list[tuple[str, int]]:
    """Host and motion port of every group meant; none where that takes more than a glance."""
    told: dict[str, str] = {}
    rest = list(words)
    while rest:
        word = rest.pop(0)
        name, equals, value = word.partition("=")
        if name in ("--to", "--group"):
            value = value if equals else rest.pop(0) if rest else ""
        elif word.startswith("-") and word not in ("--json", "--rad"):
            return []
        elif not word.startswith("-"):
            name, value = "target", word
        if name in told:
            return []
        told[name] = value
    return _places(told.get("target", ""), told.get("--to", ""), told.get("--group", ""))


def _places(target: str, to: str, group: str) -> list[tuple[str, int]]:
    if target == "sim":
        return [] if to or group else _simulated([])
    is_file = target.endswith((".yaml", ".yml"))
    if not is_file and not os.path.isfile(_shipped(target)):
        return [] if to or group else _at(target, [_MOTION])
    ports = motion_ports(target if is_file else _shipped(target))
    if group:
        ports = {name: port for name, port in ports.items() if name == group}
    if to == "sim":
        return _simulated(list(ports)) if ports else []
    return _at(to or "127.0.0.1", list(ports.values()))


def _at(address: str, ports: list[int]) -> list[tuple[str, int]]:
    hit = _ADDRESS.fullmatch(address)
    if hit is None:
        return []
    wanted = [int(hit[2])] if hit[2] else ports
    return [(hit[1].strip("[]"), port) for port in wanted if 0 < port < 65_536]


def _simulated(groups: list[str]) -> list[tuple[str, int]]:
    from rapidgen._running import running

    found, _ = running()
    if len(found) != 1:
        return []
    told = found[0].addresses
    return [place for name in groups or told if name in told for place in _at(told[name], [])]


def _shipped(name: str) -> str:
    from rapidgen._data import data_folder

    return f"{data_folder('robots')}/{name}.yaml" if re.fullmatch(r"\w+", name) else ""


def motion_ports(path: str) -> dict[str, int]:
    """The motion port of every group of a configuration; none where that takes a closer look."""
    keys = _keys(path)
    groups = list(dict.fromkeys(names[1] for names in keys or {} if names[0] == "groups"))
    ports: dict[str, int] = {}
    for index, group in enumerate(groups):
        text = (keys or {}).get(("groups", group, "ports", "motion"), str(_MOTION + _STEP * index))
        if re.fullmatch(r"\d{1,5}", text) is None:
            return {}
        ports[group] = int(text)
    return ports


def _keys(path: str) -> Keys | None:
    """The keys of a configuration over those of its model, all below `groups`."""
    try:
        with open(path, encoding="utf-8") as file:
            keys = read_keys(file.read(1_000_000))
    except (OSError, ValueError):
        return None
    if keys is None:
        return None
    below: Keys | None = {}
    model = _shipped(keys.pop(("model",), ""))
    if model:
        # A model without a file of its own is one arm.
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
    """Groups, ports and model by their path, of YAML that is written line by line."""
    found: Keys = {}
    path: list[tuple[int, str]] = []
    for line in text.splitlines():
        bare = line.lstrip(" ")
        if not bare or bare.startswith("#"):
            continue
        hit = _LINE.fullmatch(line)
        if hit is None:
            # Texts and lists are somebody else's, below a key; a group has none of that.
            if line == bare or (path[0][1] in _OURS and not bare.startswith("- ")):
                return None
            continue
        depth, key, value = len(hit[1]), hit[2], hit[3] or ""
        path = [(d, k) for d, k in path if d < depth] + [(depth, key)]
        names = tuple(k for _, k in path)
        if names[0] not in _OURS or names == ("groups",) or len(names) > 4:
            if names == ("groups",) and value:
                return None
            continue
        is_group = names[0] == "groups"
        if names in found or (is_group and len(names) == 2 and value):
            return None
        if names[-1] == "ports" and value:
            if _FLOW.fullmatch(value) is None:
                return None
            found |= {(*names, name): number for name, number in _PAIR.findall(value)}
            value = ""
        if not is_group or len(names) == 2 or names[2] == "ports":
            found[names] = value
    return found
