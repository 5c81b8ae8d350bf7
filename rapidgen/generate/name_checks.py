"""Check configured names against RAPID's and the generated modules'."""

import re

from rapidgen.config.assemble import display_path, keys_of
from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.config.yaml_tree import MappingNode, Node, ScalarNode, SequenceNode
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Span, error
from rapidgen.generate import layout
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.syntax.lexer import KEYWORDS

_OURS = re.compile(r"ros_|main$", re.IGNORECASE)
_CODE = re.compile(r'"[^"\n]*"|![^\n]*')
_DECLARED = re.compile(r"\b([A-Za-z]\w*)[ \t]+([A-Za-z]\w*)")
_PROCEDURE = re.compile(r"\bPROC[ \t]+(\w+)")
_THEIR_TYPES = frozenset({"tooldata", "wobjdata", "loaddata"})


def check_tasks(config: RobotConfig) -> None:
    """Reject a motion task with the name of a driver task.

    Raises DiagnosticError RG012.
    """
    ours = {
        layout.task_name(config, group, role).casefold()
        for group in config.groups
        for role in layout.ROLES
        if role.task
    }
    result = [
        error(
            "RG012",
            place_of_value(config, group.name, ("task",), group.task),
            f"the motion task of group '{group.name}' and a task of the driver are both "
            f"{group.task}",
            "`task:` names the controller's own motion task, as T_ROB1; the driver brings "
            "its tasks with it",
        )
        for group in config.groups
        if group.task.casefold() in ours
    ]
    if result:
        raise DiagnosticError(result)


def naming(config: RobotConfig, group: GroupConfig, modules: list[str]) -> list[Diagnostic]:
    """Return names of tool, work object and payload that clash: RG106.

    RAPID compares names without case; a name of a routine hides one of its module [K §2.3, 2.12].
    """
    names = {
        "tool": (group.tool.name, "tool0"),
        "work_object": (group.work_object.name, "wobj0"),
        "payload": (group.payload.name, "load0"),
        **{f"tools.{n}": (tool.name, "tool0") for n, tool in enumerate(group.tools)},
        **{f"work_objects.{n}": (w.name, "wobj0") for n, w in enumerate(group.work_objects)},
    }
    chosen = {key: name for key, (name, default) in names.items() if name != default}
    if not chosen:
        return []
    texts = [_CODE.sub("", text) for text in modules]
    # A call of a procedure looks like a declaration.
    called = {name.casefold() for text in texts for name in _PROCEDURE.findall(text)}
    declared = {
        match[2].casefold()
        for text in texts
        for match in _DECLARED.finditer(text)
        if match[1].casefold() not in _THEIR_TYPES | called
    }
    findings = []
    for number, (key, name) in enumerate(chosen.items()):
        others = [other.casefold() for other in list(chosen.values())[:number]]
        why = _why_not(name, declared, others)
        if why:
            parts: KeyPath = tuple(int(p) if p.isdigit() else p for p in (*key.split("."), "name"))
            findings.append(
                error(
                    "RG106",
                    place_of_value(config, group.name, parts, name),
                    f"`{key}.name: {name}` cannot be the name of a datum: {why}",
                    "choose another name",
                )
            )
    return findings


def _why_not(name: str, declared: set[str], others: list[str]) -> str:
    low = name.casefold()
    if name.upper() in KEYWORDS:
        return "it is a reserved word of RAPID"
    if _OURS.match(low):
        return "the driver's own names begin so"
    in_use = (*signatures.routine_names(), *signatures.type_names(), *signatures.predefined())
    if low in {each.casefold() for each in in_use}:
        return "RAPID has a type, a routine or a datum of that name"
    if low in declared:
        return "the generated modules use it"
    return "another datum of the configuration has it" if low in others else ""


# -- source locations ------------------------------------------------------------------------------

KeyPath = tuple[str | int, ...]


def place_of_value(config: RobotConfig, group: str, path: KeyPath, value: str) -> Span | None:
    """Return the place of a group's `value`, or None.

    A value from `--set` has no place.
    """
    data = next((data for name, data in config.inputs if name == config.path.name), None)
    if data is None:
        return None
    root, _ = keys_of(data, display_path(config.path))
    for complete in (("groups", group, *path), path):
        node = _at(root, complete)
        if isinstance(node, ScalarNode) and node.value == value:
            return node.span
    return None


def _at(root: Node, path: KeyPath) -> Node | None:
    node = root
    for part in path:
        if isinstance(node, MappingNode) and part in node.entries:
            node = node.entries[str(part)][1]
        elif isinstance(node, SequenceNode) and isinstance(part, int) and part < len(node.items):
            node = node.items[part]
        else:
            return None
    return node
