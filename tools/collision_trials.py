"""Trials of the proof between samples: a thin plate and a needle, against dense samples.

Each trial has a random plate of 1 mm, 10 to 300 mm wide, in the workspace of an IRB 120 with a
needle of 2 mm diameter, and a random joint move of 0.1 to 1.2 rad. The truth are the distances at
4,001 samples of the move. A contact is missed if a sample touches and the proof reports none; it is
false if no sample touches and the proof reports a contact or cannot decide.

    python tools/collision_trials.py [TRIALS] [SEED]
"""

import sys
import time

import numpy as np

from rapidgen.axes import frames
from rapidgen.collision import shapes
from rapidgen.collision.path import Path
from rapidgen.collision.proof import prove
from rapidgen.collision.robot import frames_of_chain
from rapidgen.collision.scene import Body, Pair, Scene
from rapidgen.collision.tree import WORLD, Tree
from rapidgen.config.load import load_config

SAMPLES = 4001


def main(trials: int, seed: int) -> int:
    """Run the trials and print a summary; return 1 if a contact was missed."""
    group = load_config("irb120").groups[0]
    robot = frames_of_chain(group, frames.IDENTITY, 0, 0)
    tree = Tree(robot.nodes, len(group.joints))
    node, flange = robot.flange
    needle = shapes.capsule(0.001, 0.1, frames.compose(flange, ((0.0, 0.0, 0.05), frames.UNIT)))
    rng = np.random.default_rng(seed)
    low = np.array([joint.lower for joint in group.joints])
    high = np.array([joint.upper for joint in group.joints])
    contacts = missed = false = queries = 0
    late = spent = 0.0
    for _ in range(trials):
        start = rng.uniform(low, high)
        way = rng.normal(size=len(low))
        end = np.clip(start + way / np.linalg.norm(way) * rng.uniform(0.1, 1.2), low, high)
        middle = tree.poses(((start + end) / 2)[None])[1][0, node]
        turn = rng.normal(size=4)
        q1, q2, q3, q4 = (turn / np.linalg.norm(turn)).tolist()
        x, y, z = (middle + rng.uniform(-0.1, 0.1, 3)).tolist()
        width, depth = rng.uniform(0.01, 0.3, 2)
        plate = shapes.box(width, depth, 0.001, ((x, y, z), (q1, q2, q3, q4)))
        bodies = [Body("needle", node, (needle,)), Body("plate", WORLD, (plate,))]
        scene = Scene(tree, bodies, [Pair(0, 1, 0.0)])
        path = Path.linear(np.array([0.0, 1.0]), np.stack([start, end]))
        began = time.process_time()
        proof = prove(path, scene)
        spent += time.process_time() - began
        queries += proof.queries
        samples = path.at(np.linspace(0.0, 1.0, SAMPLES))
        far = scene.body_distances(samples)[:, 0]
        touching = np.flatnonzero(far <= 0)
        contacts += bool(len(touching))
        if len(touching):
            missed += proof.is_free
            if not proof.is_free:
                late = max(late, proof.violations[0].time - touching[0] / (SAMPLES - 1))
        else:
            false += not proof.is_free
    free = trials - contacts
    print(f"{trials} trials, {contacts} contacts, {missed} missed, ", end="")
    print(f"{false} of {free} free ones not proved ({100 * false / max(free, 1):.2f} %)")
    print(f"{queries / trials:.1f} distances and {1000 * spent / trials:.2f} ms a trial, ", end="")
    print(f"first contact at most {1000 * late:.1f} ms after the samples' (of a move of 1 s)")
    return 1 if missed else 0


if __name__ == "__main__":
    arguments = [int(word) for word in sys.argv[1:3]]
    sys.exit(main(*arguments, *(10_000, 1)[len(arguments) :]))
