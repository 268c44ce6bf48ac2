"""What an element of a drawing stands for, told by its names."""

import re
from collections.abc import Iterator
from enum import Enum
from xml.etree.ElementTree import Element

from pilotage.io.svg.style import local_name

NAMING = ("id", "class", "label", "data-name")
"""Attributes that name an element or its layer; `label` is Inkscape's, `data-name` Illustrator's."""

WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+")


class Role(Enum):
    """What a stroke is taken for."""

    WALL = "wall"
    LABEL = "label"
    START = "start"
    GOAL = "goal"
    FURNITURE = "furniture"
    IGNORE = "ignore"


class Thing(Enum):
    """What a stroke is made of in a world to drive in; a drawing does without."""

    SOLID = "solid"
    GLASS = "glass"
    DOOR = "door"
    PERSON = "person"  # the path along which someone walks


SPOKEN = {
    **{role.value: role for role in Role if role is not Role.WALL},
    "labels": Role.LABEL,
    "starts": Role.START,
    "goals": Role.GOAL,
    "ignored": Role.IGNORE,
}
"""The words that give a role; all else is a wall."""

MATERIAL = {**{thing.value: thing for thing in Thing}, "doors": Thing.DOOR, "people": Thing.PERSON}
"""The words that say what it is made of; all else is solid."""


def words(element: Element) -> Iterator[str]:
    """Split the names of an element into words.

    >>> from xml.etree.ElementTree import Element
    >>> list(words(Element("g", {"id": "roomLabels_2", "class": "grey"})))
    ['room', 'labels', 'grey']
    """
    for name, value in element.attrib.items():
        if local_name(name) in NAMING:
            yield from (word.lower() for word in WORD.findall(value))


def role_of(element: Element, inherited: Role) -> Role:
    """Tell an element's role: its own word, else its holder's; IGNORE is never undone."""
    spoken = [SPOKEN[word] for word in words(element) if word in SPOKEN]
    if inherited is Role.IGNORE or Role.IGNORE in spoken:
        return Role.IGNORE
    return spoken[0] if spoken else inherited


def thing_of(element: Element, inherited: Thing) -> Thing:
    """Tell what an element is made of: by its own word, else as its holder."""
    return next((MATERIAL[word] for word in words(element) if word in MATERIAL), inherited)
