"""How a robot on the network is reached, and what may be sent to it: light to import."""

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pilotage.ros.robot import Wire


class Transport(StrEnum):
    """What carries topics of ROS 2."""

    DDS = "dds"
    ZENOH = "zenoh"


@dataclass(frozen=True, slots=True)
class Topics:
    """Names of topics, and what may be sent."""

    scan: str = "scan"
    odometry: str = "odom"
    command: str = "cmd_vel"
    stamped: bool = False  # commands are TwistStamped, as robots of ROS 2 Jazzy and later want
    drives: bool = False  # False: no command is ever sent
    localizes_only: bool = False  # no goals are heard
    hears_wishes: bool = True  # starts and goals are heard by topic


@dataclass(frozen=True, slots=True)
class Link:
    """Where a robot's topics are found."""

    domain: int = 0
    namespace: str = ""
    transport: Transport = Transport.DDS

    def join(self) -> "Wire":
        """Join the domain; raises NoTransportError if that cannot be done."""
        if self.transport is Transport.ZENOH:
            from pilotage.ros.zenoh_node import ZenohNode

            return ZenohNode(self.domain, self.namespace)
        from pilotage.ros.node import Node

        return Node(self.domain, self.namespace)
