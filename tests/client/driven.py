"""AsyncRobot against our own driver, both on the virtual clock: nothing waits in real time."""

import asyncio
import functools
import itertools
import json
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
from both_clients import Simulated

from rapidgen.client import AsyncRobot, Trajectory, async_runner
from rapidgen.client.address import Address
from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.generate import build, make_system
from rapidgen.testing.asyncio_clock import VirtualLoop

BENT = [0.2, 0.1, 0.1, 0.3, 0.6, -0.2]
"""Joints of an irb120 away from every singularity."""


@functools.cache
def system_of(name, overrides):
    config = load_config(name, overrides=json.loads(overrides))
    return config, make_system(config, build(config))


def booted(name="irb120", *, seed=0, signals=(), overrides=None, modules=()):
    config, system = system_of(name, json.dumps(overrides or {}))
    # Signals of the cell are the controller's own, no part of the driver.
    system = replace(system, signals=(*system.signals, *signals))
    tasks = tuple(
        replace(task, modules=(*task.modules, *modules)) if task.motion else task
        for task in system.tasks
    )
    system = replace(system, tasks=tasks)
    controller = VirtualController(system, config.groups, seed=seed)
    controller.run_for(2.0)
    return controller, config


def robot_of(config, group=None, **options):
    chosen = group or config.groups[0]
    address = Address("controller", chosen.ports.motion, chosen.ports.state)
    return AsyncRobot(config, **{"address": address, "group": chosen.name, **options})


@contextmanager
def driven(name="irb120", *, group=0, seed=0, signals=(), overrides=None, modules=(), **options):
    """A connected robot, under the calls of a Robot, and its controller."""
    controller, config = booted(
        name, seed=seed, signals=signals, overrides=overrides, modules=modules
    )
    target = robot_of(config, config.groups[group], **options)
    with controller, Simulated(target, VirtualLoop(controller)) as robot:
        yield robot, controller


def caller_comes_late(monkeypatch, seconds):
    """From now on a call goes on so many s after what it waited for, as in a thread that gets no
    time, while everything else goes on."""
    prompt = async_runner.AsyncFlowRunner._perform

    async def late(loop, effect):
        outcome = await prompt(loop, effect)
        await asyncio.sleep(seconds)
        return outcome

    monkeypatch.setattr(async_runner.AsyncFlowRunner, "_perform", late)


def complaints(peer):
    """Entries of the event log of a virtual controller above information."""
    log = peer.log if isinstance(peer, VirtualController) else ()
    return [event for event in log if event.type.name != "INFO"]


def wave(count=None, step=0.1, speed=0.02):
    """Points from the robot's position; infinite without a count."""
    for n in itertools.count() if count is None else range(count):
        yield n * step, [0.3 * np.sin(n * speed)] * 6


def wiggle(robot, size=0.05):
    """From where the robot stands, a little way and back, inside all limits."""
    group = robot.group
    here = np.array(robot.state.joints)
    wire = group.to_wire(here[None])[0]
    middle = np.array([(joint.lower + joint.upper) / 2 for joint in group.joints])
    step = np.where(wire > middle, -size, size)
    matrix = np.array([group.map.to_urdf(wire + k * step) for k in (0, 1, 0.5, 0)])
    return Trajectory.from_points(matrix, seconds=1.0, names=group.names).timed(group, 0.5)
