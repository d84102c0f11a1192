"""Arrays that compiled code finds at one address, instead of being handed each of them.

numba unpacks every array of a call's arguments, and counts a reference to each: for the seventy of
a moving wire that takes as long as a short time step. A handle is unpacked as one number; nothing
is counted on the way. Its Python object keeps alive what lies behind it.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any

import numba
import numpy as np
from llvmlite import ir
from numba import types
from numba.core.registry import cpu_target
from numba.extending import (
    NativeValue,
    intrinsic,
    models,
    register_model,
    typeof_impl,
    unbox,
)


class HandleType(types.Type):  # type: ignore[misc]
    """numba's type of a handle to parts of some type."""

    def __init__(self, parts: types.Type) -> None:
        self.parts = parts
        super().__init__(name=f"Handle({parts})")


class Handle:
    """Parts that stay where they are, behind one address.

    Parameters
    ----------
    parts
        A named tuple of arrays and numbers; a copy of the numbers is kept.

    Attributes
    ----------
    kind
        numba's type: code compiled for it serves all handles of the same kind.
    address
        Where the parts are in memory, for as long as the handle lives.
    """

    def __init__(self, parts: Any) -> None:
        inner = numba.typeof(parts)
        self.kind = HandleType(inner)
        context = cpu_target.target_context
        self._parts = parts
        self._room = np.zeros(-(-context.get_abi_sizeof(context.get_value_type(inner)) // 8))
        self.address: int = self._room.ctypes.data
        laid, values = _laid_out(parts, inner)
        struct.pack_into(laid, self._room, 0, *values)


def _laid_out(parts: Any, kind: types.Type) -> tuple[str, list[float]]:
    """Parts as numba has them in memory: format and values of Python's ``struct``.

    Compiled code could write them, too; but making it takes longer the more arrays there are.
    """
    if isinstance(kind, types.Array):
        values = [0, 0, parts.size, parts.itemsize, parts.ctypes.data, *parts.shape, *parts.strides]
        return f"2P2nP{2 * parts.ndim}n", values
    if isinstance(kind, types.BaseTuple):
        inner = [_laid_out(*one) for one in zip(parts, kind, strict=True)]
        formats, values = "".join(one for one, _ in inner), [v for _, some in inner for v in some]
        return f"{formats}0q", values  # its end is aligned, as what follows may be a flag
    return _NUMBERS[kind], [parts]


_NUMBERS = {types.float64: "d", types.int64: "q", types.boolean: "?"}


@register_model(HandleType)
class _Model(models.PrimitiveModel):  # type: ignore[misc]
    def __init__(self, manager: Any, kind: HandleType) -> None:
        super().__init__(manager, kind, ir.IntType(64))


@typeof_impl.register(Handle)
def _typeof(handle: Handle, _: object) -> HandleType:
    return handle.kind


@unbox(HandleType)
def _unbox(kind: HandleType, handle: Any, c: Any) -> NativeValue:
    address = c.pyapi.object_getattr_string(handle, "address")
    value = c.pyapi.long_as_longlong(address)
    c.pyapi.decref(address)
    return NativeValue(value, is_error=c.pyapi.c_api_error())


@intrinsic
def parts_of(context, handle):
    """What lies behind a handle."""

    def codegen(context, builder, signature, args):
        return _load(context, builder, args[0], signature.return_type)

    return handle.parts(handle), codegen


@intrinsic
def parts_at(context, address, like):
    """What lies at an address, which must be of the type of ``like``."""

    def codegen(context, builder, signature, args):
        return _load(context, builder, args[0], signature.return_type)

    return like(address, like), codegen


def _load(context, builder, address, kind):
    stored = context.get_value_type(kind)
    return builder.load(builder.inttoptr(address, stored.as_pointer()))


def resolved(function: Any, *example: object) -> Callable[..., Any]:
    """An entry's machine code for arguments like these: a call does not look for it again."""
    kinds = tuple(map(numba.typeof, example))
    function.compile(kinds)
    code: Callable[..., Any] = function.get_overload(kinds)
    return code
