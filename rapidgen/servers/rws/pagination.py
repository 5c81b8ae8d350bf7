"""Pagination of collections: whole in RWS 1.0, pages in RWS 2.0."""

from collections.abc import Sequence

from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.wire.rws.bodies import Item


def page(
    request: RwsRequest, items: Sequence[Item], most: int, name: str, *, always: bool = False
) -> RwsResponse:
    """Return the requested page, at most `most` items.

    `always`: RWS 1.0 divides them too.
    """
    if request.is_one and not always:
        return show(*items, collection=True)
    try:
        start, limit = (
            int(request.query.get(k, str(d))) for k, d in (("start", 0), ("limit", most))
        )
    except ValueError as error:
        raise RequestDenied(400, "E_INVALIDARG", "start or limit") from error
    if start < 0 or limit < 1:
        raise RequestDenied(400, "E_INVALIDARG", "start or limit")
    limit = min(limit, most)
    end = start + limit
    following = f"{name}?start={end}&limit={limit}" if end < len(items) else ""
    return show(*items[start:end], collection=True, following=following)
