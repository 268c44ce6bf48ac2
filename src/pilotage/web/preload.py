"""What workers are forked with: importing this loads all that a drive needs, compiled code too."""

import itertools
import logging
from dataclasses import replace

STEPS = 40
"""Steps after which the robot has looked around, searched the drawing and planned."""


def load() -> None:
    """Understand a drawing and drive a few steps by it, so that every kernel is in memory.

    The kernels are the same with few particles and a coarse look at the drawing.
    """
    from pilotage.config import Settings
    from pilotage.drives import drive, set_out
    from pilotage.io import open_map, open_world
    from pilotage.ranking.evidence import reduced
    from pilotage.web.order import Sent
    from pilotage.web.understanding import understand
    from pilotage.worlds import OFFICE

    understand(Sent(".svg", OFFICE.careful.read_bytes()))
    settings = Settings()
    few = replace(settings, localizer=reduced(settings.localizer, 1 / 16, fineness=1 / 4))
    navigator, simulator = set_out(open_map(OFFICE.careful), open_world(OFFICE.world), "Ana", settings=few)
    list(itertools.islice(drive(navigator, simulator), STEPS))


try:
    load()
except Exception:  # a worker will say what is wrong, when it is asked to do something
    logging.getLogger(__name__).exception("the workers could not be prepared")
