"""What several benchmarks share: data, buildings, errands, protocols, arguments and results."""
