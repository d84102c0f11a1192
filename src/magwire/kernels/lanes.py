"""Four numbers that are worked on at once: a vector register as a type of compiled code.

numba's compiler does not put four hinges into a register by itself. A value of this type holds one
number of each of four elements; it is added, multiplied and so on like a float, also with one, so
that the same formula is compiled for one element or for four. Processors with narrower registers
take two or four instructions for one.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, lower_cast, models, register_model

LANES = 4
_DOUBLE, _INDEX = ir.DoubleType(), ir.IntType(32)
_VECTOR = ir.VectorType(_DOUBLE, LANES)
_JOINED = ("contract",)  # products may be joined to sums without rounding in between


class LanesType(types.Type):
    """Numba's type of four numbers."""

    def __init__(self) -> None:
        super().__init__(name="Lanes")


FOUR = LanesType()


@register_model(LanesType)
class _Model(models.PrimitiveModel):  # type: ignore[misc]
    """Four numbers are a vector of LLVM's."""

    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, _VECTOR)


def _splat(builder: Any, value: Any) -> Any:
    one = builder.insert_element(ir.Constant(_VECTOR, ir.Undefined), value, _INDEX(0))
    mask = ir.Constant(ir.VectorType(_INDEX, LANES), [0] * LANES)
    return builder.shuffle_vector(one, ir.Constant(_VECTOR, ir.Undefined), mask)


@lower_cast(types.Float, LanesType)  # type: ignore[untyped-decorator]
def _from_float(context: Any, builder: Any, given: Any, wanted: Any, value: Any) -> Any:
    return _splat(builder, context.cast(builder, value, given, types.float64))


def _operator(function: Callable[..., Any], emit: Callable[[Any, list[Any]], Any]) -> None:
    """Have an operator work on four numbers, or on a float and four."""

    class Template(AbstractTemplate):  # type: ignore[misc]
        def generic(self, args: Any, kws: Any) -> Any:
            kinds = [isinstance(a, LanesType) for a in args]
            fits = all(k or isinstance(a, types.Float) for k, a in zip(kinds, args, strict=True))
            return signature(FOUR, *([FOUR] * len(args))) if any(kinds) and fits else None

    infer_global(function)(Template)
    for count in (1, 2):

        @lower_builtin(function, *([LanesType] * count))  # type: ignore[untyped-decorator]
        def lower(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            return emit(builder, list(args))


def _called(builder: Any, name: str, values: list[Any]) -> Any:
    kind = ir.FunctionType(_VECTOR, [_VECTOR] * len(values))
    return builder.call(cgutils.get_or_insert_function(builder.module, kind, name), values)


_operator(operator.add, lambda b, v: b.fadd(*v, flags=_JOINED))
_operator(operator.sub, lambda b, v: b.fsub(*v, flags=_JOINED))
_operator(operator.mul, lambda b, v: b.fmul(*v, flags=_JOINED))
_operator(operator.truediv, lambda b, v: b.fdiv(*v))
_operator(operator.neg, lambda b, v: b.fneg(*v))
_operator(math.sqrt, lambda b, v: _called(b, "llvm.sqrt.v4f64", v))
_operator(math.floor, lambda b, v: _called(b, "llvm.floor.v4f64", v))
_operator(abs, lambda b, v: _called(b, "llvm.fabs.v4f64", v))


@intrinsic  # type: ignore[untyped-decorator]
def four(typing: Any, a: Any, b: Any, c: Any, d: Any) -> Any:
    """Four numbers from each of them."""

    def emit(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        made = ir.Constant(_VECTOR, ir.Undefined)
        for k, value in enumerate(args):
            made = builder.insert_element(made, value, _INDEX(k))
        return made

    return FOUR(types.float64, types.float64, types.float64, types.float64), emit


@intrinsic  # type: ignore[untyped-decorator]
def splat(typing: Any, value: Any) -> Any:
    """Four times the same number."""
    return FOUR(types.float64), lambda context, builder, sig, args: _splat(builder, args[0])


def _picked(k: int) -> Any:
    @intrinsic  # type: ignore[untyped-decorator]
    def pick(typing: Any, v: Any) -> Any:
        def emit(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            return builder.extract_element(args[0], _INDEX(k))

        return types.float64(FOUR), emit

    return pick


first, second, third, fourth = (_picked(k) for k in range(LANES))
"""One of four numbers."""


@intrinsic  # type: ignore[untyped-decorator]
def where(typing: Any, x: Any, a: Any, b: Any) -> Any:
    """Of each lane, a where x > 0, else b."""

    def emit(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        zero = ir.Constant(_VECTOR, [0.0] * LANES)
        return builder.select(builder.fcmp_ordered(">", args[0], zero), args[1], args[2])

    return FOUR(FOUR, FOUR, FOUR), emit


@intrinsic  # type: ignore[untyped-decorator]
def following(typing: Any, before: Any, v: Any) -> Any:
    """What each lane comes after: the last one of ``before``, then the first three of ``v``."""

    def emit(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        mask = ir.Constant(ir.VectorType(_INDEX, LANES), [3, 4, 5, 6])
        return builder.shuffle_vector(args[0], args[1], mask)

    return FOUR(FOUR, FOUR), emit


@intrinsic  # type: ignore[untyped-decorator]
def transposed(typing: Any, a: Any, b: Any, c: Any, d: Any) -> Any:
    """Rows of four from columns of four, or the other way round."""
    made = types.UniTuple(FOUR, LANES)

    def emit(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        def mixed(x: Any, y: Any, order: list[int]) -> Any:
            return builder.shuffle_vector(x, y, ir.Constant(ir.VectorType(_INDEX, LANES), order))

        a, b, c, d = args
        even, odd = mixed(a, b, [0, 4, 2, 6]), mixed(a, b, [1, 5, 3, 7])
        even_, odd_ = mixed(c, d, [0, 4, 2, 6]), mixed(c, d, [1, 5, 3, 7])
        low, high = [0, 1, 4, 5], [2, 3, 6, 7]
        rows = [mixed(even, even_, low), mixed(odd, odd_, low)]
        rows += [mixed(even, even_, high), mixed(odd, odd_, high)]
        return context.make_tuple(builder, made, rows)

    return made(FOUR, FOUR, FOUR, FOUR), emit


def _address(context: Any, builder: Any, kind: Any, args: Any) -> Any:
    """Pointer to numbers of an array from an entry on: row i and column k, or i alone."""
    array = context.make_array(kind)(context, builder, args[0])
    place = args[1]
    if kind.ndim == 2:
        columns = cgutils.unpack_tuple(builder, array.shape)[1]
        place = builder.add(builder.mul(args[1], columns), args[2])
    return builder.gep(array.data, [place])


def _dense(array: Any, kind: Any = types.float64) -> bool:
    return isinstance(array, types.Array) and array.layout == "C" and array.dtype == kind


@intrinsic  # type: ignore[untyped-decorator]
def load(typing: Any, array: Any, i: Any, k: Any) -> Any:
    """Four entries of row i of an array that follow each other in memory, from column k on.

    k may be negative: the entry is then one of the row before. Of a vector, k is not looked at.
    The array may be of single precision.
    """
    if not (_dense(array) or _dense(array, types.float32)):
        return None

    def emit(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        place = _address(context, builder, sig.args[0], args)
        if sig.args[0].dtype == types.float64:
            return builder.load(builder.bitcast(place, _VECTOR.as_pointer()), align=8)
        single = ir.VectorType(ir.FloatType(), LANES)
        found = builder.load(builder.bitcast(place, single.as_pointer()), align=4)
        return builder.fpext(found, _VECTOR)

    return FOUR(array, types.intp, types.intp), emit


@intrinsic  # type: ignore[untyped-decorator]
def store(typing: Any, array: Any, i: Any, k: Any, v: Any) -> Any:
    """Put four numbers where ``load`` has them from."""
    if not _dense(array):
        return None

    def emit(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        place = _address(context, builder, sig.args[0], args)
        builder.store(args[3], builder.bitcast(place, _VECTOR.as_pointer()), align=8)
        return context.get_dummy_value()

    return types.none(array, types.intp, types.intp, FOUR), emit


def _block(context: Any, builder: Any, kind: Any, array: Any, begin: Any, end: Any) -> Any:
    """Where rows begin ... end - 1 of an array are, and how many bytes they take."""
    made = context.make_array(kind)(context, builder, array)
    size = ir.Constant(begin.type, 8)
    place = begin
    if kind.ndim == 2:
        columns = cgutils.unpack_tuple(builder, made.shape)[1]
        size, place = builder.mul(size, columns), builder.mul(begin, columns)
    return builder.gep(made.data, [place]), builder.mul(builder.sub(end, begin), size)


@intrinsic  # type: ignore[untyped-decorator]
def copy_rows(typing: Any, source: Any, target: Any, begin: Any, end: Any) -> Any:
    """Copy rows begin ... end - 1 of an array to another one of as many columns."""
    if not (_dense(source) and _dense(target) and source.ndim == target.ndim):
        return None

    def emit(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        start, size = _block(context, builder, sig.args[0], args[0], args[2], args[3])
        to, _ = _block(context, builder, sig.args[1], args[1], args[2], args[3])
        cgutils.raw_memcpy(builder, to, start, size, 1, align=8)
        return context.get_dummy_value()

    return types.none(source, target, types.intp, types.intp), emit


@intrinsic  # type: ignore[untyped-decorator]
def clear_rows(typing: Any, array: Any, begin: Any, end: Any) -> Any:
    """Set rows begin ... end - 1 of an array to zero."""
    if not _dense(array):
        return None

    def emit(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        start, size = _block(context, builder, sig.args[0], args[0], args[1], args[2])
        cgutils.memset(builder, start, size, 0)
        return context.get_dummy_value()

    return types.none(array, types.intp, types.intp), emit
