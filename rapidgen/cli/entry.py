"""Where the `rapidgen` command begins: a STOP goes out before anything heavy is imported."""

import sys


def run() -> None:
    """Run one verb and leave with its exit code."""
    words = sys.argv[1:]
    if words[:1] == ["stop"]:
        from rapidgen.cli.quick_stop import send

        send(words[1:])
    from rapidgen.cli.app import run as whole

    whole()
