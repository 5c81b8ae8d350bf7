"""Binding: meaning of names, types, constants and arguments of RAPID.

This is the only resolver: the checker, the compiler and editors use it. It reports no errors;
unknown names and types are None. `names` has the rules. A task's modules are bound by

    task = TaskScope()
    module = task.add(parse(text))
    module.find("counter")                       # a Symbol, or None
    module.routine(node).find("i")               # as seen inside a routine
    constant(expression, module)                 # a value, or None
    match(symbol.parameters, call.arguments, fitting)
    BoundModule(module).at(12, 5)                # the symbol at a place
"""

from rapidgen.rapid.binding.arguments import (
    ArgumentFault,
    Matching,
    Pairing,
    first_fit,
    held_as,
    match,
    may_pass,
)
from rapidgen.rapid.binding.constants import NotConstant, constant, evaluate, sizes_of, value_of
from rapidgen.rapid.binding.expressions import declared_type, root, type_of
from rapidgen.rapid.binding.lookup import BoundModule
from rapidgen.rapid.binding.names import (
    DATA,
    ROUTINES,
    TYPES,
    ComponentSymbol,
    DataSymbol,
    LabelSymbol,
    ModuleScope,
    ModuleSymbol,
    RoutineScope,
    RoutineSymbol,
    Scope,
    Symbol,
    TaskScope,
    TypeSymbol,
    builtin,
    installed_objects,
)

__all__ = [
    "DATA",
    "ROUTINES",
    "TYPES",
    "ArgumentFault",
    "BoundModule",
    "ComponentSymbol",
    "DataSymbol",
    "LabelSymbol",
    "Matching",
    "ModuleScope",
    "ModuleSymbol",
    "NotConstant",
    "Pairing",
    "RoutineScope",
    "RoutineSymbol",
    "Scope",
    "Symbol",
    "TaskScope",
    "TypeSymbol",
    "builtin",
    "constant",
    "declared_type",
    "evaluate",
    "first_fit",
    "held_as",
    "installed_objects",
    "match",
    "may_pass",
    "root",
    "sizes_of",
    "type_of",
    "value_of",
]
