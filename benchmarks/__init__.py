"""Measure what the project claims: one module a claim, run as `python -m benchmarks NAME`."""
