"""Write laser logs in CARMEN's text format."""

import gzip
import math
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from pilotage.io.files import replacing
from pilotage.perception import Reading

NO_RETURN = 81.91  # [m] what the format's robots wrote for a beam that did not come back


def write_log(path: Path | str, readings: Iterable[Reading]) -> None:
    """Write one FLASER line a scan, packed if the name ends in `.gz`.

    The format knows no angles: the reader takes a scan to span 180 degrees, first beam to the right. Beams
    that came back too early to be measured are written as 0.
    """
    text = "".join(line(reading) + "\n" for reading in readings)
    content = text.encode("ascii")
    with replacing(path) as beside:
        beside.write_bytes(gzip.compress(content, mtime=0) if str(path).endswith(".gz") else content)


def line(reading: Reading) -> str:
    """Write one reading as a FLASER message."""
    scan, odom_from_base = reading.scan, reading.odometry.odom_from_base
    ranges = np.nan_to_num(scan.ranges, nan=NO_RETURN, posinf=NO_RETURN, neginf=0.0)
    beams = " ".join(f"{distance:.2f}" for distance in ranges)
    odom_from_laser = odom_from_base @ scan.base_from_laser
    poses = " ".join(
        f"{pose.x:.4f} {pose.y:.4f} {math.remainder(pose.theta, math.tau):.5f}"
        for pose in (odom_from_laser, odom_from_base)
    )
    return f"FLASER {len(ranges)} {beams} {poses} {scan.stamp:.3f} robot {scan.stamp:.3f}"
