"""`python -m rapidgen.cli` is the `rapidgen` command."""

from rapidgen.cli.app import run

run()
