"""Calls of routines that do not exist here, found when modules are loaded.

Trees of large systems are not walked for it: only names that are no known routine and stand, in
the tokens, where a call stands are looked for in the tree.
"""

from rapidgen.diagnostics import Diagnostic, Severity, error
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.lexer import KEYWORDS
from rapidgen.rapid.syntax.walk import walk
from rapidgen.runtime import unsupported
from rapidgen.runtime.compiler.program import Program
from rapidgen.runtime.compiler.symbols import LoadedModule

_BEFORE_STATEMENT = frozenset({";", "THEN", "DO", "ELSE", "ERROR", "UNDO", ":", ")"})
_NO_CALL = frozenset({":=", ".", "{", ":", ",", ";"})


def missing_routines(program: Program) -> list[Diagnostic]:
    """One warning for each built-in that is not available and each name that is not declared."""
    findings: dict[str, Diagnostic] = {}
    for module in program.modules.values():
        suspects = _suspects(program, module) - findings.keys()
        if not suspects:
            continue
        for routine in module.tree.routines:
            for node in walk(routine):
                if isinstance(node, n.ProcedureCall | n.FunctionCall):
                    key = node.name.lower()
                    if key in suspects and key not in findings:
                        findings[key] = _diagnostic(program, module, node)
    return list(findings.values())


def _suspects(program: Program, module: LoadedModule) -> set[str]:
    tokens = module.tree.source.tokens
    unknown = set()
    for text in {t.lower() for t in set(tokens) if t[0].isalpha()}:
        if text.upper() in KEYWORDS:
            continue
        symbol = program.find(module, text)
        routine = program.routine(symbol)
        if symbol is None or (routine is not None and routine.missing):
            unknown.add(text)
    for record in module.tree.records:
        unknown.difference_update(c.name.lower() for c in record.components)
    for declared in module.tree.routines:
        unknown.difference_update(d.name.lower() for d in declared.data)
        unknown.difference_update(p.name.lower() for p in declared.parameters)
    if not unknown:
        return unknown
    suspects = set()
    last = len(tokens) - 1
    for i, text in enumerate(tokens):
        key = text.lower()
        if key not in unknown or key in suspects:
            continue
        after = tokens[i + 1] if i < last else ""
        before = tokens[i - 1].upper() if i else ""
        starts = before in _BEFORE_STATEMENT or (before[:1].isalpha() and before not in KEYWORDS)
        if after == "(" or (starts and (after == ";" or after not in _NO_CALL)):
            suspects.add(key)
    return suspects


def _diagnostic(
    program: Program, module: LoadedModule, node: n.ProcedureCall | n.FunctionCall
) -> Diagnostic:
    routine = program.find_routine(module, node.name.lower())
    if routine is not None or node.name.lower() in unsupported.option_routines():
        return error(
            "RG403",
            module.span(node),
            f"{routine.name if routine else node.name} is not available on the virtual controller",
            label="the task stops here",
            notes=(unsupported.reason(node.name),),
            severity=Severity.WARNING,
        )
    return error(
        "RG404",
        module.span(node),
        f"{node.name} is not declared in any module of {program.name}",
        "load the module that declares it",
        label="ERR_REFUNKPRC when it is reached",
        severity=Severity.WARNING,
    )
