"""The `rapidgen` command: collects the verbs, shows diagnostics, sets the exit code.

Exit codes: 0 done or clean, 1 findings, failed or refused, 2 bad input or usage.
"""

import os
import sys
from importlib import import_module
from typing import Annotated

import typer
from typer.exceptions import TyperException

from rapidgen import __version__
from rapidgen.cli.terminal import use_colour
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, render

VERBS = (
    "robots",
    "new",
    "check",
    "explain",
    "schema",
    "build",
    "fmt",
    "run",
    "sim",
    "move",
    "stop",
    "monitor",
    "record",
    "plot",
    "plan",
    "deploy",
    "rollback",
    "uninstall",
    "demo",
)

# Verbs that take words of other programs' kind (`--profile` with or without a value).
_OPTIONAL_VALUES = {"--profile": "--profile=-"}

app = typer.Typer(
    name="rapidgen",
    help="RAPID drivers for ABB robots: generate, run, deploy, drive.",
    rich_markup_mode=None,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"rapidgen {__version__}")
        raise typer.Exit


@app.callback()
def _root(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    pass


for _verb in VERBS:
    app.command(_verb)(getattr(import_module(f"rapidgen.cli.{_verb}"), _verb))


def run(arguments: list[str] | None = None) -> None:
    """Entry point: run one verb and leave with its exit code."""
    words = sys.argv[1:] if arguments is None else arguments
    sys.exit(main([_OPTIONAL_VALUES.get(word, word) for word in words]))


def main(words: list[str]) -> int:
    """Run one verb; its exit code."""
    command = typer.main.get_command(app)
    try:
        result = command.main(args=words, prog_name="rapidgen", standalone_mode=False)
        sys.stdout.flush()
    except DiagnosticError as error:
        sys.stderr.write(render(error.diagnostics, colour=use_colour()))
        return error.exit_code
    except TyperException as error:
        sys.stderr.write(render([_usage(error)], colour=use_colour()))
        return 2
    except (KeyboardInterrupt, typer.Abort):
        sys.stderr.write("\nstopped\n")
        return 130
    except BrokenPipeError:
        # The reader has gone (`| head`): nothing is left to say, and nobody to say it to.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 141
    return result if isinstance(result, int) else 0


def _usage(error: TyperException) -> Diagnostic:
    context = getattr(error, "ctx", None)
    path = context.command_path if context is not None else "rapidgen"
    message = (error.format_message() or "nothing to do").rstrip(".")
    return Diagnostic(
        code="RG901",
        severity=Severity.ERROR,
        message=message[0].lower() + message[1:],
        help=f"`{path} --help` shows what can be said here",
    )
