"""numba's `njit`, which also compiles where there is no place for a cache.

To unpack a row of an array, to copy a slice onto a slice or to call `np.diff` takes a second or two to
compile: what raises on a wrong shape formats numbers. Kernels name the numbers one by one.
"""

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
