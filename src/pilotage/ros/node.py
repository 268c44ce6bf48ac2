"""A node among those of a robot: topics of ROS 2 over DDS, as rmw implementations carry them."""

from dataclasses import dataclass
from typing import Any

from pilotage.errors import PilotageError
from pilotage.io.bags.outgoing import typestore
from pilotage.ros.idl import idl_type

LATCHED_DEPTH = 100
"""Messages kept of a latched topic that several nodes may publish on, /tf_static above all."""


class NoTransportError(PilotageError):
    """The library that carries messages is not installed, or finds no network."""


class Subscription:
    """Messages of one topic, taken when asked for."""

    def __init__(self, reader: Any, type_name: str, depth: int) -> None:  # noqa: ANN401  # of cyclonedds
        self._reader, self._type_name, self._depth = reader, type_name, depth

    def take(self) -> list[Any]:
        """Return the messages that came since the last time, oldest first; broken ones are passed over."""
        messages = []
        for sample in self._reader.take(N=self._depth):
            if not getattr(sample.sample_info, "valid_data", False):
                continue
            try:
                messages.append(typestore().deserialize_cdr(sample.raw, self._type_name))
            except Exception:  # noqa: BLE001, S112  # another may send what it likes
                continue
        return messages


class Publisher:
    """Sends messages on one topic."""

    def __init__(self, writer: Any, type_name: str) -> None:  # noqa: ANN401  # of cyclonedds
        self._writer, self._type_name, self._type = writer, type_name, idl_type(type_name)

    def publish(self, message: Any) -> None:  # noqa: ANN401  # made at run time
        """Send a message."""
        self._writer.write(self._type(bytes(typestore().serialize_cdr(message, self._type_name))))


@dataclass(frozen=True, slots=True)
class Quality:
    """How messages of a topic are kept and delivered."""

    depth: int = 1
    reliable: bool = False
    latched: bool = False


class Node:
    """Joins a domain; topics without a leading slash are in the namespace."""

    def __init__(self, domain: int = 0, namespace: str = "") -> None:
        try:
            from cyclonedds.core import WaitSet
            from cyclonedds.domain import DomainParticipant
            from cyclonedds.qos import Policy, Qos
        except ImportError as error:
            raise NoTransportError(
                "a live robot needs the extra ros2: pip install 'pilotage[ros2]'"
            ) from error
        try:
            self._participant = DomainParticipant(domain, qos=Qos(Policy.Userdata(b"enclave=/;")))
        except Exception as error:  # whatever DDS finds wrong with the network
            raise NoTransportError(f"domain {domain} cannot be joined ({error})") from error
        self._namespace = namespace.strip("/")
        self._topics: dict[tuple[str, str], Any] = {}
        self._wait_set = WaitSet(self._participant)
        self._conditions: list[Any] = []

    def subscribe(self, topic: str, type_name: str, quality: Quality = Quality()) -> Subscription:
        """Listen to a topic; a reader that is not reliable hears reliable writers too."""
        from cyclonedds.core import InstanceState, ReadCondition, SampleState, ViewState
        from cyclonedds.sub import DataReader

        reader = DataReader(
            self._participant, self._topic(topic, type_name), qos=policies(quality, type_name)
        )
        condition = ReadCondition(reader, ViewState.Any | SampleState.NotRead | InstanceState.Alive)
        self._wait_set.attach(condition)
        self._conditions.append(condition)
        return Subscription(reader, type_name, quality.depth)

    def advertise(self, topic: str, type_name: str, *, latched: bool = False) -> Publisher:
        """Open a topic to publish on."""
        from cyclonedds.pub import DataWriter

        quality = Quality(depth=1 if latched else 10, reliable=True, latched=latched)
        writer = DataWriter(
            self._participant, self._topic(topic, type_name), qos=policies(quality, type_name)
        )
        return Publisher(writer, type_name)

    def wait(self, seconds: float) -> None:
        """Wait until a message comes, but no longer than this [s]."""
        self._wait_set.wait(int(seconds * 1e9))

    def _topic(self, topic: str, type_name: str) -> Any:  # noqa: ANN401  # of cyclonedds
        from cyclonedds.topic import Topic

        key = full_name(topic, self._namespace), type_name
        if key not in self._topics:
            self._topics[key] = Topic(self._participant, f"rt{key[0]}", idl_type(type_name))
        return self._topics[key]


def full_name(topic: str, namespace: str) -> str:
    """Return a topic with its namespace.

    >>> full_name("scan", "robot1"), full_name("/tf", "robot1"), full_name("scan", "")
    ('/robot1/scan', '/tf', '/scan')
    """
    if topic.startswith("/") or not namespace:
        return "/" + topic.lstrip("/")
    return f"/{namespace}/{topic}"


def policies(quality: Quality, type_name: str) -> Any:  # noqa: ANN401  # of cyclonedds
    """Return the policies of an endpoint; its user data tell the hash of the type (REP-2016)."""
    from cyclonedds.qos import Policy, Qos
    from cyclonedds.util import duration

    reliability = Policy.Reliability
    durability = Policy.Durability
    type_hash = f"typehash={typestore().hash_rihs01(type_name)};"
    return Qos(
        reliability.Reliable(duration(milliseconds=10)) if quality.reliable else reliability.BestEffort,
        durability.TransientLocal if quality.latched else durability.Volatile,
        Policy.History.KeepLast(quality.depth),
        Policy.DataRepresentation(use_cdrv0_representation=True),
        Policy.Userdata(type_hash.encode()),
    )
