"""Properties of tokens, trees and formatted text on random input."""

import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rapidgen.diagnostics import Diagnostic
from rapidgen.rapid import check, format_source, parse
from rapidgen.rapid.syntax.lexer import KEYWORDS
from rapidgen.rapid.syntax.walk import walk
from tests.rapid.conformance_files import all_files
from tests.rapid.programs import program

bounded = settings(max_examples=40)
programs = st.integers(0, 2**32).map(program)


def shape(module):
    return [(type(node).__name__, node.first, node.last) for node in walk(module)]


def upper(tokens):
    return [t.upper() if t.upper() in KEYWORDS else t for t in tokens]


@bounded
@given(programs)
def test_made_up_modules_derive(text):
    assert parse(text).diagnostics == []


@bounded
@given(programs)
def test_formatting_keeps_tokens_and_tree_and_is_done_once(text):
    before, formatted = parse(text), format_source(text)
    after = parse(formatted)
    assert upper(before.source.tokens) == after.source.tokens
    assert shape(before) == shape(after)
    assert format_source(formatted) == formatted


@bounded
@given(programs)
def test_formatting_keeps_comments(text):
    assert format_source(text).count("! note ; IF") == text.count("! note ; IF")


@bounded
@given(st.one_of(programs, st.text(max_size=300)))
def test_tokens_tile_the_text(text):
    source = parse(text).source
    if source.text:
        pieces = [t + g for t, g in zip(source.tokens, source.gaps, strict=True)]
        assert source.lead + "".join(pieces) == source.text
        result = zip(source.starts, source.tokens, strict=True)
        assert all(source.text.startswith(token, start) for start, token in result)
        pairs = zip(source.text, text, strict=True)
        assert all(read == written or not written.isprintable() for read, written in pairs)


def harmless(text):
    module = parse(text, path="x.mod")
    assert all(isinstance(d, Diagnostic) for d in module.diagnostics)
    findings = check(module)
    assert all(d.span is None or d.span.line >= 1 for d in findings)
    sum(1 for _ in walk(module))


@bounded
@given(st.binary(max_size=400))
def test_random_bytes_bring_nothing_but_diagnostics(data):
    harmless(data)


@bounded
@given(st.text(max_size=400))
def test_random_text_brings_nothing_but_diagnostics(text):
    harmless("MODULE m\nPROC p()\n" + text)


@bounded
@given(programs, st.integers(0, 1500))
def test_truncations_bring_nothing_but_diagnostics(text, length):
    harmless(text[:length])


@pytest.mark.parametrize("seed", range(4))
def test_shuffled_tokens_bring_nothing_but_diagnostics(seed):
    chance = random.Random(seed)
    for file in chance.sample(all_files(), 60):
        tokens = list(parse(file.text).source.tokens)
        for _ in range(3):
            i, j = chance.randrange(len(tokens)), chance.randrange(len(tokens))
            tokens[i], tokens[j] = tokens[j], tokens[i]
            harmless("\n".join(tokens))
