"""A node among those of a robot that uses rmw_zenoh: topics of ROS 2 over Zenoh.

Keys, attachments and liveliness tokens are as rmw_zenoh writes them: https://github.com/ros2/rmw_zenoh,
docs/design.md. Messages have the same bytes as over DDS.
"""

import itertools
import os
import threading
import time
import uuid
from collections import deque
from typing import Any

from pilotage.io.bags.outgoing import typestore
from pilotage.ros.node import NoTransportError, Quality, full_name

ROUTER = "tcp/localhost:7447"
"""Where the router of a robot listens, ..."""
CHOSEN = "ZENOH_SESSION_CONFIG_URI"
"""... unless this environment variable names a file that says otherwise."""
PATIENCE_MS = 3000
"""Time [ms] in which the router must answer."""
NODE_NAME = "pilotage"
SENT_DEPTH = 10
"""Messages that are kept for sending."""
NEWEST = Quality()


class ZenohSubscription:
    """Messages of one topic, taken when asked for."""

    def __init__(self, type_name: str, depth: int, woken: threading.Event) -> None:
        self._type_name, self._woken = type_name, woken
        self._waiting: deque[bytes] = deque(maxlen=depth)
        self.entities: list[Any] = []  # of zenoh: it listens as long as they live

    def hear(self, sample: Any) -> None:  # noqa: ANN401  # of zenoh
        """Keep a message; called by a thread of zenoh."""
        self._waiting.append(sample.payload.to_bytes())
        self._woken.set()

    def take(self) -> list[Any]:
        """Return the messages that came since the last time, oldest first; broken ones are passed over."""
        messages = []
        while self._waiting:
            try:
                messages.append(typestore().deserialize_cdr(self._waiting.popleft(), self._type_name))
            except Exception:  # noqa: BLE001, S112  # another may send what it likes
                continue
        return messages


class ZenohPublisher:
    """Sends messages on one topic."""

    def __init__(self, publisher: Any, token: Any, type_name: str) -> None:  # noqa: ANN401  # of zenoh
        self._publisher, self._token, self._type_name = publisher, token, type_name
        self._identity, self._numbers = uuid.uuid4().bytes, itertools.count(1)

    def publish(self, message: Any) -> None:  # noqa: ANN401  # made at run time
        """Send a message."""
        payload = bytes(typestore().serialize_cdr(message, self._type_name))
        self._publisher.put(
            payload, attachment=attachment(next(self._numbers), time.time_ns(), self._identity)
        )


class ZenohNode:
    """Joins a domain over Zenoh; topics without a leading slash are in the namespace.

    `config` is a `zenoh.Config`; without it, the router of this machine is asked for the others, as rmw_zenoh
    does. Raises NoTransportError if the library is missing or the router does not answer.
    """

    def __init__(self, domain: int = 0, namespace: str = "", config: Any = None) -> None:  # noqa: ANN401
        try:
            import zenoh
        except ImportError as error:
            raise NoTransportError("Zenoh needs the extra zenoh: pip install 'pilotage[zenoh]'") from error
        try:
            self._session: Any = zenoh.open(chosen_config() if config is None else config)
        except zenoh.ZError as error:
            raise NoTransportError(
                f"no router of Zenoh answers ({reason_in(error)}); "
                f"`ros2 run rmw_zenoh_cpp rmw_zenohd` starts one at {ROUTER}"
            ) from error
        self._domain, self._namespace = domain, namespace.strip("/")
        self._woken = threading.Event()
        self._numbers = itertools.count()
        self._token = self._declare_token("NN")

    def subscribe(self, topic: str, type_name: str, quality: Quality = NEWEST) -> ZenohSubscription:
        """Listen to a topic; what a latched one said before is heard, too."""
        from zenoh.ext import HistoryConfig, declare_advanced_subscriber

        subscription = ZenohSubscription(type_name, quality.depth, self._woken)
        key = self._key(topic, type_name)
        if quality.latched:
            past = HistoryConfig(detect_late_publishers=True, max_samples=quality.depth)
            listening: Any = declare_advanced_subscriber(self._session, key, subscription.hear, history=past)
        else:
            listening = self._session.declare_subscriber(key, subscription.hear)
        subscription.entities += [listening, self._declare_token("MS", topic, type_name, quality)]
        return subscription

    def advertise(self, topic: str, type_name: str, *, latched: bool = False) -> ZenohPublisher:
        """Open a topic to publish on."""
        from zenoh.ext import CacheConfig, declare_advanced_publisher

        quality = Quality(depth=1 if latched else SENT_DEPTH, reliable=True, latched=latched)
        key = self._key(topic, type_name)
        if latched:
            publisher: Any = declare_advanced_publisher(
                self._session, key, cache=CacheConfig(quality.depth), publisher_detection=True
            )
        else:
            publisher = self._session.declare_publisher(key, express=True)
        return ZenohPublisher(publisher, self._declare_token("MP", topic, type_name, quality), type_name)

    def wait(self, seconds: float) -> None:
        """Wait until a message comes, but no longer than this [s]."""
        self._woken.wait(seconds)
        self._woken.clear()

    def close(self) -> None:
        """Leave the network."""
        self._session.close()

    def _key(self, topic: str, type_name: str) -> str:
        return topic_key(self._domain, full_name(topic, self._namespace), type_name)

    def _declare_token(
        self, kind: str, topic: str = "", type_name: str = "", quality: Quality = NEWEST
    ) -> Any:  # noqa: ANN401
        """Tell all others that a node, a publisher or a subscription is alive."""
        number, place = next(self._numbers), f"/{self._namespace}" if self._namespace else ""
        words = [
            "@ros2_lv",
            self._domain,
            self._session.zid(),
            0,
            number,
            kind,
            "%",
            mangled(place),
            NODE_NAME,
        ]
        if type_name:
            name = mangled(full_name(topic, self._namespace))
            words += [name, dds_name(type_name), typestore().hash_rihs01(type_name), quality_words(quality)]
        return self._session.liveliness().declare_token("/".join(map(str, words)))


def chosen_config() -> Any:  # noqa: ANN401  # of zenoh
    """Read the file that the environment names, as rmw_zenoh does, else look for the router here.

    Raises NoTransportError if the file cannot be used.
    """
    import zenoh

    path = os.environ.get(CHOSEN)
    if not path:
        return peer_config(connect=ROUTER)
    try:
        return zenoh.Config.from_file(path)
    except zenoh.ZError as error:
        rule = f"{CHOSEN} must name a configuration of Zenoh ({reason_in(error)})"
        raise NoTransportError(f"{rule}: {path}") from error


def reason_in(error: Exception) -> str:
    """Return what Zenoh says of an error in one line, without the line of its own source."""
    return " ".join(str(error).split()).partition(" at /")[0]


def peer_config(*, listen: str = "tcp/localhost:0", connect: str | None = None) -> Any:  # noqa: ANN401
    """Make the configuration of a peer that finds others by a router or peer at an address."""
    import json

    import zenoh

    config = zenoh.Config()
    for key, value in {
        "mode": "peer",
        "listen/endpoints": [listen],
        "connect/endpoints": [] if connect is None else [connect],
        "connect/timeout_ms": PATIENCE_MS,
        "connect/exit_on_failure": True,
        "scouting/multicast/enabled": False,
        "timestamping/enabled": True,  # caches of latched topics need it
    }.items():
        config.insert_json5(key, json.dumps(value))
    return config


def topic_key(domain: int, name: str, type_name: str) -> str:
    """Return the key of a topic, given by its full name.

    >>> topic_key(7, "/robot1/chatter", "std_msgs/msg/String").rpartition("/")[0]
    '7/robot1/chatter/std_msgs::msg::dds_::String_'
    """
    return f"{domain}/{name.strip('/')}/{dds_name(type_name)}/{typestore().hash_rihs01(type_name)}"


def dds_name(type_name: str) -> str:
    """Return the name of a type of ROS as DDS has it.

    >>> dds_name("sensor_msgs/msg/LaserScan")
    'sensor_msgs::msg::dds_::LaserScan_'
    """
    package, kind, name = type_name.split("/")
    return f"{package}::{kind}::dds_::{name}_"


def mangled(name: str) -> str:
    """Return a name of ROS as one word of a key.

    >>> mangled("/robot1/scan"), mangled("")
    ('%robot1%scan', '%')
    """
    return name.replace("/", "%") or "%"


def quality_words(quality: Quality) -> str:
    """Write the qualities of a topic as liveliness tokens do; what is as by default is left out.

    >>> quality_words(Quality(10, reliable=True)), quality_words(Quality(1, latched=True))
    ('::,10:,:,:,,', '2:1:,1:,:,:,,')
    """
    return f"{'' if quality.reliable else 2}:{1 if quality.latched else ''}:,{quality.depth}:,:,:,,"


def attachment(number: int, stamp_ns: int, identity: bytes) -> bytes:
    """Return what goes with each message: its number, its time [ns], and who sends it (16 bytes).

    >>> attachment(1, 2, bytes(16)).hex(" ", -8)
    '0100000000000000 0200000000000000 1000000000000000 0000000000000000 00'
    """
    return number.to_bytes(8, "little") + stamp_ns.to_bytes(8, "little") + bytes([len(identity)]) + identity
