"""Kernels as their callers take them in: one compilation of each, to machine code but once.

numba makes machine code of every function that it compiles, and of all that the function calls
along with it: a kernel at the bottom of six others is optimised and translated seven times. Most
kernels are never run on their own. They stay LLVM's intermediate code here, which whoever is called
from Python takes in and translates; a cold start takes a quarter less.

What is overridden here is not a public part of numba; tried with 0.60 and 0.68.
"""

from __future__ import annotations

from typing import Any

from llvmlite import binding
from numba.core.caching import CompileResultCacheImpl, FunctionCache
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler, CompileResult
from numba.core.cpu import CPUContext


class _Unfinished(JITCodeLibrary):  # type: ignore[misc]
    """Intermediate code to be taken in by others; nothing of it can be run."""

    def _optimize_final_module(self) -> None:
        """Left to whoever takes the code in."""

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:
        """Nowhere: numba keeps what it makes of this as a key, and never calls it."""
        return 0

    @property
    def codegen(self) -> _WithoutPlaces:
        return _WithoutPlaces(self._codegen)

    def serialize_using_object_code(self) -> tuple[str, str, bytes]:
        code: tuple[str, str, bytes] = self.serialize_using_bitcode()
        return code


class _WithoutPlaces:
    """A code generator whose functions are nowhere in memory."""

    def __init__(self, codegen: Any) -> None:
        self._codegen = codegen

    def __getattr__(self, name: str) -> Any:
        return getattr(self._codegen, name)

    def set_env(self, name: str, environment: object) -> None:
        """Without a place for it; only what makes Python objects would need one."""

    def unserialize_library(self, serialized: tuple[str, str, bytes]) -> _Unfinished:
        """Intermediate code as it was cached."""
        name, _, code = serialized
        library = _Unfinished(self._codegen, name)
        library._final_module = binding.parse_bitcode(code)
        library._finalize_final_module()
        return library


class _WithoutMachine:
    """The processor that code is compiled for, as what is read from the cache needs it."""

    def __init__(self, context: CPUContext) -> None:
        self._context = context

    def __getattr__(self, name: str) -> Any:
        return getattr(self._context, name)

    def codegen(self) -> _WithoutPlaces:
        return _WithoutPlaces(self._context.codegen())


class _Reader(CompileResultCacheImpl):  # type: ignore[misc]
    def rebuild(self, target_context: CPUContext, payload: tuple[Any, ...]) -> CompileResult:
        return CompileResult._rebuild(_WithoutMachine(target_context), *payload)


class InnerCache(FunctionCache):  # type: ignore[misc]
    """Where intermediate code is kept from one process to the next."""

    _impl_class = _Reader


class InnerCompiler(Compiler):  # type: ignore[misc]
    """numba's compiler as far as intermediate code."""

    def define_pipelines(self) -> list[Any]:
        state = self.state
        state.library = _Unfinished(state.targetctx.codegen(), state.func_id.func_qualname)
        pipelines: list[Any] = super().define_pipelines()
        return pipelines
