"""What numba has found out of a call, kept for the next one like it.

Each operator has dozens of meanings in numba, for dates, strings and sets as well; it goes through
them anew for every sum of two numbers. That took a seventh of a compilation.

What is overridden here is not a public part of numba; tried with 0.60 and 0.68.
"""

from __future__ import annotations

from typing import Any

from numba.core.types.functions import BaseFunction
from numba.core.typing import Signature
from numba.core.typing.context import BaseContext

_find = BaseFunction.get_call_type
_known: dict[tuple[BaseContext, Any, tuple[Any, ...]], Signature] = {}


def _call_type(
    function: BaseFunction, context: BaseContext, args: tuple[Any, ...], kws: dict[str, Any]
) -> Signature:
    """Signature of a call of a function that numba knows, by the types of its arguments.

    Kept is what stands for itself (``typing_key``): what is compiled for a call may differ by the
    caller's options.
    """
    if kws:
        return _find(function, context, args, kws)
    call = (context, function.key, tuple(args))  # a graphics card has a context of its own
    found = _known.get(call)
    if found is not None:
        function._impl_keys[found.args] = function.typing_key
        return found
    found = _find(function, context, args, kws)
    if function._impl_keys[found.args] is function.typing_key:
        _known[call] = found
    return found


def remember_calls() -> None:
    """From now on, whenever numba compiles."""
    BaseFunction.get_call_type = _call_type
