"""Motion programs on the reference cost model.

`python benchmarks/programs.py`. Seconds of CPU of the client's check of 1,000 moves on lines;
simulated seconds from the call to the first motion, and whether the robot waits for an instruction;
simulated time of the motion server for an instruction and for a point of a stream; a routine's
round trip. Ratios of algorithms in our cost and motion model; no controller was measured.
"""

import sys
import time
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "client"))

from driven import driven

from rapidgen.client import Program
from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.system.model import ModuleFile
from rapidgen.verification.batches import millionths
from rapidgen.verification.messages import RawInstruction, RawStreamFlag
from rapidgen.verification.raw_programs import Programmer, RawMove, bent, reached
from rapidgen.verification.stream import Streamer
from rapidgen.verification.testbench import Bench

BENT = [0.2, 0.1, 0.1, 0.3, 0.6, -0.2]
COUNT = 1000
NOTHING = b"MODULE cell\n PROC nothing()\n  RETURN;\n ENDPROC\nENDMODULE\n"


def zigzag(robot, count: int) -> Program:
    """Return lines of about 5 cm."""
    pose = robot.pose_of(BENT)
    program = Program(speed=0.3, zone="z5")
    for n in range(1, count + 1):
        program.move_linear(pose.moved(y=0.05 * (n % 2), z=0.01 * (n % 7)))
    return program


def client() -> None:
    with driven() as (robot, controller):
        robot.move_to(BENT, speed=1.0)
        program = zigzag(robot, COUNT)
        began = time.process_time()
        robot.check_program(program)
        print(f"check of {COUNT} moves on lines: {time.process_time() - began:.2f} s of CPU")
        group = controller.motion.group("rob1")
        since = controller.now
        execution = robot.run(program)
        while group.is_standing:
            controller.run_for(0.001)
        print(f"first motion {1000 * (controller.now - since):.0f} ms after run() (simulated)")
        result = execution.result()
        print(
            f"{result.points} executed by {execution.mode} in {result.seconds:.1f} s "
            f"({result.planned_seconds:.1f} s at least), starved {result.starved} times, "
            f"{len([e for e in controller.log if e.code == 50024])} corner path failures"
        )


def reading() -> None:
    config = load_config("irb120")
    with Bench(config, make_system(config, build(config))) as bench:
        bench.run(0.5)
        place, client = bent(bench), Programmer(bench)
        client.takes("the beginning", [RawMove(RawInstruction.MOVE_ABSJ, place, None, zone=None)])
        bench.wait_until_at(place)
        bench.run(0.5)
        pose = RawMove(RawInstruction.MOVE_L, place, reached(bench, place), zone=None)
        joints = replace(pose, kind=RawInstruction.MOVE_ABSJ, pose=None)
        result = {}
        for what, order in (("to a pose", pose), ("to joints", joints)):
            client.number += 1
            begin = RawStreamFlag.BEGIN | RawStreamFlag.WHOLE
            client.say([*millionths(place), *order.words], 1, begin)
            bench.run(0.5)
            since = bench.now
            for batch in range(10):
                client.say(_bare(order) * 12, 12, RawStreamFlag.WHOLE, first=1 + 12 * batch)
            result[what] = (bench.now - since) / 120
            client.link.stop()
            bench.run(1)
        stream = Streamer(bench, client.link, number=100)
        stream.put([(place, 0.1)], RawStreamFlag.BEGIN)
        bench.run(0.5)
        since = bench.now
        for _ in range(10):
            stream.put([(place, 0.1)] * 12)
        # Neither moves meanwhile: only reading is compared.
        point = (bench.now - since) / 120
        for what, each in result.items():
            print(f"one instruction {what}: {1e3 * each:.2f} ms, {each / point:.2f} x a point")


def _bare(order: RawMove) -> list[int]:
    """Return the words without speed and zone."""
    values = [] if order.pose is None else [*order.pose[0], *order.pose[1]]
    return [int(order.kind), *millionths([*values, *order.joints])]


def routines() -> None:
    over = {"routines.nothing": {"call": "cell:nothing"}}
    cell = ModuleFile("cell", "cell.mod", NOTHING)
    with driven(overrides=over, modules=[cell]) as (robot, controller):
        robot.call("nothing")
        since = controller.now
        for _ in range(10):
            robot.call("nothing")
        print(f"call of a routine: {100 * (controller.now - since):.0f} ms each (simulated)")


if __name__ == "__main__":
    client()
    reading()
    routines()
