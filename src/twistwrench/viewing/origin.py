"""Which requests the page's server accepts: those of the page itself, not of others that are open in the browser."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from http import HTTPStatus
from typing import Any
from urllib.parse import urlsplit

__all__ = ["is_own_page", "only_own_page"]

LOCAL_HOSTS = ("127.0.0.1", "localhost", "::1")


def is_own_page(headers: Mapping[str, str]) -> bool:
    """Return whether a request comes from the page that this machine serves, or from no page at all.

    A browser names the requesting page in ``Origin``, and the name under which it found the server in ``Host``.
    A page of another site has another ``Origin``; one whose name was made to resolve to this machine, another ``Host``.

    Examples
    --------
    >>> is_own_page({"Host": "127.0.0.1:8080", "Origin": "http://127.0.0.1:8080"})
    True
    >>> is_own_page({"Host": "127.0.0.1:8080", "Origin": "http://evil.example"})
    False
    """
    host = headers.get("Host", "")
    origin = headers.get("Origin")
    try:
        here = urlsplit(f"//{host}").hostname in LOCAL_HOSTS
    except ValueError:
        here = False
    return here and origin in (None, f"http://{host}")


@contextmanager
def only_own_page() -> Iterator[None]:
    """Let the server that viser starts within accept its own page only: viser itself accepts any ``Origin``."""
    from websockets.asyncio import server

    serve = server.serve
    guarded = []

    def guarded_serve(*args: Any, **options: Any) -> Any:
        answer = options.get("process_request")

        def process(connection: Any, request: Any) -> Any:
            if not is_own_page(request.headers):
                return connection.respond(HTTPStatus.FORBIDDEN, "only the page that is served here may ask\n")
            return answer(connection, request) if answer else None

        guarded.append(True)
        return serve(*args, **options | {"process_request": process})

    server.serve = guarded_serve  # type: ignore[assignment,misc]
    try:
        yield
    finally:
        server.serve = serve  # type: ignore[misc]
    if not guarded:
        warnings.warn(
            "this viser starts its server in a way that twistwrench does not know: "
            "pages of other sites that are open in the same browser can read and move the robot",
            UserWarning,
            stacklevel=3,
        )
