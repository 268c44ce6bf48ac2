"""What workers are forked with: importing this loads all that a drive needs, compiled code too."""

import itertools
import logging


def load() -> None:
    """Drive a few steps in a packed building, so that every kernel is in memory."""
    from pilotage.drives import drive, set_out
    from pilotage.io import open_map, open_world
    from pilotage.worlds import OFFICE

    navigator, simulator = set_out(open_map(OFFICE.careful), open_world(OFFICE.world), "Ana")
    for _ in itertools.islice(drive(navigator, simulator), 40):
        pass


try:
    load()
except Exception:  # a worker will say what is wrong, when it is asked to do something
    logging.getLogger(__name__).exception("the workers could not be prepared")
