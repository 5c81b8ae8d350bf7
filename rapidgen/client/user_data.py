"""`robot.data`: PERS of the robot's own program, as a mapping."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from rapidgen.client.flows.data import Datum


@dataclass(frozen=True, eq=False)
class CellData(Mapping[str, Datum]):
    """Entries of the configuration's `data:` by `MODULE:NAME`.

    They are read and written at the robot. Raises as `read_data` and `write_data`, so NotSupported
    for an unlisted name.
    """

    names: tuple[str, ...]
    read: Callable[[str], Datum]
    write: Callable[[str, Datum], Datum]

    def __getitem__(self, name: str) -> Datum:
        return self.read(name)

    def __setitem__(self, name: str, value: Datum) -> None:
        self.write(name, value)

    def __contains__(self, name: object) -> bool:
        return name in self.names

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.names)
