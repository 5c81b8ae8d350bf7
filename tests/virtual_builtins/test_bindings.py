"""Every bound built-in has a signature and takes as many arguments."""

import inspect

import pytest

from rapidgen.rapid import signatures
from rapidgen.virtual import unsupported
from rapidgen.virtual.registry import bound, bound_names


@pytest.mark.parametrize("name", bound_names())
def test_a_binding_takes_the_arguments_of_its_signature(name):
    signature, builtin = signatures.routine(name), bound(name)
    assert signature is not None
    assert builtin is not None
    inspect.signature(builtin.function).bind(None, *signature.parameters)


def test_what_is_left_out_on_purpose_has_a_signature_and_no_binding():
    for name in unsupported.names():
        assert signatures.routine(name) is not None, name
        assert bound(name) is None, name
