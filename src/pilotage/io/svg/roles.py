"""What an element stands for, told by its names."""

from collections.abc import Iterator
from enum import Enum
from xml.etree.ElementTree import Element

from pilotage.interpretation import Role, role_named, words_of
from pilotage.interpretation.names import is_room
from pilotage.io.svg.style import local_name

NAMING = ("id", "class", "label", "data-name")
"""Attributes that name an element or its layer; `label` is Inkscape's, `data-name` Illustrator's."""

CLOSED, ALWAYS = "data-closed", "always"
"""Where a door of a world says when it is closed, and what it says if it never opens."""


class Thing(Enum):
    """What a stroke is made of in a world to drive in; a drawing does without."""

    SOLID = "solid"
    GLASS = "glass"
    DOOR = "door"
    PERSON = "person"  # the path along which someone walks


MATERIAL = {**{thing.value: thing for thing in Thing}, "doors": Thing.DOOR, "people": Thing.PERSON}
"""The words that say what it is made of; all else is solid."""


def names_of(element: Element) -> Iterator[str]:
    """List the names that an element has of its own; that it is a room comes last, it counts most."""
    own = [value for name, value in element.attrib.items() if local_name(name) in NAMING and value]
    yield from sorted(own, key=lambda name: is_room([name]))


def role_of(element: Element, inherited: Role) -> Role:
    """Tell the role of a body in a world: its own word, else its holder's; IGNORE is never undone."""
    return role_named(names_of(element), inherited)


def thing_of(element: Element, inherited: Thing) -> Thing:
    """Tell what an element is made of: by its own word, else as its holder."""
    spoken = (word for name in names_of(element) for word in words_of(name))
    return next((MATERIAL[word] for word in spoken if word in MATERIAL), inherited)
