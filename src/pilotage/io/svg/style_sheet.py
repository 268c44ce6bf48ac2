"""What the style sheets of a document declare for its elements; selectors are cssselect2's."""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from xml.etree.ElementTree import Element

import cssselect2
import tinycss2

from pilotage.io.svg.style import declarations, is_named, local_name

MAX_SYMBOLS = 50_000
"""Symbols of all selectors together: some seconds of reading."""


class StyleSheet:
    """The rules of all `<style>` elements of a document; @-rules are left out."""

    def __init__(self, root: Element) -> None:
        """Read all rules; raises ValueError for those that would take minutes."""
        matcher = cssselect2.Matcher()
        texts = ["".join(node.itertext()) for node in root.iter() if is_named(node, "style")]
        try:
            rules = list(read_rules("\n".join(texts)))
        except RecursionError as error:
            raise ValueError("a style sheet is nested too deeply") from error
        for selector, values in rules:
            matcher.add_selector(selector, values)
        elements = cssselect2.ElementWrapper.from_xml_root(root).iter_subtree() if rules else ()
        self._ruled = {element.etree_element: matched(matcher, element) for element in elements}

    def declared(self, element: Element) -> dict[str, str]:
        """Collect what is declared for an element: its attributes, then rules, then its `style`."""
        found = {local_name(name): value.strip() for name, value in element.attrib.items()}
        found.update(self._ruled.get(element, {}))
        found.update(declarations(element.get("style", "")))
        return found


def matched(matcher: cssselect2.Matcher, element: cssselect2.ElementWrapper) -> dict[str, str]:
    """Collect what rules declare for an element; the more specific and then the later ones win."""
    return {
        name: value
        for _, _, pseudo_element, values in matcher.match(element)
        if pseudo_element is None
        for name, value in values.items()
    }


def read_rules(text: str) -> Iterator[tuple[cssselect2.compiler.CompiledSelector, Mapping[str, str]]]:
    """Read the rules of a style sheet, each with one selector; as in browsers, unknown ones void a rule."""
    blocks = tinycss2.parse_stylesheet(text, skip_comments=True, skip_whitespace=True)
    rules = [block for block in blocks if block.type == "qualified-rule"]
    if sum(len(rule.prelude) for rule in rules) > MAX_SYMBOLS:
        raise ValueError(f"selectors of style sheets of more than {MAX_SYMBOLS} symbols")
    for rule in rules:
        with suppress(cssselect2.SelectorError):
            selectors = cssselect2.compile_selector_list(rule.prelude)
            values = declarations(tinycss2.serialize(rule.content))
            yield from ((selector, values) for selector in selectors)
