"""Every operation of RWS answers as replies.json says."""

import json

import pytest
from replies import GENERATIONS, KEPT, replies


@pytest.mark.parametrize("generation", GENERATIONS, ids=lambda generation: generation.name)
def test_every_operation_answers_as_before(generation, tmp_path):
    kept = json.loads(KEPT.read_text())[generation.name]
    made = replies(generation, tmp_path)
    assert made.keys() == kept.keys()
    assert {target: reply for target, reply in made.items() if reply != kept[target]} == {}
