"""Combine shipped model, user file and overrides into one tree."""

from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

from rapidgen._data import data_folder
from rapidgen._json import members, number, text
from rapidgen.config.layers import (
    Overrides,
    canonical,
    group_names,
    merge,
    override_tree,
)
from rapidgen.config.registry import find_shipped, is_path
from rapidgen.config.variant_model import PATH, label, model_text, named
from rapidgen.config.yaml_tree import (
    MappingNode,
    Node,
    ScalarNode,
    decode,
    parse,
    read_bytes,
    to_python,
)
from rapidgen.diagnostics import Diagnostic, Span, error, refusal

Figures = dict[tuple[str, str], float]
_IDENTITY = ("task", "mechanical_unit", "ports")


@dataclass(frozen=True, slots=True)
class ShippedBasis:
    """The shipped model below a group; `known` has its figures.

    The keys of `known` are (axis, figure).
    """

    model: str
    known: Figures


@dataclass(slots=True)
class Assembly:
    """One canonical tree, its input files, and the basis of each group."""

    path: Path
    root: MappingNode
    bases: dict[str, ShippedBasis] = field(default_factory=dict)
    inputs: list[tuple[str, bytes]] = field(default_factory=list)
    found: list[Diagnostic] = field(default_factory=list)


def assemble(
    path_or_name: str | Path, overrides: Overrides, content: bytes | None = None
) -> Assembly:
    """Read a file or a shipped model with everything that it is based on.

    `content` counts in place of the file's, as that of an editor that has not saved it.
    """
    text = str(path_or_name)
    shipped = not isinstance(path_or_name, Path) and not is_path(text)
    path = find_shipped(text) if shipped else Path(text)
    made = Assembly(path, MappingNode({}, Span(text, 1, 1)))
    user = _read(path, made, content) if not shipped else _model(text, made)
    over, over_inputs = override_tree(overrides)
    chosen = over if _text(over, "model") else user
    base_name = _text(chosen, "model")
    if base_name:
        made.root = _shipped(base_name, made, chosen.entries["model"][1].span)
        _rest_on(made, base_name, made.root)
    elif shipped or path.parent == data_folder("robots"):
        _rest_on(made, text if shipped else path.stem, canonical(user, ()).root)
    for layer in (user, over) if over.entries else (user,):
        moved = canonical(layer, group_names(made.root))
        made.found += moved.found
        made.root = merge(made.root, moved.root)
    _group_models(made)
    made.inputs += over_inputs
    return made


def _rest_on(made: Assembly, model: str, root: MappingNode) -> None:
    for name in group_names(root):
        made.bases[name] = ShippedBasis(model, _figures(_group(root, name)))


def _group(root: MappingNode, name: str) -> MappingNode:
    groups = root.entries["groups"][1]
    assert isinstance(groups, MappingNode)
    group = groups.entries[name][1]
    assert isinstance(group, MappingNode)
    return group


def _figures(group: MappingNode) -> Figures:
    joints = members(members(to_python(group))["joints"])
    return {
        (text(joint["axis"]), figure): number(joint[figure])
        for joint in map(members, joints.values())
        for figure in ("lower", "upper", "speed", "acceleration")
        if figure in joint and not isinstance(joint[figure], str)  # a placeholder
    }


def display_path(path: Path) -> str:
    """Return the path for messages, relative if inside the working folder."""
    try:
        return str(path.absolute().relative_to(Path.cwd()))
    except ValueError:
        return str(path)


def _read(path: Path, made: Assembly, content: bytes | None = None) -> MappingNode:
    displayed = display_path(path)
    data = read_bytes(path, displayed) if content is None else content
    return _parsed(path.name, data, displayed, made)


def _model(name: str, made: Assembly, span: Span | None = None) -> MappingNode:
    """Return the tree of a shipped model, or of a known variant."""
    path = find_shipped(name, span)
    variant = named(name) if path == PATH else None
    if variant is None:
        return _read(path, made)
    return _parsed(f"{name}.yaml", model_text(variant).encode(), label(name), made)


def _parsed(name: str, data: bytes, displayed: str, made: Assembly) -> MappingNode:
    made.inputs.append((name, data))
    root, faults = _known_keys(data, displayed)
    made.found += faults
    return root


def keys_of(
    data: bytes,
    displayed: str,
    what: str = "a configuration",
    such: str = "such as `model: irb120`; `rapidgen schema` has them all",
) -> tuple[MappingNode, list[Diagnostic]]:
    """Return the keys of a YAML file, and its non-fatal faults.

    An empty file has no keys.

    Raises DiagnosticError (RG002, RG003, RG006).
    """
    root, faults = parse(decode(data, displayed), displayed)
    if isinstance(root, ScalarNode) and root.value is None:
        return MappingNode({}, root.span), faults
    if not isinstance(root, MappingNode):
        raise refusal(
            "RG006",
            root.span,
            f"{what} is a mapping of keys",
            such,
            label="not a mapping",
        )
    return root, faults


# Groups share models, and reading one takes most of the time that loading a configuration takes.
_known_keys = lru_cache(maxsize=16)(keys_of)


def _text(root: MappingNode, key: str) -> str:
    """Return a text at the top of a raw tree, or an empty one."""
    entry = root.entries.get(key)
    if entry and isinstance(entry[1], ScalarNode) and isinstance(entry[1].value, str):
        return entry[1].value
    return ""


def _shipped(name: str, made: Assembly, span: Span | None = None) -> MappingNode:
    return canonical(_model(name, made, span), ()).root


def _group_models(made: Assembly) -> None:
    """Merge groups with a `model:` of their own over that model's group."""
    entry = made.root.entries.get("groups")
    if not entry or not isinstance(entry[1], MappingNode):
        return
    groups: dict[str, tuple[Span, Node]] = {}
    for name, (place, group) in entry[1].entries.items():
        model = _text(group, "model") if isinstance(group, MappingNode) else ""
        if model and isinstance(group, MappingNode):
            below = _shipped(model, made, group.entries["model"][1].span)
            choices = group_names(below)
            chosen = name if name in choices else choices[0] if len(choices) == 1 else ""
            if chosen:
                base = _group(below, chosen)
                made.bases[name] = ShippedBasis(model, _figures(base))
                # A model does not decide the place of a group on a controller.
                saved = {k: v for k, v in base.entries.items() if k not in _IDENTITY}
                group = merge(MappingNode(saved, base.span), group, ("groups", name))
            else:
                made.found.append(
                    error(
                        "RG010",
                        place,
                        f"model '{model}' has the groups {', '.join(choices)}, none is '{name}'",
                        f"name the group {' or '.join(choices)}, or put `model:` at the top",
                        label="which of them?",
                    )
                )
        groups[name] = (place, group)
    complete = MappingNode(groups, entry[1].span)
    made.root = MappingNode({**made.root.entries, "groups": (entry[0], complete)}, made.root.span)
