"""numba's `njit`, which also compiles where there is no place for a cache."""

from collections.abc import Callable
from typing import ParamSpec, TypeVar, cast

import numba

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")


def njit(*, cache: bool) -> Callable[[Callable[Arguments, Result]], Callable[Arguments, Result]]:
    """Compile a function at its first call; keep the result on disk if asked to, and if that is possible."""

    def compiled(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
        try:
            return cast("Callable[Arguments, Result]", numba.njit(cache=cache)(function))
        except RuntimeError:  # "no locator available": nothing is writable, not even a temporary folder
            return cast("Callable[Arguments, Result]", numba.njit(function))

    return compiled
