"""Find a mutant that fails each conformance program of the runtime.

    python tools/conformance_mutants_runtime.py [--every N] [--share PERCENT] [-v] [NAME...]

Makes mutants of machine, motion, runtime and controller until each conformance program of
tests/runtime and tests/runtime/builtins fails for one of them. A mutant counts if at most PERCENT
of all files fail with it (default 10); for a file without such a mutant, up to half of them, listed
separately. Hangs and crashes do not count. Code that the fewest files execute comes first; each
trial is a process of its own.

Exits with 1 and lists the files that no mutant fails.
"""

import argparse
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from tools.mutation.runtime import BROAD, PASSED, Campaign, all_files, outcome


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--every", type=int, default=1, help="take each N-th program only")
    options.add_argument("--share", type=float, default=10, help="per cent of programs, at most")
    options.add_argument("-v", action="store_true", help="show the mutant of each file")
    options.add_argument("file", metavar="NAME", nargs="*", help="names of programs")
    arguments = options.parse_args()
    everything = all_files()
    expected = [f for f in everything if not arguments.file or f.program.name in arguments.file]
    files = expected[:: arguments.every]
    failing = [file for file in files if outcome(file) != PASSED]
    if failing:
        raise SystemExit("not green without a mutant: " + ", ".join(map(str, failing)))
    started = time.monotonic()
    campaign = Campaign(files, everything, arguments.share)
    print(f"{len(files)} of {len(everything)} files; {campaign.limit} failed at most", flush=True)

    def tell(file):
        mutant, count = campaign.shown.get(file, (None, 0))
        if arguments.v:
            print(f"{file}: {mutant} ({count} failed)" if mutant else f"{file}: -", flush=True)

    campaign.search(tell)
    own = len(campaign.shown)
    if campaign.left:
        campaign.broader(BROAD)
        campaign.search(tell)
    spent = time.monotonic() - started
    print(f"{own} failed for a mutant of few files, {len(campaign.shown) - own} for a broad one,")
    print(f"{len(campaign.left)} for none; {campaign.tried} mutants, {spent:.0f} s")
    for file in campaign.left:
        print(file)
    raise SystemExit(1 if campaign.left else 0)


if __name__ == "__main__":
    main()
