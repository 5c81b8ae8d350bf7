"""The `rapidgen` program: find the command, show diagnostics, set the exit code.

Exit codes: 0 done or clean, 1 findings, failed or refused, 2 bad input or usage.
"""

import errno
import gc
import json
import os
import re
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
from rapidgen.cli.terminal import set_up, use_colour
from rapidgen.diagnostics import Diagnostic, DiagnosticError, as_data, error, render

# A command's module is imported only when the command is used. The sentence is shown by
# `rapidgen --help` without that import; a test compares it with the command's docstring.
COMMANDS = {
    "robots": ("configuration", "List the shipped robot models."),
    "new": ("configuration", "Write a commented configuration that checks and builds."),
    "check": ("check", "Check configurations and RAPID files."),
    "explain": ("configuration", "Explain a diagnostic code or an event number."),
    "schema": ("configuration", "Print the JSON schema of the configuration file."),
    "fit-shapes": ("configuration", "Fit convex collision shapes to the meshes of a robot."),
    "build": ("generation", "Generate the driver for one controller."),
    "fmt": ("fmt", "Format RAPID source files."),
    "export": ("export", "Write a RAPID module that runs without rapidgen."),
    "execute": ("export", "Execute a module on a controller (THE ROBOT MOVES)."),
    "run": ("run", "Run RAPID on the virtual clock."),
    "sim": ("sim", "Run a virtual controller in real time."),
    "test": ("verification", "Test the generated driver on the virtual controller."),
    "probe": ("verification", "Write a RAPID module that tests a controller's behaviour."),
    "move": ("motion", "Move a robot to joint values, to a pose or along a file."),
    "jog": ("motion", "Move joints or the tool by a small step."),
    "fit": ("fit", "Fit a dense curve by few moves within a tolerance."),
    "calibrate": ("calibration", "Measure the axes' accelerations (THE ROBOT MOVES)."),
    "commission": ("commission", "Try a robot for the first time (THE ROBOT MOVES)."),
    "report": ("commission", "Write an anonymised bundle for the developers of rapidgen."),
    "pose": ("observation", "Show the pose of the tool and the joint values."),
    "stop": ("motion", "Stop all motion groups of a robot, or one."),
    "monitor": ("observation", "Show the joints, mode and message rate of a robot live."),
    "record": ("observation", "Record the joint positions of a robot as CSV."),
    "egm": ("egm", "Check externally guided motion: frames, rate, state."),
    "status": ("controller", "Show the mode, motors, speed and tasks of a controller."),
    "log": ("controller", "Show and explain the event log of a controller."),
    "start-program": ("controller", "Start the program of a controller (THE ROBOT MAY MOVE)."),
    "stop-program": ("controller", "Stop the program of a controller."),
    "io": ("controller", "Show or set signals of a driver or a controller."),
    "symbols": ("controller", "Show or set RAPID data of a controller."),
    "load": ("load", "Load a module into a task of a controller."),
    "backup": ("controller", "Download a backup of a controller."),
    "plot": ("observation", "Plot joints over time, from one or two recordings."),
    "view": ("observation", "Show a robot or a recording in the browser, read only."),
    "plan": ("deployment", "Show what `deploy` would change on a controller."),
    "deploy": ("deployment", "Install the driver on one or several controllers."),
    "rollback": ("deployment", "Restore the driver files of an earlier deployment."),
    "uninstall": ("deployment", "Remove the driver and restore the original files."),
    "doctor": ("deployment", "Check a controller: connection, ports, RobotWare, tasks."),
    "ros2": ("generation", "Write ROS 2 packages with launch files, URDF and MoveIt."),
    "ros1": ("generation", "Write a catkin package for the ROS-Industrial nodes."),
    "lsp": ("lsp", "Serve editors by the language server protocol."),
    "dap": ("dap", "Debug RAPID in an editor: a debug adapter on stdio."),
    "demo": ("demo", "Build a driver, simulate it, move the robot and report."),
}

# Errors of the operating system that RG903 reports. Any other error without a file name is a defect
# of rapidgen, so it is not caught.
_MACHINE = {
    errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EROFS, errno.EMFILE, errno.ENFILE
}  # fmt: skip
_BAD_PATH = {
    errno.ENOENT, errno.ENOTDIR, errno.EISDIR, errno.ENAMETOOLONG, errno.ELOOP, errno.EACCES,
    errno.EEXIST
}  # fmt: skip

# Options with an optional value.
_OPTIONAL_VALUES = {"--profile": "--profile=-"}


def run(arguments: list[str] | None = None) -> None:
    """Run one command and exit with its code; the entry point."""
    text = sys.argv[1:] if arguments is None else arguments
    _prepare_streams()
    try:
        code = main([_OPTIONAL_VALUES.get(word, word) for word in text])
    except BrokenPipeError:
        # The reader of stderr has gone while a diagnostic was written.
        code = _no_reader()
    # Saves the garbage collection at exit.
    gc.freeze()
    sys.exit(code)


def main(text: list[str]) -> int:
    """Run one command and return its exit code."""
    as_json = asks_json(text)
    # With --detailed-exitcode, 2 means that there are changes.
    usage = 1 if "--detailed-exitcode" in text else 2
    text = set_up(text)
    if "" in text:
        _show((_empty_argument(),), as_json)
        return usage
    command = typer.main.get_command(_app(text))
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
    except (_Interrupted, KeyboardInterrupt, typer.Abort):
        if as_json:
            _show((_interruption(),), as_json)
        else:
            sys.stderr.write("\nstopped\n")
        return 130
    except BrokenPipeError:
        return _no_reader()
    except SystemExit as left:
        # typer exits so after a broken pipe, and otherwise only for completion.
        if isinstance(left.__context__, BrokenPipeError):
            return _no_reader()
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
        return min(_system_error(fault, as_json), usage)
    return result if isinstance(result, int) else 0


def _prepare_streams() -> None:
    """Make output never fail: replace closed streams, escape unencodable characters."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
        else:
            stream.reconfigure(errors="backslashreplace")


def _app(text: list[str]) -> typer.Typer:
    """Return the program with the requested command; the others are name and sentence only."""
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
    for command, (_, sentence) in COMMANDS.items():
        complete = completing or command == requested
        app.command(command, cls=PlainCommand)(
            _interruptible(function(command)) if complete else _placeholder(sentence)
        )
    return app


class _Interrupted(Exception):
    """Ctrl-C in a command; typer would turn it into an exit code without a message."""


def _interruptible(command: Callable[..., object]) -> Callable[..., object]:
    @wraps(command)
    def execute(*arguments: object, **options: object) -> object:
        try:
            return command(*arguments, **options)
        except KeyboardInterrupt as interrupt:
            raise _Interrupted from interrupt

    return execute


def function(command: str) -> Callable[..., object]:
    """Return the function that implements a command."""
    module = import_module(f"rapidgen.cli.{COMMANDS[command][0]}")
    result: Callable[..., object] = getattr(module, command.replace("-", "_"))
    return result


def _placeholder(sentence: str) -> Callable[[], None]:
    def command() -> None:
        pass

    command.__doc__ = sentence
    return command


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
            "--verbose",
            "-v",
            count=True,
            show_default=False,
            help="Progress messages; -vv: debug output.",
        ),
    ] = 0,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Show errors only.")] = False,
) -> None:
    # `terminal.set_up` has removed -v and -q; they are declared for the help.
    pass


def _no_reader() -> int:
    """Discard further output after a broken pipe (`| head`); return the exit code."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, sys.stdout.fileno())
    os.dup2(nowhere, sys.stderr.fileno())
    return 128 + getattr(signal, "SIGPIPE", 13)  # Windows lacks the name


def _system_error(fault: OSError, as_json: bool) -> int:
    """Report an error of the operating system; return the exit code."""
    if fault.filename is not None:
        message = f"cannot use {fault.filename}"
        help = "free it, or use another one"
        if fault.errno == errno.ENOENT:
            help = "give the path of a file that exists"
    elif fault.errno in _MACHINE:
        # Python must not try to flush stdout again at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        message, help = "cannot continue", "check the output file and the free disk space"
    else:
        message, help = "cannot continue", "check that the current folder still exists"
    text = f"{message}: {fault.strerror}"
    _show((error("RG903", None, text, help),), as_json)
    return 2 if fault.errno in _BAD_PATH else 1


def _interruption() -> Diagnostic:
    return error("RG906", None, "stopped by Ctrl-C, or by a no", "the same command begins anew")


def _empty_argument() -> Diagnostic:
    return error(
        "RG901",
        None,
        "an argument is empty",
        "set the shell variable that is empty; the current folder is `.`",
    )


def asks_json(text: Sequence[str]) -> bool:
    """True if errors are to be written to stdout as JSON."""
    return "--json" in text


def _show(findings: tuple[Diagnostic, ...], as_json: bool) -> None:
    if as_json:
        sys.stdout.write(json.dumps({"errors": as_data(findings)}, ensure_ascii=False) + "\n")
    else:
        sys.stderr.write(render(findings, colour=use_colour()))


def _usage(fault: TyperException, text: list[str]) -> Diagnostic:
    context = getattr(fault, "ctx", None)
    # An option without its value has no context: use the typed command.
    typed = " ".join(["rapidgen", *(word for word in text[:1] if not word.startswith("-"))])
    path = context.command_path if context is not None else typed
    # pydantic's wording, where it checks a type.
    message = (fault.format_message() or "nothing to do").rstrip(".").replace("Value error, ", "")
    message = message.replace("Input should be", "it must be").replace("invalid value: ", "")
    message = re.sub(r", unable to parse string as an? \w+", "", message)
    message = message.removeprefix("Invalid value: ")
    content = "commands" if path == "rapidgen" else "arguments and options"
    return error(
        "RG901",
        None,
        message[0].lower() + message[1:],
        f"`{path} --help` lists the {content}",
    )
