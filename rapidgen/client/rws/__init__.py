"""Robot Web Services: `Controller` and `AsyncController`.

They need the extra `rapidgen[web]`.
"""

from typing import TYPE_CHECKING

from rapidgen import _extras
from rapidgen.client.rws.errors import RwsError

if TYPE_CHECKING:
    from rapidgen.client.rws.aio import AsyncController
    from rapidgen.client.rws.sync import Controller

__all__ = ["AsyncController", "Controller", "RwsError"]


def __getattr__(name: str) -> object:
    # Deployment over FTP and clients of a driver alone must not pay for HTTP and websockets.
    with _extras.named():
        if name == "Controller":
            from rapidgen.client.rws.sync import Controller

            return Controller
        if name == "AsyncController":
            from rapidgen.client.rws.aio import AsyncController

            return AsyncController
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
