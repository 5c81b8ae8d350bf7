"""Driving a generated driver with bytes: every promise of docs/use/driver.md has a test with these.

R1..R20 are the faults of abb_driver's modules that a promise answers.
"""

import struct
from dataclasses import replace
from pathlib import Path

from tests.generate.bench import close_to, trajectory

FIVE = [[0.0] * 6, [0.1] * 6, [0.2] * 6, [0.3] * 6, [0.25] * 6]
SECONDS = [10.0, 1.0, 1.0, 1.0, 1.0]
LONG = [[0.001 * n] * 6 for n in range(300)]
NO_REPLY = 0.3
CAPACITY, GAP, NOT_FINITE, LIMIT, START, TOO_FAST = 1, 2, 3, 4, 5, 6
TCP_TOO_FAST, BAD_DURATION, SHORT, NO_START, INCOMPLETE, FRAMING = 7, 8, 9, 10, 11, 12
PADDING, NOT_EXECUTING, MOTORS, E_STOP, MIXED = 14, 20, 21, 22, 24
STOPPED, SUPERSEDED, CLIENT_LOST, PROGRAM, COLLISION, POWER, MODE = 40, 41, 42, 43, 45, 46, 47
RECEIVING, MOVING, DONE, REFUSED, FAILED, STOPPED_STATE, STARVED, PAUSED = 1, 2, 3, 4, 5, 6, 7, 8


def reply_of(client):
    """(reply code, data as int32) of the next frame, which must be a reply to a point."""
    frame = client.wait_frame()
    assert frame is not None, "no reply"
    _, kind, comm, code = struct.unpack_from("<4i", frame)
    assert (kind, comm) == (11, 3)
    return code, struct.unpack(f"<{(len(frame) - 16) // 4}i", frame[16:])


def send_all(client, frames):
    client.send(b"".join(frames))


def assert_refused(bench, client, reason, index, joint=0):
    before = bench.joints()
    assert reply_of(client) == (2, (reason, index, joint))
    state = bench.state_client()
    status = bench.status(state)
    assert status[2:4] == (reason + 100 * joint, 1)
    bench.vc.run_for(2)
    assert bench.joints() == before
    assert bench.healthy()


def move_well(bench, client=None):
    """A good trajectory from where the robot stands is executed to its end."""
    client = client or bench.client()
    here = list(bench.joints())
    there = [v + 0.02 for v in here]
    send_all(client, trajectory([here, there], [10, 0.5]))
    code, data = reply_of(client)
    assert code == 1, data
    bench.vc.run_for(2)
    assert close_to(bench.joints(), there)
    assert bench.healthy()
    return client


def start_moving(b):
    client, state = b.client(), b.state_client()
    send_all(client, trajectory(FIVE, SECONDS))
    assert reply_of(client)[0] == 1
    b.vc.run_for(1.5)
    return client, state


def recover(b):
    b.vc.perform("reset-e-stop")
    b.vc.perform("auto")
    b.vc.perform("motors-on")
    b.vc.perform("start")


def statements_of(b, routine, module="ROS_motion"):
    """Lines of the statements of a routine."""
    from rapidgen.rapid import parse

    (file,) = [f for f in b.output.files if Path(f.path).stem == module]
    module = parse(file.data)
    (found,) = [r for r in module.routines if r.name == routine]
    lines = []

    def walk(body):
        for node in body:
            lines.append(module.source.line(node.first))
            for branch in getattr(node, "branches", ()):
                walk(branch.body)
            walk(getattr(node, "otherwise", None) or ())

    walk(found.body)
    return lines


def line_with(b, module, words):
    """Number of the only line of a module that contains these words."""
    (file,) = [f for f in b.output.files if f.path.endswith(f"/{module}.mod")]
    lines = file.data.decode("latin-1").splitlines()
    (found,) = [n for n, line in enumerate(lines, 1) if words in line]
    return found


def mix(b, role, build="0123456789ab"):
    """One task shows another build."""
    b.vc.tasks["T_ROS_STATE"][f"ROS_common:ROS_shown_{role}"] = build


def with_old_file(b, name):
    """The system, with the BUILD_ID of one file's module being another one."""
    tasks = []
    for task in b.system.tasks:
        modules = [
            replace(m, data=m.data.replace(b.output.build_id.encode(), b"0123456789ab"))
            if m.path.endswith(name)
            else m
            for m in task.modules
        ]
        tasks.append(replace(task, modules=tuple(modules)))
    return replace(b.system, tasks=tuple(tasks))


def ask_progress(b):
    """A state client that gets PROGRESS."""
    state = b.state_client()
    state.send(struct.pack("<4i5i", 32, 1300, 2, 0, 2, 0, 1, 0, 1))
    b.vc.run_for(0.3)
    state.frames()
    return state


def all_progress(state):
    """Every PROGRESS since the last call, oldest first."""
    return [
        struct.unpack_from("<8i", f, 16)
        for f in state.frames()
        if struct.unpack_from("<i", f, 4)[0] == 1301
    ]


def progress_of(state):
    return set(all_progress(state))


def hold(b, task, seconds):
    """Let a task wait where it is."""
    b.vc.rapid_tasks[task].hold()
    b.vc.scheduler.after(round(seconds * 1e9), b.vc.rapid_tasks[task].release)
