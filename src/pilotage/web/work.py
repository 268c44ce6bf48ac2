"""What workers do, by name: light to import, so that the server stays so; each loads what it needs."""

from multiprocessing.connection import Connection
from typing import TYPE_CHECKING

from pilotage.web.order import Order, Place, RobotOrder, Sent

if TYPE_CHECKING:
    from pilotage.config import Settings


def drive(connection: Connection, order: Order) -> None:
    """Drive, until the server ends it."""
    if isinstance(order.world, RobotOrder):
        from pilotage.web.robot_driver import drive_robot

        drive_robot(connection, order, order.world)
        return
    from pilotage.web.driver import drive_in_worker

    drive_in_worker(connection, order)


def understand(
    sent: Sent, ends: tuple[Place, Place] | None, settings: "Settings | None"
) -> dict[str, object]:
    """Say what is understood of a drawing."""
    from pilotage.web import understanding

    return understanding.understand(sent, ends, settings)


def read_upload(sent: Sent) -> dict[str, object]:
    """Read a file that a person dropped on the page."""
    from pilotage.web import drawings

    return drawings.read_upload(sent)
