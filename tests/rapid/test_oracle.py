"""A second grammar from the kernel manual agrees with the parser."""

import random
import re
from functools import cache
from pathlib import Path

import pytest
from lark import Lark
from lark.exceptions import LarkError

from rapidgen.rapid import parse
from tests.rapid.conformance_files import all_files
from tests.rapid.derivations import Derivations
from tests.rapid.programs import program

# What the parser says about text that K does not derive; the rest is about limits and meaning.
GRAMMAR = {"RG201", "RG202", "RG203", "RG204", "RG205", "RG206", "RG207", "RG208", "RG210"} | {
    "RG211", "RG212", "RG213", "RG216", "RG217", "RG218"
}  # fmt: skip
LEFT_OUT = re.compile(r"<(EIT|CSE)>|%%%|\t|2E52786", re.IGNORECASE)
FILES = [f for f in all_files() if not LEFT_OUT.search(f.text)]


@cache
def oracle():
    grammar = Path(__file__).with_name("grammar.lark").read_text("utf-8")
    return Lark(grammar, parser="lalr", lexer="basic", maybe_placeholders=False)


def oracle_accepts(text):
    try:
        oracle().parse(text)
    except LarkError:
        return False
    return True


def parser_accepts(text):
    return not any(d.code in GRAMMAR for d in parse(text).diagnostics)


@pytest.mark.parametrize("folder", sorted({f.section for f in FILES}))
def test_agrees_on_the_conformance_files(folder):
    disagreed = [
        f.name
        for f in FILES
        if f.section == folder and oracle_accepts(f.text) != parser_accepts(f.text)
    ]
    assert disagreed == []


def mutants(text, count, seed):
    """Texts with a token removed, doubled, swapped or replaced."""
    source = parse(text).source
    tokens = source.tokens
    chance = random.Random(seed)
    for _ in range(count):
        changed = list(tokens)
        at = chance.randrange(len(changed))
        kind = chance.randrange(4)
        if kind == 0:
            del changed[at]
        elif kind == 1:
            changed.insert(at, changed[at])
        elif kind == 2 and at + 1 < len(changed):
            changed[at], changed[at + 1] = changed[at + 1], changed[at]
        else:
            changed[at] = chance.choice(tokens)
        yield " \n".join(changed)


@pytest.mark.parametrize("seed", range(8))
def test_parser_agrees_with_oracle_on_changed_texts(seed):
    chance = random.Random(seed)
    disagreed = []
    for file in chance.sample(FILES, 40):
        for text in mutants(file.text, 6, seed):
            if oracle_accepts(text) != parser_accepts(text):
                disagreed.append((file.path.name, oracle_accepts(text), text))
    assert disagreed == []


def too_deep(text):
    """Return True if a text exceeds the parser's limits.

    The oracle has none.
    """
    return any(d.code in ("RG210", "RG211") for d in parse(text).diagnostics)


@cache
def derivations():
    return Derivations(oracle())


@pytest.mark.parametrize("seed", range(8))
def test_derivations_of_oracle_are_accepted(seed):
    chance = random.Random(seed)
    refused = []
    for _ in range(60):
        text = " ".join(derivations().tokens(chance))
        assert oracle_accepts(text)
        if not parser_accepts(text) and not too_deep(text):
            refused.append((text, parse(text).diagnostics[0].message))
    assert refused == []


def test_derivations_use_every_word():
    chance = random.Random(0)
    seen = {token for _ in range(600) for token in derivations().tokens(chance)}
    words = {word.lower() for name, words in derivations().words.items() for word in words}
    blank = {word.lower() for name in ("BLANK", "COMMENT") for word in derivations().words[name]}
    assert words - {token.lower() for token in seen} == blank


@pytest.mark.parametrize("seed", range(8))
def test_parser_agrees_with_oracle_on_changed_derivations(seed):
    chance = random.Random(seed)
    disagreed = []
    for k in range(40):
        made = program(chance.randrange(2**32)) if k % 2 else " ".join(derivations().tokens(chance))
        for text in mutants(made, 3, seed + k):
            if oracle_accepts(text) != parser_accepts(text) and not too_deep(text):
                disagreed.append((oracle_accepts(text), text))
    assert disagreed == []
