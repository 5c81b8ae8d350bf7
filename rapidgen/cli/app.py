"""The `rapidgen` command: finds the verb, shows diagnostics, sets the exit code.

Exit codes: 0 done or clean, 1 findings, failed or refused, 2 bad input or usage.
"""

import errno
import gc
import json
import os
import signal
import sys
from collections.abc import Callable, Sequence
from functools import wraps
from importlib import import_module
from typing import Annotated

import typer
from typer.exceptions import TyperException

from rapidgen import __version__, _extras
from rapidgen.cli.option_values import PlainCommand, PlainGroup
from rapidgen.cli.terminal import use_colour
from rapidgen.cli.verbosity import set_up
from rapidgen.diagnostics import Diagnostic, DiagnosticError, as_data, error, render

# Each verb is a file of its own, imported when it is asked for; its help begins with the
# sentence that stands here (a test compares).
VERBS = {
    "robots": "List the shipped models.",
    "new": "Write a commented configuration that checks and builds.",
    "check": "Say everything that is wrong with configurations and RAPID.",
    "explain": "Explain a diagnostic's code or a controller's event number.",
    "schema": "Print the JSON schema of the configuration file.",
    "build": "Generate the driver for one controller.",
    "fmt": "Format RAPID: keywords in upper case, four spaces a level, comments kept.",
    "run": "Run RAPID on the virtual clock.",
    "sim": "Run a virtual controller in real time.",
    "test": "Prove the driver for this robot: every behaviour, stops and faults in many schedules.",
    "probe": "Write a module that asks a controller what is only assumed about it.",
    "move": "Move a robot to joints, to a pose, or along a file.",
    "jog": "Move joints or the tool a little from where they are: at most 11.4 deg or 100 mm.",
    "pose": "Show where the tool is in the work object, and the joints; as `move` takes them.",
    "stop": "Stop the robot: every motion group, or one.",
    "monitor": "Watch a robot: joints against limits, mode, rate, jitter, last event.",
    "record": "Write every joint message to a CSV: `time,<joint names>` in s and rad (m).",
    "status": "Show a controller: mode, motors, speed, tasks, pointers.",
    "log": "Show and explain a controller's event log.",
    "start-program": "Start the program of a controller. THE ROBOT MAY MOVE.",
    "stop-program": "Stop the program of a controller.",
    "io": "Show signals of a driver or a controller, or set one.",
    "symbols": "Show a controller's RAPID data, or set one.",
    "backup": "Bring a backup of a controller here, which `sim` reads.",
    "plot": "Draw joints over time, and how far the second file is from the first.",
    "view": "Show a robot or a recording in the browser, read only.",
    "plan": "Show what `deploy` would do: files, cfg instances, restarts.",
    "deploy": "Put the driver on one or several controllers: backup, upload, verify, switch.",
    "rollback": "Go back to the set before the last deployment, or to backup ID.",
    "uninstall": "Go back to the state before the first deployment.",
    "doctor": "Look at a controller: reach, ports, names, RobotWare, disk, what runs.",
    "ros2": "Write a ROS 2 package: launch files, URDF, SRDF and MoveIt configuration.",
    "ros1": "Write a catkin package for the unmodified ROS-Industrial nodes.",
    "demo": "Build a driver, boot it on a virtual controller, move it, and report.",
}

# What the machine refuses is said by RG903. An error of another kind that has no file is a fault of
# the program and is left to fly.
_MACHINE = {
    errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EROFS, errno.EMFILE, errno.ENFILE
}  # fmt: skip
_BAD_PATH = {
    errno.ENOENT, errno.ENOTDIR, errno.EISDIR, errno.ENAMETOOLONG, errno.ELOOP, errno.EACCES,
    errno.EEXIST
}  # fmt: skip

# Options that may stand without a value.
_OPTIONAL_VALUES = {"--profile": "--profile=-"}


def run(arguments: list[str] | None = None) -> None:
    """Entry point: run one verb and leave with its exit code."""
    text = sys.argv[1:] if arguments is None else arguments
    _prepare_streams()
    try:
        code = main([_OPTIONAL_VALUES.get(word, word) for word in text])
    except BrokenPipeError:
        # While it said what was wrong: that reader has gone, too.
        code = _unheard()
    # Python would look through all that is left for rings before it ends.
    gc.freeze()
    sys.exit(code)


def main(text: list[str]) -> int:
    """Run one verb; its exit code."""
    as_json = asks_json(text)
    # There 2 means that there is something to do.
    usage = 1 if "--detailed-exitcode" in text else 2
    text = set_up(text)
    if "" in text:
        _show((_empty_argument(),), as_json)
        return usage
    command = typer.main.get_command(_app(text))
    # Who types nothing wants to know what there is.
    text = text or ["--help"]
    try:
        result = command.main(args=text, prog_name="rapidgen", standalone_mode=False)
        sys.stdout.flush()
    except DiagnosticError as fault:
        _show(fault.diagnostics, as_json)
        return min(fault.exit_code, usage)
    except TyperException as fault:
        _show((_usage(fault, text),), as_json)
        return usage
    except (_GivenUp, KeyboardInterrupt, typer.Abort):
        if as_json:
            _show((_given_up(),), as_json)
        else:
            sys.stderr.write("\nstopped\n")
        return 130
    except BrokenPipeError:
        return _unheard()
    except SystemExit as left:
        # typer's own answer to a broken pipe; it leaves so for nothing else but completion.
        if isinstance(left.__context__, BrokenPipeError):
            return _unheard()
        raise
    except ModuleNotFoundError as fault:
        lacking = _extras.missing(fault)
        if lacking is None:
            raise
        _show((lacking,), as_json)
        return usage
    except OSError as fault:
        if fault.filename is None and fault.errno not in _MACHINE | {errno.ENOENT}:
            raise
        return min(_refused(fault, as_json), usage)
    return result if isinstance(result, int) else 0


def _prepare_streams() -> None:
    """A closed stream takes everything; what a terminal's encoding lacks is written as a code."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
        else:
            stream.reconfigure(errors="backslashreplace")


def _app(text: list[str]) -> typer.Typer:
    """The command with the asked verb as it is, and the others by name and sentence only."""
    requested = next((word for word in text if not word.startswith("-")), "")
    completing = "_RAPIDGEN_COMPLETE" in os.environ
    app = typer.Typer(
        name="rapidgen",
        cls=PlainGroup,
        help="RAPID drivers for ABB robots: generate, run, deploy, drive.",
        rich_markup_mode=None,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"]},
    )
    app.callback()(_root)
    for verb, sentence in VERBS.items():
        complete = completing or verb == requested
        app.command(verb, cls=PlainCommand)(
            _interruptible(function(verb)) if complete else _named(sentence)
        )
    return app


class _GivenUp(Exception):
    """Ctrl-C in a verb; typer would turn it into an exit code without a word."""


def _interruptible(verb: Callable[..., object]) -> Callable[..., object]:
    @wraps(verb)
    def carried_out(*arguments: object, **options: object) -> object:
        try:
            return verb(*arguments, **options)
        except KeyboardInterrupt as given_up:
            raise _GivenUp from given_up

    return carried_out


def function(verb: str) -> Callable[..., object]:
    """The function behind a verb."""
    name = verb.replace("-", "_")
    result: Callable[..., object] = getattr(import_module(f"rapidgen.cli.{name}"), name)
    return result


def _named(sentence: str) -> Callable[[], None]:
    def verb() -> None:
        pass

    verb.__doc__ = sentence
    return verb


def _version(requested: bool) -> None:
    if requested:
        typer.echo(f"rapidgen {__version__}")
        raise typer.Exit


def _root(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version.")
    ] = False,
    verbose: Annotated[
        int,
        typer.Option(
            "--verbose", "-v", count=True, show_default=False, help="Say what is done; -vv: all."
        ),
    ] = 0,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress, errors only.")] = False,
) -> None:
    # Taken out by `loudness.set_up` before; here for the help.
    pass


def _unheard() -> int:
    """The reader has gone (`| head`): nothing is left to say, and nobody to say it to."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, sys.stdout.fileno())
    os.dup2(nowhere, sys.stderr.fileno())
    return 128 + signal.SIGPIPE


def _refused(fault: OSError, as_json: bool) -> int:
    """Say what the operating system refused; the exit code."""
    if fault.filename is not None:
        message, help = f"cannot use {fault.filename}", "free it, or name another one"
    elif fault.errno in _MACHINE:
        # What could not be written to stdout must not be tried again when Python ends.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        message, help = "cannot go on", "look at where the output goes, and at the disk"
    else:
        message, help = "cannot go on", "is the folder that you are in still there?"
    text = f"{message}: {fault.strerror}"
    _show((error("RG903", None, text, help),), as_json)
    return 2 if fault.errno in _BAD_PATH else 1


def _given_up() -> Diagnostic:
    return error("RG906", None, "stopped by Ctrl-C, or by a no", "the same command begins anew")


def _empty_argument() -> Diagnostic:
    return error(
        "RG901",
        None,
        "an argument is empty",
        "is a variable of your shell not set? The folder you are in is called `.`",
    )


def asks_json(text: Sequence[str]) -> bool:
    """Whether stdout is read by a program: then errors are JSON there, too."""
    return "--json" in text


def _show(findings: tuple[Diagnostic, ...], as_json: bool) -> None:
    if as_json:
        sys.stdout.write(json.dumps({"errors": as_data(findings)}, ensure_ascii=False) + "\n")
    else:
        sys.stderr.write(render(findings, colour=use_colour()))


def _usage(fault: TyperException, text: list[str]) -> Diagnostic:
    context = getattr(fault, "ctx", None)
    # An option without its value is told without a context: then by what was typed.
    typed = " ".join(["rapidgen", *(word for word in text[:1] if not word.startswith("-"))])
    path = context.command_path if context is not None else typed
    # pydantic's words where a type is checked; they are no user's.
    message = (fault.format_message() or "nothing to do").rstrip(".").replace("Value error, ", "")
    message = message.replace("Input should be", "it must be").replace("invalid value: ", "")
    return error(
        "RG901",
        None,
        message[0].lower() + message[1:],
        f"`{path} --help` lists its commands and options",
    )
