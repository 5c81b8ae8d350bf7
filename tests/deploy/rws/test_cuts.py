"""Deployments interrupted at a request, then a restart.

The controller boots the old set, the new one, or one that does not move; the next run, of any kind,
repairs it. Some of the kinds of requests that change something are interrupted once each;
RAPIDGEN_LONG takes every request, before and after it was done (`make rws-interruptions`).
"""

import os
import re
import shutil
import sys
import traceback

import pytest

from rapidgen.deploy.command_run import earlier_set
from rapidgen.diagnostics import DiagnosticError
from rapidgen.wire.rws.bodies import Generation

LONG = bool(os.environ.get("RAPIDGEN_LONG"))
HOWS = ("before", "after")
FAILED = "failed.txt"
"""Output of the failed copies of the process."""


def kinds(log):
    """Numbers of the requests to cut at: of each kind of change the first, and the last ones."""
    result = {}
    for number, (method, target) in enumerate(log, 1):
        if method != "GET":
            plain = re.sub(
                r"(fileservice|instances|tasks|modules)/[^?]*?(/\w+)?(?=\?|$)", r"\1\2", target
            )
            result.setdefault((method, plain), number)
    return sorted(result.values())


def restarted(controller_runner, rws):
    controller_runner.ask_restart()
    rws.pass_time(controller_runner, 1.0)


def verdict(controller_runner, *sets):
    """'empty', 'set 0', ... or 'refuses'; 'MIXED' must never be. Not by the code in test."""
    tasks = controller_runner.controller.rapid_tasks
    programs = controller_runner.programs
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
    moves = "ROS_motion" in lying["T_ROB1"]  # without it no user could answer
    return "MIXED" if moves and not faulty and len(ids) == 1 else "refuses"


def attempt(function, *args):
    """Return the refusal, or None."""
    try:
        function(*args)
    except DiagnosticError as error:
        return error
    return None


class Forks:
    """Cuts one run at many requests: in a copy of the process, from the request on.

    What came before is run once and not for each cut. The controller's disks are put back after
    each.
    """

    def __init__(self, controller_runner, wanted):
        """`wanted(number, method, target)`: how a request is cut, in every way of these."""
        self.runner, self.wanted = controller_runner, wanted
        self.cut = None
        """In a copy: where it is cut, and how."""
        self.done, self.failed = 0, []

    def __call__(self, number, got):
        for how in self.wanted(number, got.method, got.target) if self.cut is None else ():
            if self._copy(number, how):
                return how
        return None

    def _copy(self, number, how):
        """True in the copy, which is interrupted."""
        retained = self.runner.folder.with_name(f"{self.runner.folder.name}-kept")
        shutil.copytree(self.runner.folder, retained)
        sys.stdout.flush()
        if not (copy := os.fork()):
            self.cut = (number, how)
            return True
        _, status = os.waitpid(copy, 0)
        shutil.rmtree(self.runner.folder)
        retained.rename(self.runner.folder)
        self.done += 1
        if status:
            self.failed.append((number, how))
        return False


def run_cut(rws, generation, folder, case, wanted=lambda *request: (), again=None):
    """Cut one run; then restart, judge, and put it right: by another deployment (`again`), or by
    taking it off; of every second request the one, else the other.

    `wanted` as in Forks. The requests of the run, how many cuts there were, and those that failed,
    by a request's number and how it was cut.
    """
    old, new = rws.build(generation), rws.build(generation, "trajectory.capacity=500")
    with rws.empty_runner(folder, generation) as controller_runner:
        empty = rws.home_of(controller_runner), rws.cfg_of(controller_runner)
        before = {"first": [], "rollback": [old, new]}.get(case, [old])
        for earlier in before:
            rws.run(rws.connect(rws.Line(controller_runner, generation)), earlier)
        forks = Forks(controller_runner, wanted)
        line = rws.Line(controller_runner, generation, cut=forks)

        def complete():
            transport = rws.connect(line)
            target = {"first": old, "update": new}.get(case)
            if case == "rollback":
                target = earlier_set(transport, "", None)
            rws.run(transport, target, case if case in ("uninstall", "rollback") else "deploy")

        try:
            error = attempt(complete)
            if error and not forks.cut:
                raise error
            if forks.cut:
                deployed = forks.cut[0] % 2 if again is None else again
                judge(rws, generation, controller_runner, (old, new), empty, again=deployed)
        except BaseException:
            if not forks.cut:
                raise
            with (folder / FAILED).open("a") as text:
                print(generation, case, *forks.cut, *line.log[-1], file=text)
                traceback.print_exc(file=text)
            os._exit(1)
        if forks.cut:
            os._exit(0)
        assert not line.dead
        return line.log, forks.done, forks.failed


def judge(rws, generation, controller_runner, sets, empty, again):
    """Check that the booted set is complete and that the next run repairs.

    The next run is another deployment, or uninstalling.
    """
    restarted(controller_runner, rws)
    assert verdict(controller_runner, *sets) != "MIXED"
    transport = rws.connect(rws.Line(controller_runner, generation))
    if again:
        rws.run(transport, sets[1])
        assert verdict(controller_runner, *sets) == "set 1"
        assert rws.run(transport, sets[1]).is_empty
    result = attempt(rws.run, transport, None, "uninstall")
    assert result is None or result.diagnostics[0].code == "RG529", result
    restarted(controller_runner, rws)
    assert verdict(controller_runner, *sets) == "empty"
    assert (rws.home_of(controller_runner), rws.cfg_of(controller_runner)) == empty


CASES = [
    (generation, case)
    for generation in Generation
    for case in ("first", "update", "rollback", "uninstall")
]
SHORT = {
    (1, "first"): "before", (2, "update"): "after", (1, "rollback"): "before",
    (8, "uninstall"): "before",
}  # fmt: skip


@pytest.mark.skipif(not hasattr(os, "fork"), reason="copies of a process")
@pytest.mark.parametrize(("generation", "case"), CASES)
def test_cut_at_a_request(rws, generation, case, tmp_path):
    how = SHORT.get((generation.value, case))
    if not (LONG or how):
        pytest.skip("RAPIDGEN_LONG")
    if LONG:
        log, done, failed = run_cut(rws, generation, tmp_path, case, lambda *request: HOWS)
        assert done == 2 * len(log)
    else:
        result = kinds(run_cut(rws, generation, tmp_path, case)[0])
        some = result[2 :: len(result) // 4]
        _, done, failed = run_cut(
            rws, generation, tmp_path, case, lambda number, *_: (how,) if number in some else ()
        )
        assert done == len(some)
    assert failed == [], (tmp_path / FAILED).read_text()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="copies of a process")
def test_cut_while_the_file_that_is_switched_last_is_away(rws, tmp_path):
    """A background task keeps that one module of the other set.

    The next deployment of this set must not take the task for current.
    """

    def away(_number, method, target):
        return ("after",) if method == "DELETE" and "ROS_common" in target else ()

    _, done, failed = run_cut(rws, Generation.ONE, tmp_path, "rollback", away, again=True)
    assert done
    assert failed == [], (tmp_path / FAILED).read_text()
