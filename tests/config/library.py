"""Write the shipped models into robots/variants.json: `python -m tests.config.library`.

Entries of variants that are no shipped model stay as they are. With `--doubts` it prints instead
what the sources of each variant have differently, what only one of them has, and the counts.
"""

import json
import re
import sys

from rapidgen._data import data_folder
from rapidgen.config import shipped_names
from rapidgen.config.catalogue import model_description
from rapidgen.config.load import drafts_of
from rapidgen.config.variant_library import entry, variants
from rapidgen.config.variant_model import missing_figures

PATH = data_folder("robots") / "variants.json"
CELLS = {"irb120_track"}
"""Shipped models that are cells around a robot of the list."""


def shipped_entries():
    """What the shipped models' own files say."""
    made = []
    for name in shipped_names():
        if name in CELLS:
            continue
        drafts = drafts_of(name)
        for draft, keys in drafts:
            of = re.match(r"ABB ([^,]+?)(?: palletiser| SCARA)?,", model_description(name))[1]
            of = of.replace("single-arm ", "").replace(" YuMi", "")
            of += f" ({keys.task})" if len(drafts) > 1 else ""
            made.append(entry(of, draft, keys.source, keys.unsure))
    return made


def write(entries):
    """One axis a line."""
    text = json.dumps(entries, indent=1)
    text = re.sub(r"\[\s+([^\[\]{}]*?)\s+\]", lambda m: "[" + " ".join(m[1].split()) + "]", text)
    text = re.sub(
        r"\{\s+(\"axis\"[^{}]*?)\s+\}", lambda m: "{" + " ".join(m[1].split()) + "}", text
    )
    PATH.write_text(text + "\n", encoding="utf-8")


def doubts():
    """Lines about every variant of which the sources leave a doubt, and the counts."""
    for variant in variants():
        marked = [f"{a.axis} {figure}" for a in variant.axes for figure in a.unsure]
        for text in variant.disagreements:
            yield f"{variant.name}: {text}"
        alone = [*marked, *variant.unsure]
        if alone:
            yield f"{variant.name}: unsure {', '.join(alone)}"
        if not variant.model and missing_figures(variant):
            yield f"{variant.name}: no model, lacks {'; '.join(missing_figures(variant))}"
    others = [v for v in variants() if not v.model]
    models = [v for v in others if not missing_figures(v)]
    fast = sum(all(axis.speed for axis in v.axes) for v in models)
    differing = sum(bool(v.disagreements) for v in variants())
    shipped = len(variants()) - len(others)
    yield (
        f"{len(variants())} variants: {shipped} shipped, {len(models)} models "
        f"by two sources ({fast} with speeds), {differing} with figures that differ"
    )


if __name__ == "__main__" and "--doubts" in sys.argv:
    print("\n".join(doubts()))
elif __name__ == "__main__":
    known = json.loads(PATH.read_text(encoding="utf-8")) if PATH.exists() else []
    write(shipped_entries() + [e for e in known if not e["model"]])
