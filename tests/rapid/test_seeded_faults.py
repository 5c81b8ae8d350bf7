"""A strict check finds what a controller's program check rejects: a sample of seeded faults.

More are drawn by `python -m tools.seeded_faults`.
"""

from collections import Counter

from tools.seeded_faults import draw, is_found


def test_a_sample_of_seeded_faults_is_found():
    faults = draw(20, seed=7)
    assert set(Counter(fault.kind for fault in faults).values()) == {4}
    assert [fault for fault in faults if not is_found(fault.changed)] == []
