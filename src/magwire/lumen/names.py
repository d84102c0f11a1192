"""Names of outlets as people know them: clinical short forms, and whatever case."""

from __future__ import annotations

from collections.abc import Collection

CLINICAL = {
    "lad": ("left anterior descending", "anterior descending"),
    "lcx": ("left circumflex", "circumflex"),
    "rca": ("right coronary",),
    "lca": ("left coronary",),
    "lcca": ("left common carotid", "left carotid"),
    "rcca": ("right common carotid", "right carotid"),
    "lsa": ("left subclavian",),
    "bca": ("brachiocephalic", "brachiocephalic trunk", "innominate"),
    "ica": ("internal carotid", "internal"),
    "eca": ("external carotid", "external"),
}
"""What each short form stands for; "artery" may stand behind any of them."""


def meant(name: str, names: Collection[str]) -> str:
    """The one of some names that is meant by a name, or that name itself if none is.

    Parameters
    ----------
    name
        As it is, in another case, or a clinical short form such as "LCCA", or what that stands for.
    names
        Those that there are.
    """
    if name in names:
        return name
    wanted = _forms(name)
    found = [known for known in names if wanted & _forms(known)]
    return found[0] if len(found) == 1 else name


def _forms(name: str) -> set[str]:
    """All ways in which a name may be written."""
    plain = " ".join(name.lower().replace("_", " ").replace("-", " ").split())
    plain = plain.removesuffix(" artery")
    short = plain if plain in CLINICAL else None
    for key, words in CLINICAL.items():
        if plain in words:
            short = key
    return {plain} if short is None else {plain, short, *CLINICAL[short]}
