"""Settings of every stage, nested."""
