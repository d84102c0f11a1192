"""Who is let in: the pages that this server made, and nobody else's."""

from __future__ import annotations

import hmac
from collections.abc import Mapping
from dataclasses import dataclass
from urllib.parse import parse_qs, urlsplit

LOOPBACK = ("127.0.0.1", "::1", "localhost")
LIVE = "/live"
"""Where the page connects to."""


@dataclass(frozen=True)
class Refusal:
    """A status of HTTP and a sentence."""

    status: int
    sentence: str


@dataclass(frozen=True)
class Doors:
    """What a request has to show.

    A page from elsewhere could have the browser of whoever drives connect here: so the page that
    connects must have come from this address (Origin), and a request for this machine must call it
    by a name of this machine (Host), or a foreign name could be led here.

    Parameters
    ----------
    host
        Address that the server listens at.
    token
        Word that has to be known; none on loopback.
    """

    host: str
    token: str

    def refuse(self, path: str, headers: Mapping[str, str]) -> Refusal | None:
        """Why a request is refused; None if it is not."""
        parts = urlsplit(path)
        called = headers.get("Host", "")
        if self.host in LOOPBACK and (urlsplit(f"//{called}").hostname or "") not in LOOPBACK:
            return Refusal(403, f"This server is called localhost; received {called!r}.")
        if parts.path not in ("/", LIVE):
            return Refusal(404, "There is only one page here.")
        given = parse_qs(parts.query).get("token", [""])[0]
        if not hmac.compare_digest(given.encode(), self.token.encode()):
            return Refusal(403, "The address needs the token that 'magwire drive' printed.")
        origin = headers.get("Origin", "")
        if parts.path == LIVE and origin != f"http://{called}":
            return Refusal(403, f"Only the page of this server may connect; received {origin!r}.")
        return None
