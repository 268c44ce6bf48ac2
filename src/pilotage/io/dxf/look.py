"""How an entity of a DXF file looks: its own word, or that of its layer or of the block that holds it."""

from dataclasses import dataclass

from ezdxf import colors
from ezdxf.document import Drawing
from ezdxf.entities import DXFGraphic, Layer, Linetype

from pilotage.interpretation.sheet import BLACK, Color, Pen

BY_BLOCK, BY_LAYER = 0, 256
"""Color indices that refer to the block insertion and to the layer."""

PAPER = 7
"""The color index that is white on a black screen and black on white paper."""

BLANK = 0.95
"""A line whose red, green and blue are above this is white, and is made for a black screen."""

DEFAULT_WEIGHT = 25
"""A line of this weight [0.01 mm] or less is a hairline: it is what lines have that nobody thought of."""


@dataclass(frozen=True, slots=True)
class Look:
    """What a block insertion hands on to entities that are drawn "by block"."""

    layer: str
    color: Color = BLACK
    dashed: bool = False
    weight: int = DEFAULT_WEIGHT  # [0.01 mm on paper]

    def pen(self, width: float) -> Pen:
        """Return a pen of this look, `width` wide [drawing units]."""
        return Pen(BLACK if min(self.color) > BLANK else self.color, width, self.dashed)


@dataclass(frozen=True, slots=True)
class Looks:
    """The layers and line types of a file."""

    layers: dict[str, Layer]
    dashed_linetypes: frozenset[str]

    @classmethod
    def of(cls, document: Drawing) -> "Looks":
        """Collect layers and line types of a document."""
        layers = {layer.dxf.name.lower(): layer for layer in document.layers}
        dashed = {line.dxf.name.lower() for line in document.linetypes if has_gaps(line)}
        return cls(layers, frozenset(dashed))

    def hidden(self, layer: str) -> bool:
        """Tell whether a layer is off or frozen."""
        found = self.layers.get(layer.lower())
        return found is not None and (found.is_off() or found.is_frozen())

    def frozen(self, layer: str) -> bool:
        """Tell whether a layer is frozen: insertions on it are not shown, whatever they hold."""
        found = self.layers.get(layer.lower())
        return found is not None and found.is_frozen()

    def look(self, entity: DXFGraphic, block: Look | None) -> Look:
        """Resolve the look of an entity in a block insertion, if it is in one."""
        named = str(entity.dxf.get("layer", "0"))
        layer = block.layer if block is not None and named == "0" else named
        return Look(
            layer,
            self._color(entity, layer, block),
            self._dashed(entity, layer, block),
            self._weight(entity, layer, block),
        )

    def _color(self, entity: DXFGraphic, layer: str, block: Look | None) -> Color:
        rgb = entity.rgb
        if rgb is not None:
            return from_rgb(rgb)
        index = int(entity.dxf.get("color", BY_LAYER))
        if index == BY_BLOCK:
            return block.color if block is not None else BLACK
        if index == BY_LAYER:
            found = self.layers.get(layer.lower())
            if found is None:
                return BLACK
            if found.rgb is not None:
                return from_rgb(found.rgb)
            index = abs(int(found.dxf.get("color", PAPER)))
        return BLACK if index in (BY_BLOCK, BY_LAYER, PAPER) else from_rgb(colors.aci2rgb(index))

    def _dashed(self, entity: DXFGraphic, layer: str, block: Look | None) -> bool:
        name = str(entity.dxf.get("linetype", "BYLAYER")).lower()
        if name == "byblock":
            return block is not None and block.dashed
        if name == "bylayer":
            found = self.layers.get(layer.lower())
            name = str(found.dxf.get("linetype", "")).lower() if found is not None else ""
        return name in self.dashed_linetypes

    def _weight(self, entity: DXFGraphic, layer: str, block: Look | None) -> int:
        weight = int(entity.dxf.get("lineweight", -1))
        if weight == -2:
            return block.weight if block is not None else DEFAULT_WEIGHT
        if weight == -1:
            found = self.layers.get(layer.lower())
            weight = int(found.dxf.get("lineweight", -3)) if found is not None else -3
        return weight if weight >= 0 else DEFAULT_WEIGHT


def from_rgb(rgb: tuple[int, int, int]) -> Color:
    """Return a color from bytes."""
    red, green, blue = rgb
    return red / 255.0, green / 255.0, blue / 255.0


def has_gaps(linetype: Linetype) -> bool:
    """Tell whether a line type has dashes or dots: elements of group code 49."""
    return any(tag.code == 49 for tag in linetype.pattern_tags.tags)
