"""Write the shipped models into robots/variants.json: `python -m tests.config.library`.

Entries of variants that are no shipped model stay as they are.
"""

import json
import re

from rapidgen._data import data_folder
from rapidgen.config import shipped_names
from rapidgen.config.catalogue import model_description
from rapidgen.config.library import entry
from rapidgen.config.load import drafts_of

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


if __name__ == "__main__":
    known = json.loads(PATH.read_text(encoding="utf-8")) if PATH.exists() else []
    write(shipped_entries() + [e for e in known if not e["model"]])
