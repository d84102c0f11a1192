"""Pages that show results in a browser: one file each, which sends for nothing."""

from __future__ import annotations

from magwire.view.page import Page, page

__all__ = ["Page", "page"]
