"""Emitted routines, shared by the controllers of a process.

Emission takes half of a boot, and a process that boots a driver again would emit the same Python
again. What a routine becomes depends on the options, the types of configured objects and the
modules of its task, in the order in which they came and went: together they are the key of a
program. Trees compare by identity, so that equal keys mean the very same modules.

What is kept belongs to no controller: code objects, types, constants. Modules, routines and
references to data are looked up in the program that takes the code over. Programs with undeclared
types are not kept, as their data depend on other tasks, nor is code with tracing, whose trace
points are numbered in the order of compilation.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from types import CodeType
from typing import TypeAlias

from rapidgen._compat import Self
from rapidgen.diagnostics import Diagnostic
from rapidgen.rapid.binding.names import builtin
from rapidgen.runtime.compiler.emit.access import Options
from rapidgen.runtime.compiler.link import Change, Linker
from rapidgen.runtime.compiler.support import GlobalRef
from rapidgen.runtime.compiler.symbols import CodeRole, Compiled, Data, LoadedModule, Routine
from rapidgen.runtime.values import Type, Value

PROGRAMS = 64
"""Programs (tasks of different controllers) whose code is kept."""
MOST_CHANGES = 100
"""Modules loaded and unloaded by a program whose code is kept."""


# -- Programs --------------------------------------------------------------------------------------
#
# What the code of a task depends on, and the code that is known for it.


@dataclass(frozen=True, slots=True)
class ProgramKey:
    """Everything that the code of a task's routines depends on."""

    task: str
    """Its name is part of the names of Python files, and of messages."""
    options: Options
    configured: tuple[tuple[str, Type], ...]
    changes: tuple[Change, ...]
    types: tuple[Type | None, ...]
    """Types that the modules declare: code refers to these objects."""


@dataclass(slots=True, eq=False)
class EmittedProgram:
    """What is known for a key; it grows with use."""

    routines: dict[str, "EmittedRoutine"] = field(default_factory=dict)
    """By Python file name."""
    missing: tuple[Diagnostic, ...] | None = None
    """Calls of undefined routines; None: not yet searched."""


def emitted_program(task: str, linker: Linker, options: Options) -> EmittedProgram | None:
    """Return what is known for a program, None if nothing is kept for it."""
    changes = tuple(linker.changes)
    if options.tracing or len(changes) > MOST_CHANGES or not linker.small:
        return None
    configured = tuple((name, kind) for name, (kind, _) in linker.shared.configured.items())
    return _known(ProgramKey(task, options, configured, changes, linker.declared_types))


@lru_cache(maxsize=PROGRAMS)
def _known(_key: ProgramKey) -> EmittedProgram:
    return EmittedProgram()


# -- Routines --------------------------------------------------------------------------------------
#
# A routine's code, and what its global names are in another program.


Find: TypeAlias = Callable[[Linker], Value]
"""Finds an object in a program."""


class Kept:
    """Objects that the code of one routine names.

    `mark` makes the names unique in a program, and equal in all programs with the same key.
    """

    def __init__(self, mark: str) -> None:
        self.values: dict[str, Value] = {}
        self._mark = mark
        self._names: dict[int, str] = {}

    def __call__(self, value: Value) -> str:
        """Return the name of an object."""
        name = self._names.get(id(value))
        if name is None:
            name = self._names[id(value)] = f"k{len(self.values) + 1}_{self._mark}"
            self.values[name] = value
        return name


@dataclass(frozen=True, slots=True)
class EmittedRoutine:
    """The code of a routine, without the program that it was emitted for.

    Programs share its parts and do not change them.
    """

    code: CodeType
    text: str
    tokens: list[int]
    refunds: dict[int, int]
    synced: set[int]
    roles: dict[str, CodeRole]
    kept: tuple[tuple[str, Find], ...]
    """What `Kept` named."""
    needed: tuple[Find, ...]
    """Predefined and configured objects, which a linker binds as soon as it is asked."""

    @classmethod
    def of(cls, code: CodeType, compiled: Compiled, kept: Kept, linker: Linker) -> Self:
        """Keep a routine that was just compiled."""
        needed = (_needed(name, linker) for name in sorted(set(_names(code))))
        return cls(
            code,
            compiled.text,
            compiled.tokens,
            compiled.refunds,
            compiled.synced,
            compiled.roles,
            tuple((name, _find(value)) for name, value in kept.values.items()),
            tuple(find for find in needed if find is not None),
        )

    def taken_over(self, linker: Linker, routine: Routine, file: str) -> Compiled:
        """Bind what the code names in another program; return its `Compiled`."""
        assert routine.module is not None
        for find in self.needed:
            find(linker)
        linker.space.update((name, find(linker)) for name, find in self.kept)
        return Compiled(
            file,
            routine,
            routine.module,
            self.text,
            self.tokens,
            self.refunds,
            self.synced,
            self.roles,
            traced=False,
        )


def _names(code: CodeType) -> Iterator[str]:
    """Iterate over names of globals and attributes in code."""
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _names(constant)


def _find(value: Value) -> Find:
    """Return how to find a kept object: as it is, unless a program owns it."""
    if isinstance(value, LoadedModule):
        module = value.name.lower()
        return lambda linker: linker.modules[module]
    if isinstance(value, Routine) and value.module is not None:
        module, key = value.module.name.lower(), value.name.lower()
        return lambda linker: linker.modules[module].routines[key]
    return lambda _: value


def _needed(name: str, linker: Linker) -> Find | None:
    """Return how to bind a name; None for what is in every namespace.

    Hooks may have replaced a built-in in this one: it is not taken from there.
    """
    if name not in linker.space:
        return None
    known = linker.space[name]
    if isinstance(known, GlobalRef):
        data = Data(known.name, "VAR", known.type, known.dims, "global", known.key)
        return lambda linker: linker.global_ref(data)
    prefix, _, key = name.partition("_")
    if prefix == "B":
        return lambda linker: linker.routine(builtin(key))
    if prefix == "p":
        return lambda linker: linker.datum(builtin(key))
    if prefix == "c":
        return lambda linker: linker.datum(linker.names.configured[key])
    return None
