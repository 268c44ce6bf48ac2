"""The floor of the demo: offices, a bent corridor, an irregular hall. Metres, y down as on the page."""

import numpy as np

from floors.office import WALLS
from floors.plan import Points, box

# What stands in the building and in no drawing.
THINGS: list[Points] = [
    box(0.3, 3.3, 1.5, 0.8), box(3.2, 5.0, 0.9, 1.6),  # desks of the office
    box(6.2, 3.4, 2.6, 1.3), box(4.4, 1.2, 2.0, 0.45),  # table and sideboard of the meeting room
    box(10.8, 5.2, 0.6, 1.2),  # copier
    box(13.4, 0.3, 0.7, 4.2), box(15.2, 3.6, 3.2, 0.9), box(20.1, 5.2, 0.7, 2.2),  # benches of the lab
    box(0.3, 11.6, 0.5, 3.8), box(2.4, 13.4, 0.5, 2.6), box(4.2, 13.4, 0.5, 2.6),  # shelves of the archive
    box(6.4, 13.6, 2.2, 0.4), box(6.4, 15.6, 2.2, 0.4), box(10.6, 16.6, 1.2, 1.2), box(12.4, 13.8, 1.5, 0.9),
    box(14.4, 14.6, 3.0, 0.6), box(17.6, 12.2, 1.0, 1.0),  # counter and table of the kitchen
    box(14.5, 16.0, 0.6, 2.0), box(15.6, 18.9, 2.8, 0.8),  # shelves of the store
    box(23.0, 14.2, 2.4, 1.2), box(27.4, 14.0, 1.2, 3.2), box(22.2, 19.0, 3.0, 0.7),  # of the workshop
    box(30.3, 17.6, 1.6, 0.8),  # desk of the corner office
    box(8.6, 8.6, 1.4, 0.35), box(4.9, 10.25, 1.1, 0.35), box(19.3, 13.0, 0.35, 1.4),  # cupboards, corridor
    box(27.6, 5.6, 1.9, 1.9), box(23.0, 0.3, 1.6, 0.6), box(33.6, 6.4, 0.5, 1.6),  # of the hall
    box(24.2, 9.0, 0.45, 0.45), box(25.0, 3.4, 0.5, 0.5), box(30.4, 8.6, 0.5, 0.5),
    box(9.9, 14.6, 0.45, 0.45),
]  # fmt: skip

NAMES: list[tuple[str, float, float]] = [
    ("office", 2.1, 6.3),
    ("meeting", 7.4, 5.8),
    ("copier", 11.9, 6.9),
    ("lab", 17.0, 5.6),
    ("hall", 26.6, 9.0),
    ("archive", 3.1, 12.8),
    ("library", 9.6, 16.9),
    ("kitchen", 16.7, 13.4),
    ("store", 16.7, 17.4),
    ("workshop", 25.8, 17.9),
    ("Ana", 31.4, 15.2),
]

# From the office to the library, the lab and round the hall, through the workshop to the kitchen.
WAYPOINTS = np.array(
    [
        (2.3, 5.6), (2.4, 7.6), (2.4, 9.2), (3.7, 9.6), (6.5, 9.5), (9.6, 9.9), (10.4, 10.6), (10.4, 12.2),
        (9.4, 12.6), (11.2, 13.2), (11.6, 15.3), (10.9, 13.2), (10.4, 11.6), (10.5, 10.0), (12.5, 9.6),
        (16.0, 9.6), (17.6, 9.4), (18.2, 8.6), (18.2, 7.2), (17.0, 5.6), (18.4, 6.6), (18.3, 8.4),
        (18.9, 9.5),
        (21.0, 9.8), (23.2, 7.8), (23.4, 4.6), (24.2, 2.4), (26.6, 2.0), (30.2, 3.2), (31.9, 6.0),
        (31.9, 9.4),
        (28.6, 10.4), (25.8, 10.8), (25.6, 12.6), (26.3, 14.6), (26.2, 17.6), (24.0, 17.6), (21.8, 17.9),
        (20.5, 17.0), (20.5, 14.0), (20.4, 11.2), (18.0, 9.6), (16.4, 10.0), (16.35, 11.2), (16.2, 13.2),
    ]
)  # fmt: skip

__all__ = ["NAMES", "THINGS", "WALLS", "WAYPOINTS"]
