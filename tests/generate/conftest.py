"""The `bench` fixture: a generated driver on the virtual controller."""

from dataclasses import replace

import pytest

from rapidgen.config import load_config
from tests.generate.bench import Bench


@pytest.fixture
def bench():
    """Call it with a shipped name (default irb120) and what to change in the configuration."""
    made = []

    def make(name="irb120", *, overrides=(), options=None, **changes):
        config = load_config(name, overrides=list(overrides))
        found = Bench(replace(config, **changes), **(options or {}))
        made.append(found)
        return found

    yield make
    for one in made:
        one.stop()
