"""Robot Web Services: `Controller` and `AsyncController`."""

from rapidgen.client.rws.aio import AsyncController
from rapidgen.client.rws.errors import RwsError
from rapidgen.client.rws.sync import Controller

__all__ = ["AsyncController", "Controller", "RwsError"]
