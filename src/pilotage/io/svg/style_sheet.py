"""What the style sheets of a document declare for its elements: CSS 2.1's plain selectors."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Self
from xml.etree.ElementTree import Element

from pilotage.io.svg.style import declarations, is_named, local_name

BRACE = re.compile(r"[{};]")
ATTRIBUTE = r"\[([\w:-]+)(?:([~|^$*]?=)[\"']?([^\"'\]\s]*)[\"']?)?\]"
COMPOUND = re.compile(rf"([\w-]+|\*)?((?:[.#][\w-]+|{ATTRIBUTE})*)")
PART = re.compile(rf"([.#])([\w-]+)|{ATTRIBUTE}")


@dataclass(frozen=True, slots=True)
class Selector:
    """A chain of compounds such as `g.walls > line`; the last one is the element's own."""

    compounds: tuple[str, ...]
    child: tuple[bool, ...]  # whether compound k is the parent of compound k + 1, not any ancestor

    @classmethod
    def read(cls, text: str) -> Self | None:
        """Read one selector; None for what is not understood (pseudo-classes, siblings)."""
        compounds: list[str] = []
        child: list[bool] = []
        direct = False
        for part in text.replace(">", " > ").split():
            if part == ">":
                direct = True
                continue
            if COMPOUND.fullmatch(part) is None:
                return None
            if compounds:
                child.append(direct)
            compounds.append(part)
            direct = False
        return cls(tuple(compounds), tuple(child)) if compounds else None

    @property
    def specificity(self) -> tuple[int, int, int]:
        """How many ids, classes or attributes, and tags it names: the more specific rule wins."""
        kinds = [part[1] for compound in self.compounds for part in PART.finditer(compound)]
        tags = sum(compound[0] not in ".#*[" for compound in self.compounds)
        return kinds.count("#"), len(kinds) - kinds.count("#"), tags

    def matches(self, chain: Sequence[Element]) -> bool:
        """Tell whether it selects the last element of a chain that begins at the root.

        Goes up the chain once, with all compounds that an element may stand for.
        """
        wanted, descendants = {len(self.compounds) - 1}, set[int]()
        for element in reversed(chain):
            found = {k for k in wanted if compound_matches(self.compounds[k], element)}
            if 0 in found:
                return True
            descendants |= {k - 1 for k in found if not self.child[k - 1]}
            wanted = descendants | {k - 1 for k in found}
            if not wanted:
                return False
        return False


def compound_matches(compound: str, element: Element) -> bool:
    """Tell whether tag, ids, classes and attributes of one compound are all the element's."""
    match = COMPOUND.fullmatch(compound)
    assert match is not None, "Selector.read lets no other through"
    if match[1] not in (None, "*", local_name(element.tag)):
        return False
    return all(part_matches(part, element) for part in PART.finditer(match[2]))


def part_matches(part: re.Match[str], element: Element) -> bool:
    """Tell whether an id, a class or an attribute of a compound is the element's."""
    kind, name, attribute, how, wanted = part.groups()
    if kind is not None:
        return name == element.get("id") if kind == "#" else name in element.get("class", "").split()
    value = next((value for key, value in element.attrib.items() if local_name(key) == attribute), None)
    if value is None or how is None:
        return value is not None
    return {
        "=": value == wanted,
        "~=": wanted in value.split(),
        "|=": value == wanted or value.startswith(f"{wanted}-"),
        "^=": bool(wanted) and value.startswith(wanted),
        "$=": bool(wanted) and value.endswith(wanted),
        "*=": bool(wanted) and wanted in value,
    }[how]


@dataclass(frozen=True, slots=True)
class StyleSheet:
    """The rules of all `<style>` elements, the least specific first."""

    rules: tuple[tuple[Selector, Mapping[str, str]], ...] = ()

    @classmethod
    def of(cls, root: Element) -> Self:
        """Collect the rules of a document."""
        texts = ("".join(node.itertext()) for node in root.iter() if is_named(node, "style"))
        rules = [rule for text in texts for rule in read_rules(text)]
        return cls(tuple(sorted(rules, key=lambda rule: rule[0].specificity)))  # stable: the later one wins

    def declared(self, chain: Sequence[Element]) -> dict[str, str]:
        """Collect what is declared for the last element of a chain: attributes, then rules, then `style`."""
        element = chain[-1]
        found = {local_name(name): value.strip() for name, value in element.attrib.items()}
        for selector, values in self.rules:
            if selector.matches(chain):
                found.update(values)
        found.update(declarations(element.get("style", "")))
        return found


def read_rules(text: str) -> Iterator[tuple[Selector, Mapping[str, str]]]:
    """Read the rules of a style sheet that this reader understands."""
    for names, body in plain_blocks(without_comments(text)):
        for name in names.split(","):
            selector = Selector.read("svg" if name.strip() == ":root" else name)
            if selector is not None:
                yield selector, declarations(body)


def without_comments(text: str) -> str:
    """Take away comments of CSS, and the marks of those of XML.

    >>> without_comments("a /* b */ c <!-- d")
    'a  c  d'
    """
    head, *others = text.split("/*")
    kept = "".join([head, *(part.partition("*/")[2] for part in others)])
    return kept.replace("<!--", "").replace("-->", "")


def plain_blocks(text: str) -> Iterator[tuple[str, str]]:
    """Yield what stands before each pair of braces and in it; @-rules and what is in them are left out.

    >>> list(plain_blocks("@import x; a {b: c} @media print {d {e: f}} g {}"))
    [(' a ', 'b: c'), (' g ', '')]
    """
    depth, start, names = 0, 0, ""
    for mark in BRACE.finditer(text):
        if mark[0] == "{":
            if depth == 0:
                names, start = text[start : mark.start()], mark.end()
            depth += 1
        elif mark[0] == "}":
            if depth == 1 and not names.lstrip().startswith("@"):
                yield names, text[start : mark.start()]
            depth = max(depth - 1, 0)
            start = mark.end() if depth == 0 else start
        elif depth == 0:
            start = mark.end()
