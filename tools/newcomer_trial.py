"""Trial of error messages: wrong commands, configurations and calls that newcomers write.

`python -m tools.newcomer_trial [--table]`. An entry is answered if the first finding has at most
five lines (without the empty ones of the frame), names the place (a given word), a reason with a
code or an exception of the client, and a fix, and if there is no traceback. The exit code is 1
below 95 %.
"""

import contextlib
import io
import os
import re
import shlex
import sys
import tempfile
from functools import partial
from pathlib import Path

from rapidgen import client
from rapidgen.cli.app import main as run_command
from rapidgen.client import Pose, Program, Trajectory, from_degrees
from rapidgen.client.errors import RobotError
from rapidgen.controller import VirtualController
from rapidgen.diagnostics import DiagnosticError

LINES = 5
GOAL = 0.95
FILES = {
    "good.mod": "MODULE good\n    PROC main()\n    ENDPROC\nENDMODULE\n",
    "bad.mod": "MODULE bad\n    PROC main()\n        x := ;\n    ENDPROC\nENDMODULE\n",
    "cell.yaml": "model: irb120\n",
    "p.csv": "time,joint_1,joint_2\n0,0,0\n1,0.1,0\n",
    "degrees.csv": "time,"
    + ",".join(f"joint_{n}" for n in range(1, 7))
    + "\n0,0,0,0,0,0,0\n2,90,0,0,0,30,0\n",
}
# A command, and the word of the answer that shows the place.
COMMANDS = """
chek cell.yaml | chek
biuld cell.yaml | biuld
simulate cell.yaml | simulate
deply cell.yaml | deply
rnu good.mod | rnu
--versoin | versoin
check --strickt cell.yaml | strickt
check celll.yaml | celll.yaml
check irb12 | irb12
check bad.mod | bad.mod:3
check missing.mod | missing.mod
build | CONFIG
build cell.yml | cell.yml
build cell.yaml --ouput x | ouput
build cell.yaml --set trajectory.capasity=5 | capasity
build cell.yaml --set trajectory.capacity=five | trajectory.capacity
build cell.yaml --set capacity | capacity
build cell.yaml --set robotware=9.9 | robotware
new cell.yaml --robot irb120 | cell.yaml
new x.yaml --robot irb121 | irb121
new x.yaml --robot | robot
new x.yaml --urdf robot.urdf | robot.urdf
new x.txt --robot irb120 | x.txt
robots shwo irb120 | shwo
robots show irb999 | irb999
explain RG9999 | RG9999
explain RG | RG
explain 99999999 | 99999999
explain hello | hello
fmt missing.mod | missing.mod
fmt cell.yaml | cell.yaml
fmt bad.mod | bad.mod:3
run missing.mod | missing.mod
run bad.mod | bad.mod:3
run good.mod --robot irb121 | irb121
run good.mod --cell none.yaml | none.yaml
run good.mod --start 0,0 | --start has 2 values
run good.mod --start a,b,c,d,e,f | a,b,c,d,e,f
run good.mod --entry mian | mian
run good.mod --max-time -1 | max-time
run good.mod --max-time 10s | --max-time
run good.mod --robotware seven | seven
run good.mod --assume wait_until=evnt | wait_until
run good.mod --plot x.bmp | .bmp
run . --cell infer | .
sim cell.yaml --speed 0 | speed
sim cell.yaml --ports any | any
sim cell.yaml --rws 3 | 3
sim none.yaml | none.yaml
move cell.yaml --joints 0,10,0 --to 127.0.0.1:9 --yes | 3 values
move cell.yaml --joints 0,10,0,0,30,abc --yes | abc
move cell.yaml missing.csv --yes | missing.csv
move cell.yaml p.csv --dry-run | joint_3
move cell.yaml degrees.csv --dry-run | joint_1
move cell.yaml --yes | no target
jog cell.yaml joint_9=5 --yes | joint_9
jog cell.yaml joint_1=fast --yes | fast
pose cell.yaml --to sim | sim
monitor cell.yaml --to nowhere.invalid --count 1 | nowhere.invalid
stop cell.yaml --to 127.0.0.1:99999 | 99999
""".strip().splitlines()
# Lines of a configuration that begins with `model: irb120` if the first is not `model`.
KEYS = """
trajectroy: {capacity: 10}
trajectory: {capasity: 10}
trajectory: {capacity: many}
trajectory: {capacity: 0}
trajectory: {zone: z11}
trajectory: {zone: 50}
trajectory: {corners: round}
trajectory: {start_tolerance: 100}
trajectory: {min_segment: 100}
trajectory: {ring: 100}
trajectory: {preload: 500}
trajectory: {approach_speed: 10}
trajectory: {too_fast: ignore}
model: irb121
model: 120
tool: {name: grip, frame: {position: [0, 0, 0.12]}, load: {mass: 0.8}}
tool: {name: grip, load: {mass: 1200}}
tool: {name: grip, load: {mass: -1}}
tool: {name: grip, load: {mass: 1, centre: [0, 0, 0.04]}}
tool: {name: grip, load: {mass: 1, centre: [0, 0]}}
tool: {name: grip, load: {mass: 1, center: [0, 0, 40]}}
tool: {name: grip, load: {mass: 1, inertia: [1200, 1200, 1200]}}
tool: {name: grip, load: {mass: 1}, frame: {orientation: [0, 0, 0, 0]}}
tool: {name: "my tool", load: {mass: 1}}
tool: {name: grip}
work_object: {name: table, user_frame: {position: [0.3, 0, 0.0002]}}
work_object: {name: table, uframe: {position: [300, 0, 0]}}
tcp_speed_limit: 0.25
tcp_speed_limit: 250000
max_payload: 3000
joints: {joint_1: {lower: -2.88, upper: 2.88}}
joints: {joint_1: {lower: 165, upper: -165}}
joints: {joint_1: {speed: 0.5}}
joints: {joint_1: {offset: 1.5708}}
joints: {joint_7: {axis: rax_7}}
ports: {motion: 110000}
ports: {motion: 11000, state: 11000}
network: {bind: 300.1.1.1}
signals: {doGrip: {kind: XX}}
signals: {diGrip: {kind: DI, access: write}}
egm: {address: 192.168.1.5, max_deviation: 0.7854, max_speed: 50}
""".strip().splitlines()
# An expression with a connected `robot`, and what the answer names.
CALLS = """
Pose.from_wxyz((0.3, 0, 0.4), (0, 0, 0, 0)) | quaternion
Pose.from_xyzw((0.3, 0, 0.4), (1, 0, 0)) | quaternion (x, y, z, w)
Pose.from_wxyz((0.3, 0), (1, 0, 0, 0)) | 0.3
Pose.from_wxyz((0.3, 0, float("nan")), (1, 0, 0, 0)) | nan
Pose.from_matrix([[1, 0], [0, 1]]) | 2x2
Pose.from_rotvec((0.3, 0, 0.4), (0, 0)) | rotation vector
robot.pose.move(z=0.1) | move
Trajectory([0, 1], [[0] * 6]) | 2
Trajectory([0], [[0] * 5], ["a"]) | 5
Trajectory.from_csv("missing.csv") | missing.csv
Trajectory.from_csv("good.mod") | header
Trajectory.from_points([[0] * 6, [0.1] * 5], seconds=1) | point 1 has 5 values
Trajectory.from_points([[0] * 6], seconds="fast") | fast
Trajectory([1, 0], [[0] * 6, [0.1] * 6]).resampled(0) | times
robot.check(Trajectory([0, 1], [[0] * 6, [90] * 6])) | joint_1
robot.check(Trajectory([0, 1], [[0] * 7, [0] * 7])) | 7
robot.check(Trajectory([0, 0.01], [[0] * 6, [1] * 6])) | joint_
robot.check(Trajectory([1, 0], [[0] * 6, [0.1] * 6])) | increase
robot.move_to([0, 10, 0, 0, 30, 0]) | joint_2
robot.move_to([0, 0.1]) | 6
robot.move_linear(Pose((400, 0, 300), (1, 0, 0, 0))) | 400
robot.jog(joint_9=0.1) | joint_9
robot.jog(joint_1=5) | joint_1
robot.write_signal("doGrp", 1) | doGrp
robot.call("weld") | weld
Robot("irb121") | irb121
Robot("missing.yaml") | missing.yaml
Robot("irb120", address="127.0.0.1:1,2,3,4").connect() | 127.0.0.1
Robot("irb120", address="127.0.0.1:9,9,9").connect() | 127.0.0.1
robot.check_program(Program(speed=-1).move_joints([0] * 6)) | -1
robot.check_program(Program(speed=0.2, zone="z11").move_joints([0] * 6)) | z11
robot.check_program(Program(speed=0.2).move_linear(((400, 0, 300), (1, 0, 0, 0)))) | 400
""".strip().splitlines()


def answer_of_command(words: str) -> str:
    """Return what a command prints."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
        run_command(shlex.split(words))
    return out.getvalue()


def answer_of_key(line: str) -> str:
    """Return what `check` prints about a configuration with a line."""
    text = line if line.startswith("model") else f"model: irb120\n{line}"
    Path("wrong.yaml").write_text(text + "\n", encoding="utf-8")
    return answer_of_command("check wrong.yaml")


def answer_of_call(expression: str, robot: client.Robot) -> str:
    """Return the exception of a call, as Python shows it."""
    names = {name: getattr(client, name) for name in client.__all__}
    names |= {"Pose": Pose, "Program": Program, "Trajectory": Trajectory}
    names |= {"from_degrees": from_degrees, "robot": robot}
    try:
        eval(expression, names)
    except (RobotError, DiagnosticError, ValueError, TypeError, AttributeError, OSError) as fault:
        return f"{type(fault).__name__}: {fault}"
    return ""


def fault_of(answer: str, place: str, *, has_code: bool) -> str:
    """Return why an answer is not good; empty if it is."""
    first = re.split(r"\n(?=(?:error|warning)\[)", answer.strip())[0]
    lines = [line for line in first.splitlines() if line.strip(" |") and " error(s), " not in line]
    if "Traceback" in answer:
        return "traceback"
    if not answer:
        return "not reported"
    if has_code and not re.search(r"(error|warning)\[RG\d+\]", answer):
        return "no code"
    if place not in answer:
        return f"does not name {place}"
    if has_code and "help: " not in answer and "did you mean" not in answer.lower():
        return "no fix"
    return f"{len(lines)} lines" if len(lines) > LINES else ""


def trial(show_all: bool) -> int:
    """Print the figures; return 1 below the goal."""
    controller = VirtualController.from_config("irb120", clock="real", ports="auto")
    controller.start()
    robot = client.Robot("irb120", address=controller.address())
    robot.connect()
    robot.wait_until(lambda state: state.status.motion_possible == 1, timeout=5)
    tables = (
        ("commands", COMMANDS, answer_of_command),
        ("keys and units", KEYS, answer_of_key),
        ("calls", CALLS, partial(answer_of_call, robot=robot)),
    )
    together = good = 0
    for title, entries, answer_of in tables:
        answered = 0
        for entry in entries:
            text, _, place = entry.partition(" | ")
            try:
                answer = answer_of(text)
            except Exception as fault:  # noqa: BLE001 - a crash is a result of the trial
                answer = f"Traceback: {fault!r}"
            fault = fault_of(answer, place or "wrong.yaml:", has_code=title != "calls")
            answered += not fault
            if fault or show_all:
                print(
                    f"{fault or 'answered'}: {text}\n    {answer.strip()}".replace("\n", "\n    ")
                )
        print(f"{title}: {answered} of {len(entries)} answered")
        together, good = together + len(entries), good + answered
    robot.close()
    controller.close()
    print(f"together: {good} of {together}, {100 * good / together:.1f} %")
    return int(good < GOAL * together)


def main() -> int:
    """Write the files of the trial into a folder of its own and answer there."""
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        os.environ["XDG_RUNTIME_DIR"] = os.environ["XDG_STATE_HOME"] = folder
        for name, text in FILES.items():
            Path(name).write_text(text, encoding="utf-8")
        return trial("--table" in sys.argv)


if __name__ == "__main__":
    sys.exit(main())
