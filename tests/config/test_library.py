"""Library of arms: equal to shipped models, every figure with source."""

import json

import pytest

from rapidgen.config.recognition import align
from rapidgen.config.variant_library import family, recognise, variants
from tests.config.library import PATH, shipped_entries


def test_shipped_models_are_in_it_as_their_files_have_them():
    known = [entry for entry in json.loads(PATH.read_text(encoding="utf-8")) if entry["model"]]
    own = shipped_entries()
    assert known == own, "run python -m tests.config.library"


@pytest.mark.parametrize("variant", variants(), ids=lambda v: v.name)
def test_every_figure_has_its_source(variant):
    sources = dict(variant.sources)
    assert sources["limits"]
    assert sources["chain"]
    assert sources["coupling"]
    if any(axis.speed for axis in variant.axes):
        assert sources["speeds"]
    if not variant.model and not any(word in sources["chain"] for word in (";", " and ")):
        assert "chain" in variant.unsure  # one source only


@pytest.mark.parametrize("variant", variants(), ids=lambda v: v.name)
def test_an_arm_is_recognised(variant):
    result = recognise(variant.skeleton, variant.name)
    # Variants of one family may have one geometry.
    assert result.variant.family == variant.family
    assert result.difference.turned == ()


def test_most_variants_have_dimensions_from_two_sources():
    assert sum("chain" not in v.unsure for v in variants()) >= 59


@pytest.mark.parametrize(
    ("name", "number"),
    [("irb120_3_58", "120"), ("CRB 15000-5/0.95", "15000"), ("IRB 52-7/1.2", "52"), ("x", "")],
)
def test_the_family_of_a_name(name, number):
    assert family(name) == number


def test_of_arms_with_one_geometry_the_named_type_is_meant():
    known = next(v for v in variants() if v.name == "IRB 52-7/1.45")
    for name, meant in (("IRB52_long_rev1", "52"), ("irb1600_10_145", "1600"), ("arm", None)):
        result = align(known.skeleton.lines, name)
        assert result is not None
        assert meant is None or result.variant.family == meant
