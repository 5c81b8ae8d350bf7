"""Faults of a partner and of operators while it guides a robot, in lock-step.

    python tools/egm_campaign.py [--count N] [--first SEED] [--jobs N] [--results FILE]

A seed decides the mode, the limits of the program, when the partner is silent, late, sends a burst,
hostile or wrong messages, and up to two actions of an operator. Messages are encoded by the classes
of abb_robot_client, not by rapidgen. In each cycle no axis may leave its range and deviation or be
faster than allowed, and after a stop nothing may move. At the end a good partner must guide the
robot again. FILE (JSON lines) stores the results: the next call continues.
"""

import argparse
import math
import random
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from abb_robot_client._egm_protobuf import egm_pb2

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.motion.egm.law import Profile
from tools.campaigns import outcomes

PROGRAM = r"""MODULE m
CONST egm_minmax near := [-0.2, 0.2];
CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
CONST pose base := [[0,0,0],[1,0,0,0]];
VAR egmident id;
VAR intnum alarm;
PROC main()
EGMReset id;
MoveAbsJ home, v1000, fine, tool0;
EGMGetId id;
CONNECT alarm WITH stops;
@alarm
EGMSetupUC ROB_1, id, "default", "PC" \@mode \CommTimeout:=@timeout;
EGMAct@mode id \Tool:=tool0 @frames @axes \MaxSpeedDeviation:=@speed \MaxPosDeviation:=@deviation;
EGMRun@mode id, @stop @chosen \CondTime:=0.5 \RampInTime:=@ramp
 \RampOutTime:=@out \PosCorrGain:=@gain;
TPWrite "converged";
IDelete alarm;
EGMReset id;
WaitTime 600;
ERROR
IF ERRNO = ERR_UDPUC_COMM THEN
IDelete alarm;
EGMReset id;
TPWrite "silent";
WaitTime 600;
ENDIF
ENDPROC
TRAP stops
EGMStop id, @stop \RampOutTime:=@out;
ENDTRAP
ENDMODULE
"""
FAULTS = ("silence", "late", "burst", "nan", "jump", "type", "counts", "garbage", "mode", "speed")
ACTIONS = ("e-stop", "manual", "motors-off", "stop", "power-loss")
CYCLE = 0.004
AXES = math.radians(1e-4)
SETTLING = math.radians(1e-3)
"""How far a robot may be from its fine point when a run begins."""


class Partner:
    """Moves a target near the start, with faults at times of the seed; None: no faults."""

    def __init__(self, chance, mode):
        self.chance, self.mode = chance, mode
        self.queue = []
        self.sequence = 0
        self.fault, self.until = "", -1.0
        self.start = None
        self.guided = 0

    def __call__(self, data):
        robot = egm_pb2.EgmRobot.FromString(data)
        if robot.mciState.state != 3:
            return None
        self.guided += 1
        if robot.header.seqno == 0 or self.start is None:
            self.start = robot.feedBack
        self.queue.append(self.answer(robot))
        fault = self.current(robot.header.tm / 1000)
        if fault == "silence":
            self.queue.clear()
        elif fault == "late":
            return self.queue.pop(0) if len(self.queue) > 20 else None
        elif fault == "burst":
            return None
        return self.queue.pop(0) if self.queue else None

    def current(self, now):
        if self.chance is None:
            return ""
        if now >= self.until:
            faulty = self.chance.random() < 0.5
            self.fault = self.chance.choice(FAULTS) if faulty else ""
            self.until = now + 10 ** self.chance.uniform(-2, 0.2)
        return self.fault

    def answer(self, robot):
        chance, message = self.chance, egm_pb2.EgmSensor()
        fault = self.fault if chance is not None else ""
        message.header.mtype = 3
        message.header.seqno = self.sequence
        self.sequence += 1
        amplitude = 0.0 if chance is None else 8.0
        sway = amplitude * math.sin(robot.header.tm / 700)
        mode = self.mode if fault != "mode" else {"Joint": "Pose", "Pose": "Joint"}[self.mode]
        if mode == "Joint":
            values = [q + sway for q in self.start.joints.joints]
            if fault == "nan":
                values[chance.randrange(6)] = chance.choice((math.nan, math.inf, -math.inf))
            elif fault == "jump":
                values[chance.randrange(6)] += chance.choice((30.0, -400.0, 1e9, -1e300))
            elif fault == "counts":
                values = values * 2 if chance.random() < 0.5 else values[: chance.randrange(6)]
            message.planned.joints.joints.extend(values)
        else:
            pose = message.planned.cartesian
            pose.CopyFrom(self.start.cartesian)
            pose.pos.x += sway * 5
            if fault == "nan":
                pose.pos.y = math.nan
            elif fault == "jump":
                pose.pos.z += chance.choice((300.0, -2000.0, 1e9))
        if fault == "speed":
            message.speedRef.joints.joints.extend([chance.uniform(-1e3, 1e3)] * 6)
            message.speedRef.cartesians.value.extend([chance.uniform(-1e4, 1e4)] * 6)
        if fault == "type":
            message.header.mtype = chance.choice((0, 1, 2, 4))
        data = message.SerializeToString()
        if fault == "garbage":
            data = bytearray(data)
            data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
            data = bytes(data[: chance.randrange(len(data) + 1)])
        return data


class Broken(Exception):
    """An invariant does not hold."""


class Watch:
    """Compares the axes of each cycle with what the program allows."""

    def __init__(self, controller, speed, deviation):
        self.controller = controller
        self.group = next(iter(controller.motion.groups.values()))
        self.speed, self.deviation = math.radians(speed), math.radians(deviation)
        self.before = self.group.positions()
        self.start = None
        self.reached = 0.0
        """Largest distance from the start while the motors were off, rad."""

    def run(self, seconds, standing=False):
        for _ in range(round(seconds / CYCLE)):
            self.controller.run_for(CYCLE)
            self.look(standing)

    def look(self, standing):
        now, guided = self.group.positions(), self.guided()
        steps = [abs(a - b) for a, b in zip(now, self.before, strict=True)]
        if standing and max(steps) > AXES:
            now_s = self.controller.scheduler.now * 1e-9
            raise Broken(f"moves after a stop: {max(steps):.2e} rad in a cycle, {now_s:.3f} s")
        if guided:
            if self.start is None:
                self.start = self.before
            if max(steps) > self.speed * CYCLE * 1.001 + AXES:
                raise Broken(f"{math.degrees(max(steps)) / CYCLE:.1f} deg/s")
            far = max(abs(a - b) for a, b in zip(now, self.start, strict=True))
            if not self.controller.motors_on:
                # Brakes stop the robot wherever it comes to rest, also beyond a limit of EGM; from
                # there it may come back.
                self.reached = max(self.reached, far)
            elif far > max(self.deviation, self.reached) + SETTLING:
                raise Broken(f"beyond the deviation: {math.degrees(far - self.deviation):.4f} deg")
        else:
            self.start, self.reached = None, 0.0
        for joint, q in zip(self.group.config.joints, now, strict=True):
            if not joint.lower - AXES <= q <= joint.upper + AXES:
                raise Broken(f"{joint.axis} beyond its range")
        self.before = now

    def guided(self):
        return any(s.guided for s in self.controller.egm.sessions)


def trial(_context, seed):
    """Return [failure, what happened]."""
    chance = random.Random(f"{seed} egm trial")
    mode = chance.choice(("Joint", "Pose"))
    speed, deviation = round(chance.uniform(5, 120), 3), round(chance.uniform(5, 40), 3)
    joint = mode == "Joint"
    names = [f"J{i}" for i in range(1, 7)] if joint else ["x", "y", "z", "rx", "ry", "rz"]
    chosen = chance.sample(names, chance.randrange(1, 7))
    frames = "" if joint else r"\WObj:=wobj0, base, EGM_FRAME_BASE, base, EGM_FRAME_BASE"
    alarm = f"ITimer \\Single, {chance.uniform(0.1, 3):.3f}, alarm;"
    values = {
        "mode": mode,
        "frames": frames,
        "alarm": alarm if chance.random() < 0.4 else "",
        "axes": " ".join(f"\\{name}:=near" for name in names),
        "chosen": " ".join(f"\\{name}" for name in chosen),
        "timeout": f"{chance.uniform(0.05, 1):.3f}",
        "speed": f"{speed:.3f}",
        "deviation": f"{deviation:.3f}",
        "stop": chance.choice(("EGM_STOP_HOLD", "EGM_STOP_RAMP_DOWN")),
        "ramp": f"{chance.choice((0, 0.05, 0.5)):.3f}",
        "out": f"{chance.choice((0.01, 0.2, 1)):.3f}",
        "gain": f"{chance.choice((0, 0.5, 1)):.3f}",
    }
    profile = Profile(
        stands_after_motors_off=chance.random() < 0.5,
        ramp_time=chance.choice((0.005, 0.5)),
        gain=chance.choice((5.0, 20.0)),
        bandwidth=chance.choice((0.0, 20.0, 100.0)),
    )
    text = PROGRAM
    for name, value in sorted(values.items(), key=lambda item: -len(item[0])):
        text = text.replace(f"@{name}", value)
    happened = f"{mode} {speed:.0f} deg/s"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "m.mod"
        path.write_text(text)
        with VirtualController.from_files(
            {"T_ROB1": [path]}, robots=load_config("irb120").groups, cycle="once", autostart=False
        ) as controller:
            controller.egm._profiles = lambda: {"default": profile}
            try:
                happened += exercise(controller, chance, mode, speed, deviation)
            except Broken as fault:
                return [str(fault), happened]
    return ["", happened]


def exercise(controller, chance, mode, speed, deviation):
    """Let the partner and the operator do their worst, then guide again."""
    watch, happened = Watch(controller, speed, deviation), ""
    controller.egm.connect("PC", Partner(chance, mode))
    controller.start_program()
    watch.run(chance.uniform(0.3, 2.5))
    for _ in range(chance.randrange(3)):
        action = chance.choice(ACTIONS)
        happened += f"; {action}"
        controller.perform(action)
        # The longest ramp is 0.5 s, the dead time 16 ms.
        watch.run(0.6)
        watch.run(chance.uniform(0, 1), standing=True)
        if chance.random() < 0.5:
            restart(controller, main=False)
            watch.run(chance.uniform(0, 1))
    controller.perform("stop")
    watch.run(0.6)
    watch.run(0.1, standing=True)
    good = Partner(None, mode)
    controller.egm.connect("PC", good)
    restart(controller, main=True)
    rows = len(controller.operator.rows)
    for _ in range(80):
        watch.run(0.1)
        if len(controller.operator.rows) > rows:
            break
    end = list(controller.operator.rows)[rows:]
    if end[:1] not in (["converged"], []) or not (end or good.guided):
        last = [str(event) for event in controller.log][-3:]
        raise Broken(f"stuck: {end} {good.guided} {last}")
    return happened


def restart(controller, *, main):
    """Restart as an operator does."""
    operation = controller.operation
    if operation.e_stop:
        controller.set_e_stop(False)
    controller.set_mode("auto")
    controller.set_motors(True)
    if main:
        controller.pp_to_main()
    controller.start_program()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=20_000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--results", type=Path)
    words = parser.parse_args()
    seeds = range(words.first, words.first + words.count)
    start, failures = time.monotonic(), 0
    results = outcomes(
        trial, {str(seed): seed for seed in seeds}, "egm", jobs=words.jobs, path=words.results
    )
    for number, (seed, (failure, happened)) in enumerate(results, start=1):
        if failure:
            failures += 1
            print(f"seed {seed}: {failure} ({happened})", flush=True)
        if number % 1000 == 0:
            print(f"{number} trials, {failures} failed", flush=True)
    print(f"{words.count} trials, {failures} failed, {time.monotonic() - start:.0f} s")
    return bool(failures)


if __name__ == "__main__":
    sys.exit(main())
