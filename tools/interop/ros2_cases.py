"""Cases of the trial with a real rclpy.

`python -m tools.interop.ros2` runs them on each RMW.
"""

import json
import os
import signal
import sys
import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import rclpy.action.server
import rclpy.lifecycle.node
import rclpy.node
import rclpy.parameter
import rclpy.qos_overriding_options
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy

from tools.interop.ros import until
from tools.interop.ros2_cell import ABORTED, CANCELED, ENDINGS, SUCCEEDED, Cell


class Findings:
    """Checked sentences, each with its result."""

    def __init__(self) -> None:
        self.lines: list[tuple[bool, str]] = []

    def must(self, holds: object, text: str) -> None:
        """Record a check."""
        self.lines.append((bool(holds), text))

    def ends(self, sent, status: int, code: int = 0, words: str = "", seconds: float = 60) -> None:
        """Check how a goal ends."""
        was, error, text = sent.end(seconds)
        good = was == status and error == code and words in text
        self.must(good, f"{ENDINGS.get(was, was)} {error} after {sent.took:.2f} s: {text!r}")

    def next_one(self, cell: Cell) -> None:
        """Check that the next goal is executed."""
        current = cell.sim.positions()[: len(cell.names("rob1"))]
        self.ends(cell.send(cell.goal([current, [h + 0.05 for h in current]], 1.0)), SUCCEEDED)

    def stands(self, cell: Cell, seconds: float = 1.0) -> None:
        """Check that the robot stands soon."""
        begin = time.monotonic()
        until(cell.sim.standing, 15, "it never stood")
        took = time.monotonic() - begin
        self.must(took < seconds, f"stands {took:.2f} s later")

    def __str__(self) -> str:
        return "\n".join(f"  {'' if good else 'NOT: '}{text}" for good, text in self.lines)


@dataclass(frozen=True)
class Case:
    """A case and its robot."""

    run: Callable[[Cell, Findings], None]
    robot: str = "irb120"
    options: tuple[str, ...] = ()
    parameters: tuple[str, ...] = ()


CASES: dict[str, Case] = {}


def case(**what):
    """Add a function to CASES."""

    def enter(function):
        CASES[function.__name__] = Case(function, **what)
        return function

    return enter


def signatures():
    """Return recorded and actual call signatures of this distribution."""
    sys.path.append(str(Path(__file__).parents[2] / "tests" / "ros"))
    from record import RECORDED, signature

    modules = (rclpy.node, rclpy.lifecycle.node, rclpy.action.server, rclpy.parameter)
    modules += (rclpy.qos_overriding_options,)
    known = json.loads(RECORDED.read_text())
    for call, text in known.get(os.environ.get("ROS_DISTRO"), {}).get("calls", {}).items():
        owner, method = call.split(".")
        (result,) = {getattr(m, owner) for m in modules if hasattr(m, owner)}
        yield call, text, signature(getattr(result, method))


def _way(count: int, to: float = 0.5) -> list[float]:
    return [to * k / (count - 1) for k in range(count)]


@case()
def five_points(cell, result):
    sent = cell.send(cell.goal(_way(5)))
    result.ends(sent, SUCCEEDED)
    result.must(len(sent.feedback) > 10, f"{len(sent.feedback)} feedbacks")
    result.must(cell.at([0.5] * 6), "the robot is there")
    last = cell.received["states"][-1][1]
    result.must(len(last.velocity) == 6 and last.name == cell.names("rob1"), "joint_states whole")
    stamps = [
        m.header.stamp.sec + m.header.stamp.nanosec * 1e-9 for _, m in cell.received["states"]
    ]
    result.must(sorted(set(stamps)) == stamps, f"{len(stamps)} stamps, each later")
    back = cell.goal([0.5, 0.4])
    back.trajectory.joint_names = back.trajectory.joint_names[::-1]
    result.ends(cell.send(back), SUCCEEDED)


@case(options=("--speed", "5"))
def five_hundred_points(cell, result):
    sent = cell.send(cell.goal(_way(500, 1.0), 0.1))
    result.ends(sent, SUCCEEDED, seconds=120)
    result.must(cell.at([1.0] * 6), f"the robot is there, {len(sent.feedback)} feedbacks")


@case(options=("--speed", "10"))
def five_thousand_points(cell, result):
    rows = [0.5 * (k % 1000) / 1000 if k % 2000 < 1000 else 0.5 - 0.5 * (k % 1000) / 1000
            for k in range(5000)]  # fmt: skip
    sent = cell.send(cell.goal(rows, 0.1))
    result.ends(sent, SUCCEEDED, seconds=300)
    result.must(cell.at([rows[-1]] * 6), f"the robot is there, {len(sent.feedback)} feedbacks")


@case()
def refused(cell, result):
    wrong = cell.goal([0.0, 0.1])
    wrong.trajectory.joint_names = ["a", *wrong.trajectory.joint_names[1:]]
    for goal, code, words in (
        (wrong, -2, "unknown: a"),
        (cell.goal([0.0, 9.0, 0.0]), -1, "outside its limits"),
        (cell.goal(_way(20), 0.05), -1, "shorter than the path planner follows"),
        (cell.goal([0.0, 1.0], 0.15), -1, "too fast"),
        (cell.goal([0.4, 0.5]), -1, "does not start at the robot's position"),
        (cell.goal([]), -1, "no points"),
    ):
        result.ends(cell.send(goal), ABORTED, code, words)
    result.must(cell.at([0.0] * 6), "nothing moved")
    result.next_one(cell)


@case()
def cancelled(cell, result):
    sent = cell.moving()
    sent.cancel()
    result.ends(sent, CANCELED)
    result.must(cell.sim.standing(), "the robot stands at the result")
    result.next_one(cell)


@case()
def second_goal_is_refused(cell, result):
    first = cell.moving(0.3, 3.0)
    result.ends(cell.send(cell.goal([0.0, 0.1])), ABORTED, -1, "another goal is executed")
    result.ends(first, SUCCEEDED)


@case(parameters=("replace:=approach",))
def second_goal_replaces(cell, result):
    first = cell.moving()
    second = cell.send(cell.goal([[0.2, 0, 0, 0, 0, 0], [0.3, 0, 0, 0, 0, 0]], 1.0))
    result.ends(first, ABORTED, -1, "replaced by a newer goal")
    result.ends(second, SUCCEEDED)
    result.must(cell.at([0.3, 0, 0, 0, 0, 0]), "the robot is there")


@case()
def emergency_stop(cell, result):
    sent = cell.moving()
    cell.sim.ask("e-stop")
    result.ends(sent, ABORTED, -4, "emergency stop")
    result.must(cell.sim.standing(), "the robot stands")
    words = [s.message for s in cell.received["health"][-1][1].status]
    result.must("an emergency stop is active" in words, f"diagnostics: {words}")
    for step in ("reset-e-stop", "motors-on", "start"):
        cell.sim.ask(step)
    time.sleep(1)
    result.must(cell.sim.standing(), "nothing resumes")
    result.next_one(cell)


@case()
def program_stopped(cell, result):
    sent = cell.moving()
    cell.sim.ask("stop")
    result.ends(sent, ABORTED, -4, "program was stopped")
    result.ends(cell.send(cell.goal([0.0, 0.1])), ABORTED, -1)
    cell.sim.ask("start")
    time.sleep(1)
    result.next_one(cell)


@case()
def controller_restarted(cell, result):
    sent = cell.moving()
    cell.sim.restart()
    result.ends(sent, ABORTED, -4)
    begin = time.monotonic()
    cell.ready()
    result.must(time.monotonic() - begin < 8, f"states {time.monotonic() - begin:.1f} s later")
    result.next_one(cell)


@case()
def controller_gone(cell, result):
    cell.sim.close()
    until(lambda: "no link" in cell.received["health"][-1][1].status[0].message, 20, "no report")
    since = time.monotonic()
    result.ends(cell.send(cell.goal([0.0, 0.1])), ABORTED, -1, "no link to the robot")
    time.sleep(1.5)
    result.must(not cell.state_since(since), "joint_states are not published again")
    cell.sim.restart()
    cell.ready()
    result.next_one(cell)


@case()
def node_killed(cell, result):
    for number in (signal.SIGKILL, signal.SIGTERM, signal.SIGINT):
        sent = cell.moving()
        code = cell.node.end(number)
        result.must(code is not None, f"signal {number}: exit code {code}")
        result.stands(cell)
        if number != signal.SIGKILL:
            result.must(sent.is_over and sent.end()[0] == ABORTED, "its goal was aborted before")
        cell.start_node()
        result.next_one(cell)


@case()
def services_and_speed(cell, result):
    sent = cell.moving(0.5, 4.0)
    text = cell.trigger("pause")
    result.must(text.success and cell.sim.standing(), f"pause: {text.message}")
    text = cell.trigger("resume")
    result.must(text.success, f"resume: {text.message}")
    value = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=50.0)
    request = SetParameters.Request(parameters=[Parameter(name="speed", value=value)])
    (answer,) = cell.call(SetParameters, "/rapidgen/set_parameters", request).results
    result.must(answer.successful, f"speed 50: {answer.reason}")
    request.parameters[0].value.double_value = 500.0
    (answer,) = cell.call(SetParameters, "/rapidgen/set_parameters", request).results
    result.must(not answer.successful, f"speed 500: {answer.reason}")
    result.ends(sent, SUCCEEDED)
    result.must(sent.took > 5, f"slower: {sent.took:.1f} s of 4")
    requested = GetParameters.Request(names=["speed"])
    (value,) = cell.call(GetParameters, "/rapidgen/get_parameters", requested).values
    result.must(value.double_value == 100.0, f"speed is {value.double_value:g} after it")
    sent = cell.moving(0.0)
    text = cell.trigger("stop")
    result.must(text.success, f"stop: {text.message}")
    result.ends(sent, ABORTED, -4)
    text = cell.trigger("resume")
    result.must(not text.success, f"resume: {text.message}")


@case(parameters=("qos_overrides./joint_states.publisher.depth:=3",))
def quality_of_service(cell, result):
    for topic in ("/joint_states", "/diagnostics"):
        (one,) = [
            info
            for info in cell.client.get_publishers_info_by_topic(topic)
            if info.node_name == "rapidgen"
        ]
        qos = one.qos_profile
        good = (qos.reliability, qos.durability) == (
            ReliabilityPolicy.RELIABLE,
            DurabilityPolicy.VOLATILE,
        )
        result.must(good, f"{topic}: {qos.reliability.name}, {qos.durability.name}, {qos.depth}")
    for call, recorded, current in signatures():
        result.must(current == recorded, f"{call}({current})")
    names = {name for name, _ in cell.client.get_topic_names_and_types()}
    result.must("/robot_status" in names, f"topics: {sorted(names)}")


@case(parameters=("publish_clock:=true",), options=("--speed", "4"))
def clock_of_a_simulator(cell, result):
    from rosgraph_msgs.msg import Clock

    received = []
    cell.client.create_subscription(
        Clock, "/clock", lambda m: received.append((time.monotonic(), m.clock)), 50
    )
    until(lambda: len(received) > 20, 20, "no clock")
    (a, first), (b, last) = received[0], received[-1]
    passed = last.sec - first.sec + (last.nanosec - first.nanosec) * 1e-9
    result.must(3 < passed / (b - a) < 5, f"{passed / (b - a):.2f} s of the controller in a second")


@case()
def life_cycle(cell, result):
    def change(transition: int) -> bool:
        request = ChangeState.Request(transition=Transition(id=transition))
        return cell.call(ChangeState, "/rapidgen/change_state", request).success

    sent = cell.moving()
    result.must(change(Transition.TRANSITION_DEACTIVATE), "deactivated in a motion")
    result.must(cell.sim.standing(), "the robot stands")
    result.must(sent.end(20)[0] == ABORTED, "its goal is aborted")
    result.must(change(Transition.TRANSITION_CLEANUP), "cleaned up")
    time.sleep(1)
    topics = {
        name for name, _ in cell.client.get_publisher_names_and_types_by_node("rapidgen", "/")
    }
    result.must("/joint_states" not in topics, "no joint_states any more")
    result.must(change(Transition.TRANSITION_CONFIGURE), "configured")
    result.must(change(Transition.TRANSITION_ACTIVATE), "active")
    cell.ready()
    result.next_one(cell)


@case(robot="irb14000")
def two_groups(cell, result):
    sent, both = {}, set(cell.names("rob_l") + cell.names("rob_r"))
    until(
        lambda: both <= {name for _, text in cell.received["states"] for name in text.name},
        30,
        "no joint_states of both groups",
    )
    for group in ("rob_l", "rob_r"):
        current = cell.sim.positions(group)
        names = cell.names(group)
        states = [message for _, message in cell.received["states"]]
        now = next(
            dict(zip(text.name, text.position, strict=True))
            for text in reversed(states)
            if set(text.name) == set(names)
        )
        rows = [[now[n] for n in names], [now[n] + 0.1 for n in names]]
        sent[group] = current, cell.send(cell.goal(rows, 2.0, group), group)
    for _, one in sent.values():
        result.ends(one, SUCCEEDED)
    services = {name for name, _ in cell.client.get_service_names_and_types()}
    result.must({"/rob_l/stop", "/rob_r/stop"} <= services, "services of each group")


@case(robot="irb2400")
def coupled(cell, result):
    result.ends(cell.send(cell.goal([0.0, [0, 0.4, -0.3, 0, 0, 0]], 2.0)), SUCCEEDED)
    result.must(cell.at([0, 0.4, 0.1, 0, 0, 0]), f"axes at {cell.sim.positions()[:4]}")
    last = cell.received["states"][-1][1]
    result.must(abs(last.position[2] + 0.3) < 1e-3, f"joint_states: {last.position[2]:.4f}")


@case(robot="irb120_track")
def track(cell, result):
    names = cell.names("rob1")
    row = [0.5 if n == "track" else 1.0 if n == "positioner" else 0.1 for n in names]
    start = cell.received["states"][-1][1]
    now = dict(zip(start.name, start.position, strict=True))
    result.ends(cell.send(cell.goal([[now[n] for n in names], row], 4.0)), SUCCEEDED)
    last = cell.received["states"][-1][1]
    off = max(abs(a - b) for a, b in zip(last.position, row, strict=True))
    result.must(off < 1e-3, f"{len(names)} joints, {off:.1e} off")


@case(options=("--speed", "20"))
def many_goals(cell, result):
    count, ends, begin = int(os.environ.get("RAPIDGEN_GOALS", "300")), {}, time.monotonic()
    current, grown = 0.0, []
    for number in range(count):
        if number % max(count // 10, 1) == 0:
            grown.append(cell.memory())
        target = 0.02 if current == 0.0 else 0.0
        kind = number % 4
        goal = cell.goal([9.0, 9.1] if kind == 3 else [current, target], 0.2)
        status, code, text = cell.send(goal).end(60)
        if status == SUCCEEDED:
            current = target
        key = f"{ENDINGS[status]} {code}"
        ends[key] = ends.get(key, 0) + 1
        if status != (ABORTED if kind == 3 else SUCCEEDED):
            result.must(False, f"goal {number}: {key}: {text}")
            current = cell.sim.positions()[0]
    grown.append(cell.memory())
    took = (time.monotonic() - begin) / count * 1e3
    result.must(True, f"{ends}, {took:.0f} ms a goal")
    growth = ", ".join(f"{mb - grown[1]:+.1f}" for mb in grown)
    result.must(grown[-1] - grown[1] <= 10, f"MB against the end of the first tenth: {growth}")


def run(name: str, one: Case) -> bool:
    """Run one case; return if it passed."""
    result, cell = Findings(), None
    try:
        cell = Cell(one.robot, *one.options, parameters=one.parameters)
        one.run(cell, result)
    except AssertionError as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        result.must(False, f"{error} ({place.name}:{place.lineno})")
    finally:
        if cell is not None:
            cell.close()
    good = all(good for good, _ in result.lines)
    print(f"{name}: {'good' if good else 'NOT GOOD'}\n{result}", flush=True)
    if cell is not None and not good:
        print(*[f"    {line[:300]}" for _, line in cell.node.lines[-12:]], sep="\n", flush=True)
    return good


def run_all(expected: list[str], goals: int) -> int:
    """Run the named cases, or all; return 1 if one failed."""
    os.environ["RAPIDGEN_GOALS"] = str(goals)
    bad = [name for name in expected or CASES if not run(name, CASES[name])]
    print(f"failed: {', '.join(bad) or 'none'}")
    return int(bool(bad))
