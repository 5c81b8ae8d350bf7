"""Identity of this rapidgen build.

Results are combined only if the same build produced them.
"""

import hashlib
import platform
from functools import cache
from pathlib import Path

import numpy as np

import rapidgen
from rapidgen._data import data_folder

LEFT_OUT = ("__pycache__", "_data")


@cache
def identity() -> str:
    """Return 16 hexadecimal digits over program text, data and dependencies."""
    digest = hashlib.sha256(f"{platform.python_version()} {np.__version__}".encode())
    package = Path(rapidgen.__file__).parent
    for folder in (package, data_folder("templates"), data_folder("robots")):
        for path in sorted(folder.rglob("*")):
            parts = path.relative_to(folder).parts
            hidden = any(part in LEFT_OUT or part.startswith(".") for part in parts)
            if not hidden and path.is_file():
                data = path.read_bytes()
                digest.update(f"{'/'.join(parts)} {len(data)}\n".encode() + data)
    return digest.hexdigest()[:16]
