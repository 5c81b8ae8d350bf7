"""Find a mutant that fails each conformance program of the language.

    python tools/conformance_mutants.py [--every N] [--share PERCENT] [-v] [NAME...]

Makes mutants of the front end and of its tables (tools/mutation/front_end.py) until each
conformance program fails for one of them: it reports other findings than it announces. A mutant
counts if at most PERCENT of all files fail with it (default 10): a mutant that fails all files
does not test any of them. The remaining files (texts of the commonest kind) may have a mutant
that fails up to half of all files; these are listed separately. Hangs and crashes do not count.
Code that the fewest files execute or name comes first. Files about built-ins (2-types,
3-builtins) are tried with changed built-ins, the others with changed code.

Exits with 1 and lists the files that no mutant fails. One process, deterministic.
"""

import argparse
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from tests.rapid import conformance_files
from tools.mutation.conformance import BROAD, Campaign


def tell(stage, campaign, started):
    """Print one line on the progress of the campaign."""
    done = len(campaign.files) - len(campaign.left)
    spent = time.monotonic() - started
    print(f"{stage:10} {done:4} failed  {campaign.tried:6} mutants  {spent:4.0f} s", flush=True)


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--every", type=int, default=1, help="take each N-th program only")
    options.add_argument("--share", type=float, default=10, help="per cent of programs, at most")
    options.add_argument("-v", action="store_true", help="show the mutant of each file")
    options.add_argument("file", metavar="NAME", nargs="*", help="names of programs")
    arguments = options.parse_args()
    everything = conformance_files.all_files()
    expected = [f for f in everything if not arguments.file or f.program.name in arguments.file]
    files = expected[:: arguments.every]
    started = time.monotonic()
    campaign = Campaign(files, everything, arguments.share)
    print(f"{len(files)} of {len(everything)} files; {campaign.limit} failed at most", flush=True)
    for stage in (campaign.builtins, campaign.functions, campaign.tables):
        stage()
        tell(stage.__name__, campaign, started)
    if campaign.left:
        campaign.broader(BROAD)
        campaign.functions()
        tell("broad", campaign, started)
    for file in files:
        if file not in campaign.shown:
            print(f"NONE       {file.name}")
        elif arguments.v:
            mutant, count = campaign.shown[file]
            print(f"{count:4} failed   {file.name}   {mutant}")
    return 1 if campaign.left else 0


if __name__ == "__main__":
    sys.exit(main())
