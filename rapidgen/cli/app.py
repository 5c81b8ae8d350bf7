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
    "build": ("generation", "Generate the driver for one controller."),
    "fmt": ("fmt", "Format RAPID source files."),
    "lsp": ("lsp", "Serve editors by the language server protocol."),
