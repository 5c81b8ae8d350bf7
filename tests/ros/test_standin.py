"""The stand-in of rclpy takes nothing that rclpy would refuse (record.py keeps what it takes)."""

import json

import pytest
import standin
from record import CALLS, RECORDED, signature

KNOWN = json.loads(RECORDED.read_text())
CLASSES = {
    "Node": standin.LifecycleNode,
    "LifecycleNodeMixin": standin.LifecycleNode,
    "ActionServer": standin.ActionServer,
    "ServerGoalHandle": standin.Handle,
    "Parameter": standin.Parameter,
    "QoSOverridingOptions": standin.QoSOverridingOptions,
}


def _taken(text):
    """By place (in order), by name; each as it is recorded, with `=` for what may be left out."""
    places, _, names = text.partition("*")
    return [[one for one in part.split(", ") if one.strip(", ")] for part in (places, names)]


@pytest.mark.parametrize("distribution", sorted(KNOWN))
@pytest.mark.parametrize("call", sorted(CALLS))
def test_a_call_of_the_stand_in_is_one_of_rclpy(call, distribution):
    owner, method = call.split(".")
    here = _taken(signature(getattr(CLASSES[owner], method)))
    real = _taken(KNOWN[distribution]["calls"][call])
    (places, names), (real_places, real_names) = here, real
    # In the same order, and only what may be left out is.
    assert places == real_places[: len(places)]
    assert all(name.endswith("=") for name in real_places[len(places) :])
    assert set(names) <= set(real_names)
    assert all(name.endswith("=") for name in set(real_names) - set(names))


@pytest.mark.parametrize("distribution", sorted(KNOWN))
def test_publishers_default_to_reliable_and_volatile(distribution):
    report = {key: getattr(standin.QoSProfile, key) for key in KNOWN[distribution]["qos"]}
    assert report == KNOWN[distribution]["qos"]
