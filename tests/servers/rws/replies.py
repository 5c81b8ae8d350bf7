"""Replies of every RWS operation, kept in replies.json.

Run `python -m tests.servers.rws.replies` after an intended change. Every GET is sent for names that
exist and for names that do not, and every other operation without its parameters. What depends on
the moment or the folder is masked.
"""

import json
import re
import sys
import tempfile
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from served import Caller, make_application, make_runner

from rapidgen.servers.rws import application
from rapidgen.wire.rws import media
from rapidgen.wire.rws.bodies import Generation

KEPT = Path(__file__).with_name("replies.json")
GENERATIONS = (Generation.ONE, Generation.TWO)
NAMES = {
    **{"task": "T_ROB1", "module": "MainModule", "symbol": "T_ROB1/MainModule/x", "unit": "ROB_1"},
    **{"axis": "1", "signal": "doDefault", "device": "DRV_1", "network": "DRV_1", "queue": "queue"},
    **{"type": "CAB_TASKS", "instance": "T_ROB1", "count": "0", "number": "1", "path": "$HOME"},
    **{"parameter": "p", "stack": "RAPID/T_ROB1/1", "variable": "ctrl", "group": "1", "id": "1"},
    "resource": "/rw/panel/speedratio",
}
DOMAINS = {"/rw/cfg": "SYS", "/rw/elog": "0", "/rw/mastership": "motion"}
LEFT_OUT = re.compile(r"restart$|emergency-stop|/logout|/rw/retcode|clock$")
"""Operations that end the session or the controller, a list of codes, the time of day."""
MASKS = (
    (re.compile(r"\d{4}-\d\d-\d\d[ T].{0,2}\d\d:\d\d:\d\d"), "TIME"),
    (re.compile(r"\{?[0-9A-Fa-f]{8}(-[0-9A-Fa-f]{4}){3}-[0-9A-Fa-f]{12}\}?"), "GUID"),
)
LONGEST = 4
"""Number of items of a reply that are kept; the others count in a checksum."""


def replies(generation, folder):
    """Return what each request is answered with: status, and code or items."""
    result = {}
    with make_runner(folder, generation) as runner:
        caller = Caller(make_application(runner, generation))
        routes = [
            route for operation, _ in application.served() if (route := operation.route(generation))
        ]
        routes = sorted(
            (route for route in routes if not LEFT_OUT.search(route.path)),
            key=lambda route: (route.method != "GET", route.path, route.selector, route.method),
        )
        for route in routes:
            domain = next((d for p, d in DOMAINS.items() if route.path.startswith(p)), "x")
            existing = {**NAMES, "domain": domain}
            missing = dict.fromkeys(existing, "none")
            for names in (missing,) if route.method == "DELETE" else (existing, missing):
                target = route.fill(names)
                if "{" in target:
                    continue
                # RWS 1.0 rejects more requests a second than controllers serve.
                runner.controller.run_for(0.1)
                reply = caller.send(route.method, target)
                replied = shown(reply, str(folder))
                # The contents of the cfg database have tests of their own.
                kept = replied[:2] if "/rw/cfg" in target else replied
                result[f"{route.method} {target}"] = kept
    return result


def shown(reply, folder):
    kind = reply.header("content-type")
    if not reply.body or not ("json" in kind or "xml" in kind):
        return [reply.status, masked(reply.body.decode("latin-1"), folder)]
    read = media.read(reply.body, kind)
    if read.fault is not None:
        return [reply.status, read.fault.code]
    items = [masked(" ".join(texts_of(item)), folder) for item in read.items]
    rest = "".join(items[LONGEST:]).encode()
    kept = [*items[:LONGEST], *([zlib.crc32(rest)] if rest else [])]
    return [reply.status, read.title, read.next, read.collection, *read.links, len(items), *kept]


def texts_of(item):
    """Everything in an item: links show where the folder of a resource is."""
    inside = [" ".join(texts_of(inner)) for inner in item.within]
    named = [f"{name}={value!r}" for name, value in (*item.fields.items(), *item.links.items())]
    return [item.kind, repr(item.title), *named, *inside]


def masked(text, folder):
    text = text.replace(folder, "FOLDER")
    for pattern, name in MASKS:
        text = pattern.sub(name, text)
    return text


def main() -> None:
    """Write replies.json."""
    made = {}
    for generation in GENERATIONS:
        with tempfile.TemporaryDirectory() as folder:
            made[generation.name] = replies(generation, Path(folder))
    KEPT.write_text(json.dumps(made, indent=1, sort_keys=True) + "\n")


if __name__ == "__main__":
    main()
