"""Request of one operation: media types, forms, repeats, refusals."""

import logging
from collections.abc import Mapping

from rapidgen.client.rws.core import RwsCore
from rapidgen.client.rws.effects import DropConnections, Exchange, Flow, Pause, Response
from rapidgen.client.rws.errors import Busy, LoginFailed, NotRws, RwsError
from rapidgen.wire.rws import media
from rapidgen.wire.rws.bodies import Body, Generation, Unreadable
from rapidgen.wire.rws.forms import Fields, form_type, write_form
from rapidgen.wire.rws.grants import needed
from rapidgen.wire.rws.operations import RwsOperation

_LEVELS = {True: logging.DEBUG, False: logging.INFO}
"""Methods that read, and methods that change."""
_TRIES = 6
_BREATH = 0.25
"""s after a 503 [code: a public client waits 200 ms]."""


def ask(
    core: RwsCore,
    operation: RwsOperation,
    names: Mapping[str, str] | None = None,
    form: Fields | None = None,
    *,
    query: str = "",
    data: bytes | None = None,
    accepted: tuple[int, ...] = (),
) -> Flow[tuple[Body, Response]]:
    """Execute an operation; return its body and the response.

    `accepted` are further good statuses. Raises RwsError (RG650), Busy (RG656), LoginFailed
    (RG651), NotRws (RG653).
    """
    route = core.route(operation)
    target = route.fill(dict(names or {}))
    one = core.generation is Generation.ONE
    if one and route.method in ("GET", "POST") and not target.startswith("/fileservice"):
        query = f"{query}&json=1" if query else "json=1"
    if query:
        target += f"{'&' if '?' in target else '?'}{query}"
    headers: dict[str, str] = {}
    if not one:
        headers["Accept"] = media.HAL
    body = b""
    if data is not None:
        body = data
        headers["Content-Type"] = media.FILE_TYPES[1]
    elif route.method != "GET":
        headers["Content-Type"] = form_type(core.generation)
        body = write_form(form or {})
    response = yield from _send(core, route.method, target, headers, body)
    if response.status == 406 and not one:
        # Some resources require XHTML [VC 7.21, real 7.21].
        headers["Accept"] = media.XHTML
        response = yield from _send(core, route.method, target, headers, body)
    read = _read(core, response)
    good = (200, 201, 202, 204, *accepted)
    if response.status not in good or (read.fault is not None and response.status not in accepted):
        takes = needed(operation, core.generation)
        raise RwsError(response.status, f"{route.method} {target}", read.fault, takes)
    return read, response


def _send(
    core: RwsCore, method: str, target: str, headers: Mapping[str, str], body: bytes
) -> Flow[Response]:
    """Send a request, again after 503, and once more after a session's end."""
    again = True
    for _ in range(_TRIES):
        core.requests += 1
        response = yield Exchange(method, target, headers, body, repeat=method == "GET")
        core.tell(
            f"{method} {target.partition('?')[0]}: {response.status}", _LEVELS[method == "GET"]
        )
        if response.status == 503:
            yield Pause(_BREATH)
            continue
        if response.status == 401:
            if again and core.connected:
                again = False
                yield DropConnections()
                continue
            raise LoginFailed.because(
                "RG651",
                f"{core.where} does not let {core.user} in with this password",
                "correct user or password; nothing was changed",
            )
        return response
    raise Busy.because(
        "RG656",
        f"{core.where} is busy: it answered 503 {_TRIES} times",
        "it accepts 20 requests a second and 70 sessions: end other clients, or wait five minutes",
    )


def _read(core: RwsCore, response: Response) -> Body:
    kind = response.headers.get("content-type", "")
    is_body = "json" in kind or "xhtml" in kind or (response.status >= 400 and response.body)
    if not response.body or not is_body:
        return Body()
    try:
        return media.read(response.body, kind)
    except Unreadable as error:
        if response.status >= 400:
            return Body()
        raise NotRws.because(
            "RG653",
            f"what {core.where} answers is not Robot Web Services: {error}",
            "is this the controller's own port?",
        ) from error
