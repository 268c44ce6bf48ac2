"""Numba and plain functions on arrays and numbers: no type of ours, no checks."""
