"""The demo's drawing and log, packed with the package; `examples/make_demo.py` made them."""

from importlib.resources import files
from pathlib import Path

FOLDER = Path(str(files(__name__)))
SKETCH = FOLDER / "sketch.svg"
"""The floor of an office, drawn from a poor memory."""
LOG = FOLDER / "run.log.gz"
"""A robot's drive through that floor, furniture and all; simulated."""
WORLD = FOLDER / "world.svg"
"""The true floor [m]; the localizer never sees it."""
TRUTH = FOLDER / "truth.jsonl"
"""Where the robot truly was on the drawing at each scan; to be drawn beside the estimate, no more."""

__all__ = ["LOG", "SKETCH", "TRUTH", "WORLD"]
