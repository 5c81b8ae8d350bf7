"""A deployment that is cut at a request, and then somebody restarts the controller.

What boots is the old set, the new one, or one that does not move; the next run, of whichever kind,
puts it right. Some of the kinds of requests that change something are cut once each; RAPIDGEN_LONG
takes every request, before and after it was done.
"""

import os
import re
from contextlib import nullcontext, suppress

import pytest

from rapidgen.deploy.session import earlier_set
from rapidgen.diagnostics import DiagnosticError
from rapidgen.wire.rws.bodies import Generation

LONG = bool(os.environ.get("RAPIDGEN_LONG"))


def kinds(log):
    """Numbers of the requests to cut at: of each kind of change the first, and the last ones."""
    found = {}
    for number, (method, target) in enumerate(log, 1):
        if LONG:
            found[number] = number
        elif method != "GET":
            plain = re.sub(
                r"(fileservice|instances|tasks|modules)/[^?]*?(/\w+)?(?=\?|$)", r"\1\2", target
            )
            found.setdefault((method, plain), number)
    return sorted(found.values())


def restarted(cabinet, rws):
    cabinet.ask_restart()
    rws.pass_time(cabinet, 1.0)


def verdict(cabinet, *sets):
    """'empty', 'set 0', ... or 'refuses'; 'MIXED' must never be. Not by the code in test."""
    tasks = cabinet.controller.rapid_tasks
    programs = cabinet.programs
    lying = {n: {m.name for m in programs.modules(t)} for n, t in tasks.items()}
    texts = [programs.text(t, m) or "" for n, t in tasks.items() for m in lying[n]]
    known = "|".join(["incomplete--", *(wanted.build_id for wanted in sets)])
    ids = {i for text in texts for i in re.findall(f'"({known})"', text)}
    faulty = any(programs.faults(t) or t.state == "empty" for t in tasks.values())
    if not ids and lying["T_ROB1"] <= {"MainModule"}:
        return "empty"  # a task without modules does nothing
    for number, wanted in enumerate(sets):
        expected = {}
        for file in wanted.files:
            name = re.search(rb"MODULE (\w+)", file.data)
            for task in file.tasks if file.kind == "module" else ():
                expected.setdefault(task, set()).add(name[1].decode())
        if lying == expected and ids == {wanted.build_id} and not faulty:
            return f"set {number}"
    moves = "ROS_motion" in lying["T_ROB1"]  # without it there is nobody who could
    return "MIXED" if moves and not faulty and len(ids) == 1 else "refuses"


def attempt(function, *args):
    """What it was refused with, or None."""
    try:
        function(*args)
    except DiagnosticError as error:
        return error
    return None


def run_cut(rws, generation, folder, case, cut, how):
    """Cut one run; then restart, judge, and put it right. The log of requests."""
    old, new = rws.build(generation), rws.build(generation, "trajectory.capacity=500")
    folder.mkdir()
    with rws.empty_cabinet(folder, generation) as cabinet:
        empty = rws.home_of(cabinet), rws.cfg_of(cabinet)
        before = {"first": [], "rollback": [old, new]}.get(case, [old])
        for wanted in before:
            rws.run(rws.connect(rws.Line(cabinet, generation)), wanted)
        line = rws.Line(cabinet, generation, cut=cut, how=how)
        wanted = {"first": old, "update": new}.get(case)
        verb = case if case in ("uninstall", "rollback") else "deploy"
        with suppress(DiagnosticError) if cut else nullcontext():
            transport = rws.connect(line)
            if case == "rollback":
                wanted = earlier_set(transport, "", None)
            rws.run(transport, wanted, verb)
        if not cut:
            return line.log
        restarted(cabinet, rws)
        assert verdict(cabinet, old, new) != "MIXED"
        transport = rws.connect(rws.Line(cabinet, generation))
        if cut % 2:
            rws.run(transport, new)
            assert verdict(cabinet, old, new) == "set 1"
            assert rws.run(transport, new).is_empty
        found = attempt(rws.run, transport, None, "uninstall")
        assert found is None or found.diagnostics[0].code == "RG529", found
        restarted(cabinet, rws)
        assert verdict(cabinet, old, new) == "empty"
        assert (rws.home_of(cabinet), rws.cfg_of(cabinet)) == empty
    return line.log


CASES = [
    (generation, case, how)
    for generation in Generation
    for case in ("first", "update", "rollback", "uninstall")
    for how in ("before", "after")
]
SHORT = [
    (1, "first", "before"), (2, "update", "after"), (1, "rollback", "before"),
    (8, "uninstall", "before"),
]  # fmt: skip


@pytest.mark.parametrize(("generation", "case", "how"), CASES)
def test_cut_at_a_request(rws, generation, case, how, tmp_path):
    if not LONG and (generation.value, case, how) not in SHORT:
        pytest.skip("RAPIDGEN_LONG")
    log = run_cut(rws, generation, tmp_path / "whole", case, None, how)
    found = kinds(log)
    for cut in found if LONG else found[2 :: len(found) // 4]:
        print(cut, *log[cut - 1])
        run_cut(rws, generation, tmp_path / f"{cut}", case, cut, how)
