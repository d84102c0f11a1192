"""Blocks of LZ4, as VTK compresses its arrays by default in some programs.

Written from the description of the format at https://github.com/lz4/lz4/blob/dev/doc/lz4_Block_format.md.
"""

from __future__ import annotations

SHORTEST = 4  # bytes of a match
MORE = 15  # a length of this value goes on in the bytes that follow


def expand(packed: bytes, most: int) -> bytes:
    """The bytes of a block.

    Parameters
    ----------
    packed
        The block.
    most
        Bytes that come out, at most.

    Raises
    ------
    ValueError
        If the block is broken, or more comes out.
    """
    out, place = bytearray(), 0
    try:
        while place < len(packed):
            token = packed[place]
            size, place = _length(packed, place + 1, token >> 4)
            if place + size > len(packed) or len(out) + size > most:
                raise ValueError
            out += packed[place : place + size]
            place += size
            if place == len(packed):  # the last sequence has no match
                break
            back = packed[place] | packed[place + 1] << 8
            size, place = _length(packed, place + 2, token & MORE)
            size += SHORTEST
            if not 0 < back <= len(out) or len(out) + size > most:
                raise ValueError
            part = bytes(out[-back:])
            out += (part * (size // back + 1))[:size]  # a match may overlap what it makes
    except IndexError:
        raise ValueError from None
    return bytes(out)


def _length(packed: bytes, place: int, size: int) -> tuple[int, int]:
    """A length that starts in a token, and where what follows it begins."""
    if size < MORE:
        return size, place
    while True:
        size += packed[place]
        place += 1
        if packed[place - 1] != 255:
            return size, place
