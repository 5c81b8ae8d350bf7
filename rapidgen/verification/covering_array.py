"""Covering arrays: few rows that contain all pairs (or triples) of values.

Rows are generated one after the other. Each starts with a combination that no row has yet, and
every further factor gets the value that adds most new combinations. The best of some such rows is
used. (D. Cohen et al., "The AETG system", IEEE Trans. Software Eng. 23, 1997: the array grows with
the logarithm of the number of factors.)
"""

import random
from collections.abc import Mapping, Sequence
from itertools import combinations, product
from typing import TypeVar

V = TypeVar("V")

TRIED = 40
"""Candidate rows, of which the best is used."""


def covering(factors: Mapping[str, Sequence[V]], strength: int = 2) -> list[dict[str, V]]:
    """Return rows with all combinations of values of any `strength` factors.

    The result is deterministic. The first row is the first value of every factor.
    """
    # Each value is one bit; a combination is the union of its values' bits.
    bits: list[list[int]] = []
    for values in factors.values():
        used = sum(len(own) for own in bits)
        bits.append([1 << (used + number) for number in range(len(values))])
    strength = min(strength, len(bits))
    missing = {
        sum(result): dict(zip(chosen, result, strict=True))
        for chosen in combinations(range(len(bits)), strength)
        for result in product(*(bits[factor] for factor in chosen))
    }
    chance = random.Random(0)
    row, rows = {factor: own[0] for factor, own in enumerate(bits)}, []
    while True:
        rows.append(row)
        for result in combinations(row.values(), strength):
            missing.pop(sum(result), None)
        if not missing:
            break
        row = max((_row(bits, strength, missing, chance) for _ in range(TRIED)), key=_gain)[1]
    return [
        {
            name: values[bits[number].index(row[number])]
            for number, (name, values) in enumerate(factors.items())
        }
        for row in rows
    ]


def _gain(tried: tuple[int, dict[int, int]]) -> int:
    return tried[0]


def _row(
    bits: Sequence[Sequence[int]],
    strength: int,
    missing: Mapping[int, Mapping[int, int]],
    chance: random.Random,
) -> tuple[int, dict[int, int]]:
    """Return a row and the number of missing combinations in it.

    The row holds a value's bit by factor.
    """
    row = dict(next(iter(missing.values())))
    # Combinations within the row, by number of assigned values.
    parts: list[list[int]] = [[0]] + [[] for _ in range(strength - 1)]

    def take(bit: int) -> None:
        for size in range(strength - 1, 0, -1):
            parts[size] += [part | bit for part in parts[size - 1]]

    for bit in row.values():
        take(bit)
    others = [factor for factor in range(len(bits)) if factor not in row]
    chance.shuffle(others)
    gained = 1
    for factor in others:
        gains = [
            (sum(part | bit in missing for part in parts[-1]), chance.random(), bit)
            for bit in bits[factor]
        ]
        gain, _, row[factor] = max(gains)
        gained += gain
        take(row[factor])
    return gained, row
