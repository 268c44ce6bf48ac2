"""Hostile files of all formats: only clear errors, in bounded time and memory.

A quarter of a minute of it runs in `make check`, always with the same seed. By hand, with new seeds:

    python -m tests.fuzz --minutes 60
"""
