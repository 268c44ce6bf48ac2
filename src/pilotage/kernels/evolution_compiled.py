"""Discrete curve evolution, compiled: `evolve_runs` of `evolution`, some 30 times as fast."""

from numba.extending import register_jitable

from pilotage.kernels import evolution
from pilotage.kernels.compiling import njit

for helper in (
    evolution.relevance,
    evolution.is_between,
    evolution.is_in_triangle,
    evolution.sort_into_grid,
    evolution.find_in_triangle,
    evolution.link_vertices,
):
    register_jitable(helper)  # callable from compiled code, and still plain Python for all others

evolve_runs = njit(cache=True)(evolution.evolve_runs)
