"""Checks of a host on which a driver may run, over its state port alone.

Only the state port is opened: a driver serves the newest client of its motion and control ports, so
that a connection there would end another client's motion.
"""

import socket
from collections.abc import Iterator

from rapidgen.client import Robot, RobotError, State
from rapidgen.client.core.motion import fix_of
from rapidgen.deploy.doctor import Check
from rapidgen.wire.simple_message.spec import Mode, TriState

_SERVICES = {443: "rwss://", 80: "rws://", 21: "ftp://", 22: "sftp://"}
"""Ports of a controller's other services, with the scheme that rapidgen has for them."""
_STATES = 5
"""States from which the rate of messages is measured."""
_SLOW = 0.8
"""Share of the driver's rate below which messages are missing."""


def host_checks(robot: Robot, build_id: str = "", *, timeout: float = 0.5) -> Iterator[Check]:
    """Yield the checks of a driver that `robot`, which only reads, may reach.

    `build_id` is that of the configuration, if there is one. `timeout` s is the wait for each of
    the controller's other services.
    """
    host = robot.address.host
    try:
        robot.connect()
        state = robot.next_state()
        for _ in range(_STATES):
            state = robot.next_state()
    except RobotError as fault:
        first = fault.diagnostics[0]
        yield Check("driver", "fail", first.message, first.help)
    else:
        yield Check("driver", "ok", f"{robot.address}: the state port answers")
        yield from _driver(robot, build_id)
        yield from _state(state)
        yield _rate(robot, state)
    finally:
        robot.close()
    yield from _services(host, timeout)


def _driver(robot: Robot, build_id: str) -> Iterator[Check]:
    hello = robot.driver.hello
    if hello is None:
        yield Check(
            "build",
            "warn",
            "another driver than rapidgen's answers, such as abb_driver",
            "`rapidgen deploy CONFIG --to URL` installs the driver of a configuration",
        )
        return
    found = f"build {hello.build_id} of rapidgen {robot.driver.version}"
    if build_id and hello.build_id != build_id:
        yield Check(
            "build",
            "warn",
            f"{found} runs, the configuration gives {build_id}",
            "`rapidgen plan` shows the difference; after `deploy` the controller restarts",
        )
    else:
        yield Check("build", "ok", found)
    yield Check("joints", "ok", f"{hello.joint_count}: {', '.join(robot.group.names)}")
    for lacking in robot.driver.cannot:
        help = "set `profile: full` in the configuration, build and deploy"
        yield Check("features", "warn", f"the driver cannot {lacking}", help)


def _state(state: State) -> Iterator[Check]:
    status = state.status
    fix = fix_of(status.error, "")
    if status.e_stopped is TriState.TRUE:
        yield Check("state", "fail", str(status), "release the emergency stop, then motors on")
    elif status.error is not None and fix:
        yield Check("state", "fail", f"{status.error.text}, no motion is possible", fix)
    elif status.drives is TriState.FALSE:
        yield Check("state", "warn", str(status), "switch the motors on")
    elif status.motion_possible is TriState.FALSE:
        help = "start the program (PP to Main, Start); in manual mode hold the enabling device"
        yield Check("state", "warn", f"{status}: no motion is possible", help)
    else:
        yield Check("state", "ok", str(status))
    if status.mode is Mode.UNKNOWN:
        yield Check("mode", "unknown", "the driver does not report the mode", "look at the pendant")


def _rate(robot: Robot, state: State) -> Check:
    hello = robot.driver.hello
    found = f"{state.rate:.0f} joint messages a second"
    if hello is not None and hello.state_period > 0:
        expected = 1 / hello.state_period
        if state.rate < _SLOW * expected:
            help = "look at the network and at the load of the controller"
            return Check("rate", "warn", f"{found}, {expected:.0f} are expected", help)
    return Check("rate", "ok", found)


def _services(host: str, timeout: float) -> Iterator[Check]:
    """Look which other services of the controller accept connections; none is logged in to."""
    answering = []
    for port, scheme in _SERVICES.items():
        try:
            socket.create_connection((host, port), timeout).close()
        except OSError:
            continue
        answering.append(f"{scheme}{host}")
    if answering:
        yield Check("services", "ok", f"port open for {', '.join(answering)}")
        return
    yield Check(
        "services",
        "unknown",
        "no port of Robot Web Services, FTP or SFTP is open from here",
        "for `deploy` and `commission --rws`, look at the firewall and the controller's services",
    )
