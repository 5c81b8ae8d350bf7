"""Clients of the debug adapter."""

import pytest

from tests.dap.own_client import OwnClient


@pytest.fixture
def client():
    opened = OwnClient()
    yield opened
    opened.close()


@pytest.fixture
def program(tmp_path):
    """Write a program and return its path."""

    def write(text, name="m.mod"):
        path = tmp_path / name
        path.write_text(text)
        return path

    return write
