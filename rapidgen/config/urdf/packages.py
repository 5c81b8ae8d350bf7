"""Find the folder of a package for `$(find PACKAGE)` without ROS.

Order: the configuration's `packages`, `--package-path`, AMENT_PREFIX_PATH, ROS_PACKAGE_PATH, then
upwards from the robot file. The name in its package.xml identifies a package.
"""

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from rapidgen._reading import open_foreign

MAX_FOLDERS = 20_000
MAX_DEPTH = 6
_NAME = re.compile(rb"<name>\s*([^<\s]+)\s*</name>")
_SKIPPED = frozenset({".git", "build", "log", "node_modules", "__pycache__", "meshes", ".venv"})


def is_package(folder: Path) -> bool:
    """True if a folder is a ROS package."""
    return (folder / "package.xml").is_file()


class PackageNotFound(LookupError):
    """No folder found for a package; the message lists the search paths."""


@dataclass
class Packages:
    """Find packages; remember those used and those found twice."""

    explicit: Mapping[str, Path]
    paths: Sequence[Path]
    start: Path
    environment: Mapping[str, str] = field(default_factory=lambda: dict(os.environ))
    used: dict[str, Path] = field(default_factory=dict)
    doubles: dict[str, tuple[Path, Path]] = field(default_factory=dict)
    _scans: dict[Path, dict[str, list[Path]]] = field(default_factory=dict)

    def find(self, name: str) -> Path:
        """Return the folder of a package.

        Raises PackageNotFound. The path is absolute: xacro takes a relative one from the folder of
        the including file.
        """
        self.used[name] = self._find(name).absolute()
        return self.used[name]

    def allows(self, file: Path) -> bool:
        """True if a description may read a file, by its folder.

        Allowed folders are that of the description (of its package, if it is in one), the packages
        that were configured or found, and `--package-path`. A link to another place is followed
        only within a colcon workspace, which consists of links (`--symlink-install`).
        """
        own = next((f for f in (self.start, *self.start.parents) if is_package(f)), self.start)
        folders = [own, *self.explicit.values(), *self.paths, *self.used.values()]
        real = file.resolve()
        if any(real.is_relative_to(folder.resolve()) for folder in folders):
            return True
        written = Path(os.path.abspath(file))
        prefixes = [p for p in self.environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if p]
        return any(written.is_relative_to(os.path.abspath(prefix)) for prefix in prefixes)

    def _find(self, name: str) -> Path:
        if name in self.explicit:
            if self.explicit[name].is_dir():
                return self.explicit[name]
            raise PackageNotFound(
                f"package '{name}': the configured folder {self.explicit[name]} does not exist"
            )
        searched: list[str] = []
        for label, folders in self._places(name):
            searched.append(label)
            if folders:
                if len(folders) > 1:
                    self.doubles.setdefault(name, (folders[0], folders[1]))
                return folders[0]
        where = "; ".join(searched)
        raise PackageNotFound(f"package '{name}' was not found (searched: {where})")

    def _places(self, name: str) -> Iterator[tuple[str, list[Path]]]:
        both = [folder for path in self.paths for folder in self._scan(path).get(name, [])]
        if self.paths:
            yield "--package-path " + ", ".join(map(str, self.paths)), both
        prefixes = [p for p in self.environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if p]
        for prefix in prefixes:
            share = Path(prefix) / "share"
            marker = share / "ament_index" / "resource_index" / "packages" / name
            yield f"AMENT_PREFIX_PATH {prefix}", [share / name] if marker.exists() else []
        roots = [p for p in self.environment.get("ROS_PACKAGE_PATH", "").split(os.pathsep) if p]
        for root in roots:
            yield f"ROS_PACKAGE_PATH {root}", self._scan(Path(root)).get(name, [])
        for folder in (self.start, *self.start.parents):
            if (folder / "package.xml").is_file():
                # The file is inside a package: that one and its neighbours.
                match = self._scan(folder.parent).get(name, [])
                yield f"next to {folder}", match
                if (folder.parent.parent / "package.xml").is_file():
                    continue
                return
        yield f"upwards from {self.start}", []

    def _scan(self, root: Path) -> dict[str, list[Path]]:
        if root not in self._scans:
            known: dict[str, list[Path]] = {}
            for count, folder in enumerate(_folders(root, 0)):
                if count > MAX_FOLDERS:
                    break
                name = package_name(folder)
                if name:
                    known.setdefault(name, []).append(folder)
            self._scans[root] = known
        return self._scans[root]


def _folders(root: Path, depth: int) -> Iterator[Path]:
    yield root
    if depth >= MAX_DEPTH or (depth and (root / "package.xml").is_file()):
        return
    try:
        inside = sorted(entry.name for entry in os.scandir(root) if entry.is_dir())
    except OSError:
        return
    for name in inside:
        if name not in _SKIPPED:
            yield from _folders(root / name, depth + 1)


def package_of(folder: Path) -> Path | None:
    """Return the package of a folder, links followed."""
    real = folder.resolve()
    return next((f for f in (real, *real.parents) if (f / "package.xml").is_file()), None)


def package_name(folder: Path) -> str:
    """Return the name in a folder's package.xml, or an empty text."""
    try:
        with open_foreign(folder / "package.xml") as stream:
            hit = _NAME.search(stream.read(20_000))
    except OSError:
        return ""
    return hit[1].decode("utf-8", "replace") if hit else ""
