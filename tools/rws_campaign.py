"""Send hostile answers to the RWS client, or hostile requests to the server.

    python -m tools.rws_campaign answers 10000
    python -m tools.rws_campaign requests 100000

Every answer must end in a result or a RobotError, without a password in wrong places. Every request
must be answered, none with 500, and after each thousand a well-behaved client finds the server as
strict and correct as before. The short forms are tests: `test_hostile.py`, `test_strict.py`.
"""

import argparse
import inspect
import random
import re
import sys
import tempfile
import time
from collections import Counter
from functools import cache
from itertools import count
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT / "tests" / folder) for folder in ("servers/rws", "client/rws")]

from served import Caller, make_application, make_runner  # noqa: E402
from test_hostile import FLOWS, NOWHERE, run  # noqa: E402

from rapidgen.client.rws.address import parse_address  # noqa: E402
from rapidgen.client.rws.core import Login, RwsCore  # noqa: E402
from rapidgen.servers.rws.application import served  # noqa: E402
from rapidgen.servers.rws.handlers.files import VOLUMES  # noqa: E402
from rapidgen.servers.rws.messages import HttpRequest  # noqa: E402
from rapidgen.wire.rws import media  # noqa: E402
from rapidgen.wire.rws.bodies import Generation  # noqa: E402
from rapidgen.wire.rws.operations import Route  # noqa: E402

NAMES = (
    "T_ROB1", "MainModule", "x", "list{2}", "count", "do x;1", "aoSpeed", "ROB_1", "SYS", "EIO",
    "CAB_TASKS", "EIO_SIGNAL", "$HOME", "HOME/a.txt", "$HOME/../../etc/passwd", "TEMP/b", "0", "1",
    "-1", "9" * 5000, "RMQ_T_ROB1", "queue", "RAPID/T_ROB1/%$1", "TPAnswer", "HOME/.", "DRV_1",
    "Local/DRV_1", "Other", "\u00b2", "", "%00", "%", "%zz", "a" * 5000, "{", "[1,", "\udcff",
    "..", "T_ROB1/MainModule/x", "edit", "rapid", "cfg", "motion", "{1}", "nan", "inf",
)  # fmt: skip
_READ = re.compile(r"""(?:field|form\.get)\(\s*"([\w-]+)\"""")


@cache
def fields(module: str) -> tuple[str, ...]:
    """Return the fields that handlers of a module read.

    Nameless ones are subscriptions and attributes.
    """
    result = _READ.findall(inspect.getsource(sys.modules[module]))
    return (*dict.fromkeys(result), *MORE)


MORE = ("resources", "1", "1-p", "Type", "Name", "name1", "line", "startrow", "endcol", "wobj")
WORDS = (
    *NAMES, "true", "TRUE", "FALSE", "modify", "exec", "motoron", "motoroff", "auto", "man",
    "once", "forever", "stop", "continue", "none", "normal", "create", "copy", "rename", "per",
    "block", "add", "replace", "add-with-reset", "$HOME/a.mod", "HOME/a.mod", "[1,1]",
    "[NORMAL,1]", "/fileservice/$HOME/c.cfg", "/fileservice/HOME/d", "(((((((((((((((a+)+)+)+)+",
    "/rw/iosystem/signals/aoSpeed;state", "/rw/rapid/execution;ctrlexecstate", "/rw/elog/0",
    "/rw/panel/opmode", "1e400", "1e9", "2", "[[0,0,0],[1,0,0,0]]", '"a', "'", "\r\nX: y",
    "[0,0,0,0,0,0]", "num;5", "string;\"a\"", "robtarget;[[", "tool0", "T_ROB1/MainModule/tool",
    "MODULE Other\nPROC main()\nENDPROC\nENDMODULE", "9" * 5000, "-0", "RMQ_T_ROB1", "444",
    "active", "[num", "(a+)+!", "1234", "HOME/.", "/fileservice/HOME/b/..", "off", "Before",
)  # fmt: skip
QUERIES = (
    "", "", "", "json=1", "mastership=implicit", "resource=module-text", "start=-5&limit=1e9",
    "limit=0", "start=99999", "lang=en", "task=T_ROB1", "task=", "coordinate=Tool", "order=lifo",
    "elogseqnum=-1", "code=x", "stackframe=1", "changecount=9", "resource=robtarget", "text=e",
    "startrow=1&endrow=-1", "network=Local", "dipc-timeout=-1",
    "grant=UAS_BACKUP", "&&&=", "action=set", "tool=x&wobj=y",
)  # fmt: skip
TYPES = (
    "", "*/*", "text/plain", "application/x-www-form-urlencoded", "application/octet-stream;v=2.0",
    "application/hal+json;v=2.0;", ";;;", "\u00e9",
)  # fmt: skip
# A restart boots a new controller: that takes longer than a thousand requests.
SLOW = 2.0
"""s of one request."""
MASTERSHIP = (
    "/rw/mastership/edit/request", "/rw/mastership/rapid?action=request",
    "/rw/mastership/cfg?action=request",
)  # fmt: skip
QUEUE = {"dipc-queue-name": "queue", "dipc-queue-size": "2", "dipc-max-msg-size": "444"}
RARE = ("/ctrl/restart", "action=restart")


def answers(number: int, first: int) -> int:
    """Run flows with hostile answers; return the number of failures."""
    failed, names = 0, sorted(FLOWS)
    for seed in range(first, first + number):
        name, generation = names[seed % len(names)], tuple(Generation)[seed // len(names) % 3]
        core = RwsCore(
            parse_address("rws://h"), Login(password="SECRET"), pins=NOWHERE,
            generation=generation, connected=True, clock=count(0.0, 0.5).__next__,
        )  # fmt: skip
        try:
            run(core, FLOWS[name](core), seed)
        except Exception as fault:  # noqa: BLE001 - reported, with the seed that makes it again
            print(f"seed {seed} ({name}, {generation.name}): {fault!r}", flush=True)
            failed += 1
    return failed


@cache
def _routes(generation: Generation) -> tuple[tuple[Route, str], ...]:
    """Return the routes of a generation, with the modules that serve them."""
    result = ((o.route(generation), h.__module__) for o, h in served())
    return tuple((route, module) for route, module in result if route)


def hostile(rng: random.Random, generation: Generation) -> tuple[str, str, bytes, dict[str, str]]:
    """Return a request that resembles a valid one."""
    route, module = rng.choice(_routes(generation))
    names = {name: rng.choice(NAMES) for name in route.pattern.groupindex}
    try:
        target = route.fill(names)
    except UnicodeEncodeError:
        target = route.path
    if rng.random() < 0.1:
        at = rng.randrange(len(target) + 1)
        target = (
            target[:at] + rng.choice(("%", "/", ";value", "\x00", "?", "//", "&")) + target[at:]
        )
    query = rng.choice(QUERIES)
    if query:
        target += f"{'&' if '?' in target else '?'}{query}"
    chosen = rng.sample(fields(module), rng.randrange(len(fields(module))))
    pairs = [f"{field}={rng.choice(WORDS)}" for field in chosen for _ in range(rng.choice((1, 2)))]
    body = "&".join(pairs).encode("utf-8", "surrogatepass")
    if rng.random() < 0.1:
        body = rng.randbytes(rng.randrange(200))
    method = route.method if rng.random() < 0.9 else rng.choice(("GET", "PUT", "OPTIONS", "X"))
    headers = {}
    if rng.random() < 0.1:
        headers = {"accept": rng.choice(TYPES), "content_type": rng.choice(TYPES)}
    return method, target, body, headers


def requests(number: int, first: int) -> int:
    """Send hostile requests to each generation; return the failures."""
    failed = 0
    statuses: Counter[int] = Counter()
    for generation in Generation:
        with (
            tempfile.TemporaryDirectory() as folder,
            make_runner(Path(folder), generation) as runner,
        ):
            desk = make_application(runner, generation)
            desk.sessions.is_too_fast = lambda: False
            runner.controller.operator.ask("T_ROB1", "TPReadFK", "how many?", ("1", "2"), int)
            for seed in range(first, first + number // 3):
                rng = random.Random(seed)
                method, target, body, headers = hostile(rng, generation)
                if any(word in target for word in RARE):
                    continue
                caller = Caller(desk)
                for path in rng.sample(MASTERSHIP, rng.randrange(3)):
                    caller.post(path)
                caller.post(f"/rw/dipc{'?action=dipc-create' if caller.is_one else ''}", QUEUE)
                status, wrong = _sent(caller, (method, target, body, headers))
                statuses[status] += 1
                if wrong:
                    failed += 1
                    print(f"seed {seed} ({generation.name}) {method} {target[:200]}", flush=True)
                    print(f"    {body[:200]!r}: {wrong}", flush=True)
                desk.sessions.end(caller.session)
                if seed % 1000 == 999:
                    failed += _is_worse(desk)
    print(dict(sorted(statuses.items())))
    return failed


def _sent(caller: Caller, request: tuple[str, str, bytes, dict[str, str]]) -> tuple[int, str]:
    """Return a request's status and fault, also without a session."""
    method, target, body, headers = request
    started = time.perf_counter()
    try:
        status = caller.send(method, target, body=body, **headers).status
        caller.application.handle(HttpRequest(method, target, {"authorization": target}, body))
    except Exception as fault:  # noqa: BLE001 - reported, with the seed that makes it again
        return 0, repr(fault)
    if time.perf_counter() - started > SLOW:
        return status, f"it took {time.perf_counter() - started:.1f} s"
    broken = status == 500 and not target.startswith("/users/rmmp")
    return status, f"status {status}" if broken else ""


def _is_worse(desk) -> bool:
    """True if a well-behaved client no longer gets correct answers."""
    good = Caller(desk, "Admin")
    reply = good.send("GET", "/rw/system")
    fine = reply.status == 200 and media.read(reply.body, reply.header("content-type")).items
    fine = fine and all(good.send("GET", f"/fileservice/{v}").status == 200 for v in VOLUMES)
    desk.sessions.end(good.session)
    if not fine:
        print("a good client is refused")
    return not fine


def main(what: str, number: int, first: int) -> int:
    """Return 1 if there was a failure."""
    started = time.process_time()
    failed = {"answers": answers, "requests": requests}[what](number, first)
    spent = time.process_time() - started
    print(f"{number} {what}, {failed} failed, {spent:.0f} s of CPU")
    return int(failed > 0)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=("answers", "requests"))
    parser.add_argument("number", type=int)
    parser.add_argument("first", type=int, nargs="?", default=0)
    given = parser.parse_args()
    sys.exit(main(given.what, given.number, given.first))
