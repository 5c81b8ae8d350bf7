"""`python -m rapidgen.cli` is the `rapidgen` command."""

from rapidgen.cli.entry import run

run()
