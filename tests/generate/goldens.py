"""Write rapid_out/ after an intended change.

Run `python -m tests.generate.goldens`.
"""

import shutil
from pathlib import Path

from rapidgen.config import load_config
from rapidgen.generate import build

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "robots" / "examples").glob("*.yaml"))
GOLDENS = ROOT / "rapid_out"
_OPTIONS = ("/ROS_egm.", "/ROS_zones.")
WHOLE = ("irb2400-rw5", "two_arms_track-rw6", "irb460-rw7")


def kept(example: Path) -> dict[str, bytes]:
    """Files by path that are kept of an example's output: all, or cfg text and its options."""
    files = build(load_config(example)).files
    complete = example.stem in WHOLE
    return {
        f.path: f.data
        for f in files
        if complete or f.path.endswith(".cfg") or any(part in f.path for part in _OPTIONS)
    }


def main() -> None:
    """Put what the examples give into rapid_out/, and nothing else."""
    for folder in GOLDENS.iterdir():
        if folder.name in {path.stem for path in EXAMPLES}:
            shutil.rmtree(folder)
    for example in EXAMPLES:
        for name, data in kept(example).items():
            path = GOLDENS / example.stem / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)


if __name__ == "__main__":
    main()
