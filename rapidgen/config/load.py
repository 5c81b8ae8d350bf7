"""`load_config`: a file or a shipped name becomes a checked, frozen model, or all its faults."""

from collections.abc import Sequence as SequenceType
from pathlib import Path

from rapidgen.config import schema
from rapidgen.config.build import build
from rapidgen.config.draft import GroupDraft, JointDraft, Report
from rapidgen.config.layers import (
    Layer,
    Overrides,
    canonical,
    group_names,
    merge,
    override_tree,
)
from rapidgen.config.model import Link, RobotConfig
from rapidgen.config.registry import find_shipped, is_path
from rapidgen.config.tree import Mapping, Node, Scalar, decode, error, parse, read_bytes, to_python
from rapidgen.config.validate import validate
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, Span

Inputs = list[tuple[str, bytes]]


def load_config(
    path_or_name: str | Path,
    *,
    overrides: Overrides = (),
    package_paths: SequenceType[str | Path] = (),
) -> RobotConfig:
    """Read and check a configuration.

    An argument with a suffix or a separator is a path, else the name of a shipped model.
    `overrides` are "key.path=value" texts or a mapping of key paths to values;
    `package_paths` are folders in which `$(find PACKAGE)` of a xacro file looks.
    Raises DiagnosticError with everything that is wrong; warnings and notes are in the
    result's `diagnostics`.
    """
    text = str(path_or_name)
    own_model = "" if isinstance(path_or_name, Path) or is_path(text) else text
    path = find_shipped(own_model) if own_model else Path(text)
    inputs: Inputs = []
    found: list[Diagnostic] = []
    user = _read(path, shown_path(path), inputs, found)
    over, over_inputs = override_tree(overrides)
    base_name = _text(over, "model") or _text(user, "model")
    root = Mapping({}, user.span)
    models: dict[str, str] = {}
    if base_name:
        root = _shipped(base_name, inputs, found).root
        models = dict.fromkeys(group_names(root), base_name)
    elif own_model or path.parent == find_shipped_folder():
        models = dict.fromkeys(group_names(canonical(user, ()).root), path.stem)
    for layer in (user, over):
        made = canonical(layer, group_names(root))
        found += made.found
        root = merge(root, made.root)
    root = _group_models(root, models, inputs, found)
    inputs += over_inputs
    valid = validate(root)
    report = Report(root, valid.removed)
    report.found = found + valid.found
    drafts = [
        _draft(name, keys, models.get(name, ""), report)
        for name, keys in valid.configuration.groups.items()
    ]
    _report_wider(drafts, report)
    for draft in drafts:
        keys = valid.configuration.groups[draft.name]
        if keys.urdf:
            from rapidgen.config.urdf.group import complete

            elsewhere = {j.name for other in drafts if other is not draft for j in other.joints}
            where = ("groups", draft.name, "urdf", "file")
            faults, read = complete(
                draft,
                keys.urdf,
                path.parent,
                [Path(p) for p in package_paths],
                frozenset(elsewhere),
                report.span(where),
            )
            report.found += faults
            inputs += read
            if any(d.severity is Severity.ERROR for d in faults):
                report.mute(("groups", draft.name, "joints"))
        _report_unsure(draft, valid.configuration.groups[draft.name], report)
    config = build(valid.configuration, drafts, path, report)
    if config is None:
        raise DiagnosticError(in_order(report.found))
    from dataclasses import replace

    return replace(config, inputs=tuple(inputs), diagnostics=tuple(in_order(report.found)))


def shown_path(path: Path) -> str:
    """The path as messages show it: relative to the working folder where it lies inside."""
    try:
        return str(path.absolute().relative_to(Path.cwd()))
    except ValueError:
        return str(path)


def find_shipped_folder() -> Path:
    """Folder of the shipped models."""
    from rapidgen._data import data_folder

    return data_folder("robots")


def in_order(found: list[Diagnostic]) -> list[Diagnostic]:
    """Findings by place; those without one come first."""
    return sorted(
        dict.fromkeys(found),
        key=lambda d: (d.span.path, d.span.line, d.span.column) if d.span else ("", 0, 0),
    )


def _read(path: Path, shown: str, inputs: Inputs, found: list[Diagnostic]) -> Mapping:
    data = read_bytes(path, shown)
    inputs.append((path.name, data))
    root, faults = parse(decode(data, shown), shown)
    found += faults
    if isinstance(root, Scalar) and root.value is None:
        return Mapping({}, root.span)
    if not isinstance(root, Mapping):
        raise DiagnosticError(
            error("RG006", "a configuration is a mapping of keys", root.span, "not a mapping")
        )
    return root


def _text(root: Mapping, key: str) -> str:
    """A text at the top of a raw tree, where there is one."""
    entry = root.entries.get(key)
    if entry and isinstance(entry[1], Scalar) and isinstance(entry[1].value, str):
        return entry[1].value
    return ""


def _shipped(name: str, inputs: Inputs, found: list[Diagnostic], span: Span | None = None) -> Layer:
    path = find_shipped(name, span)
    tree = _read(path, shown_path(path), inputs, found)
    made = canonical(tree, ())
    found += made.found
    return made


def _group_models(
    root: Mapping, models: dict[str, str], inputs: Inputs, found: list[Diagnostic]
) -> Mapping:
    """Groups with a `model:` of their own, laid over that model's group."""
    entry = root.entries.get("groups")
    if not entry or not isinstance(entry[1], Mapping):
        return root
    groups: dict[str, tuple[Span, Node]] = {}
    for name, (place, group) in entry[1].entries.items():
        model = _text(group, "model") if isinstance(group, Mapping) else ""
        if model and isinstance(group, Mapping):
            below = _shipped(model, inputs, found, group.entries["model"][1].span).root
            choices = group_names(below)
            chosen = name if name in choices else choices[0] if len(choices) == 1 else ""
            if chosen:
                source = below.entries["groups"][1]
                assert isinstance(source, Mapping)
                base = source.entries[chosen][1]
                assert isinstance(base, Mapping)
                own_path = ("groups", name)
                group = merge(_without_identity(base), group, own_path)
                models[name] = model
            else:
                found.append(
                    error(
                        "RG010",
                        f"model '{model}' has the groups {', '.join(choices)}, none is '{name}'",
                        place,
                        "which of them?",
                        f"name the group {' or '.join(choices)}, or put `model:` at the top",
                    )
                )
        groups[name] = (place, group)
    return Mapping(
        {**root.entries, "groups": (entry[0], Mapping(groups, entry[1].span))}, root.span
    )


def _without_identity(group: Mapping) -> Mapping:
    """A model's group without what belongs to its place on a controller."""
    own = ("task", "mechanical_unit", "ports")
    return Mapping({k: v for k, v in group.entries.items() if k not in own}, group.span)


def _draft(name: str, keys: schema.GroupKeys, model: str, report: Report) -> GroupDraft:
    limits, speeds = keys.source.get("limits", ""), keys.source.get("speeds", "")
    shared = "; ".join(dict.fromkeys(text for text in (limits, speeds) if text))
    joints = [
        JointDraft(
            joint,
            given.axis or "",
            given.unit or "deg",
            given.lower,
            given.upper,
            given.speed,
            given.acceleration,
            given.sign or 1,
            given.offset or 0.0,
            given.source or shared,
            tuple(given.unsure),
        )
        for joint, given in keys.joints.items()
    ]
    chain = [_link(step) for step in keys.chain]
    known = known_figures(model) if model else {}
    return GroupDraft(name, model, joints, chain, keys.coupling, known)


def _link(step: schema.ChainStep) -> Link:
    from math import radians, sqrt

    x, y, z = (v / 1000 for v in step.xyz)
    roll, pitch, yaw = (radians(v) for v in step.rpy)
    norm = sqrt(sum(v * v for v in step.axis)) or 1.0
    a, b, c = (v / norm for v in step.axis)
    return Link(step.joint, (x, y, z), (roll, pitch, yaw), (a, b, c), tuple(step.follows.items()))


def _report_wider(drafts: list[GroupDraft], report: Report) -> None:
    """A limit beyond the shipped model's is said: ranges are never widened silently."""
    for draft in drafts:
        for joint in draft.joints:
            for figure, sign in (("lower", -1), ("upper", 1), ("speed", 1)):
                bound = draft.known.get((joint.axis, figure))
                value = getattr(joint, figure)
                if bound is not None and value is not None and (value - bound) * sign > 1e-9:
                    report.add(
                        "RG049",
                        Severity.WARNING,
                        f"'{joint.name}': {figure} {value:g} is beyond the {bound:g} known for "
                        f"{draft.model}",
                        ("groups", draft.name, "joints", joint.name, figure),
                        "",
                        "keep it only if the data sheet of your robot says so, and give `source:`",
                    )


def known_figures(model: str) -> dict[tuple[str, str], float]:
    """Figures of a shipped model by (axis, figure)."""
    root, _ = parse(decode(find_shipped(model).read_bytes(), model), model)
    groups = canonical(root, ()).root.entries["groups"][1]
    made: dict[tuple[str, str], float] = {}
    for group in to_python(groups).values():
        for joint in group["joints"].values():
            for figure in ("lower", "upper", "speed"):
                made[joint["axis"], figure] = joint[figure]
    return made


def _report_unsure(draft: GroupDraft, keys: schema.GroupKeys, report: Report) -> None:
    """One warning for each group that says which figures lack a sure source."""
    parts = [f"{joint.name} {'/'.join(joint.unsure)}" for joint in draft.joints if joint.unsure]
    parts += keys.unsure
    if parts:
        report.add(
            "RG016",
            Severity.WARNING,
            f"figures without a sure source: {', '.join(parts)}",
            ("groups", draft.name, "joints"),
            "",
            "compare them with the data sheet of your robot before it moves, and write them "
            "into your configuration with their `source:`",
            key=True,
        )
