"""Types of ROS 2 as DDS needs them, made of the definitions that rosbags knows.

Messages are packed and unpacked by rosbags; DDS carries their bytes. The structure is declared all the same,
so that others can check that it is the same as theirs.
"""

from functools import cache
from typing import Any

from pilotage.io.bags.outgoing import typestore


@cache
def idl_type(name: str) -> type[Any]:
    """Return the type of `package/msg/Name` whose samples are bytes."""
    declared: type[Any] = structure(name)

    class Packed(declared):  # type: ignore[misc]
        """A message, packed."""

        def __init__(self, raw: bytes) -> None:
            self.raw = raw

        def serialize(self, *_args: object, **_options: object) -> bytes:
            """Return the bytes as they are."""
            return self.raw

        @classmethod
        def deserialize(cls, data: bytes, *_args: object, **_options: object) -> "Packed":
            """Keep the bytes as they are."""
            return cls(bytes(data))

    Packed.__idl__ = declared.__idl__
    return Packed


@cache
def structure(name: str) -> type[Any]:
    """Return the type of `package/msg/Name` with its fields, final as rmw implementations have it."""
    from cyclonedds.idl import make_idl_struct
    from cyclonedds.idl.annotations import final

    package, _, kind = name.split("/")
    fields = {each: field_type(definition) for each, definition in typestore().fielddefs[name][1]}
    if not fields:  # IDL knows no empty structures
        fields = {"structure_needs_at_least_one_member": field_type((1, ("uint8", 0)))}
    made: type[Any] = make_idl_struct(f"{kind}_", f"{package}.msg.dds_.{kind}_", fields)
    return final(made)


def field_type(definition: Any) -> Any:  # noqa: ANN401  # of rosbags, for cyclonedds
    """Return the type of a field."""
    import cyclonedds.idl.types as untyped
    from rosbags.interfaces import Nodetype

    types: Any = untyped
    kind, what = definition
    if kind == Nodetype.BASE:
        name = what[0]
        plain = {"string": str, "bool": bool, "byte": types.byte, "char": types.uint8, "octet": types.byte}
        return plain[name] if name in plain else getattr(types, name)
    if kind == Nodetype.NAME:
        return structure(what)
    element, count = what
    if kind == Nodetype.ARRAY:
        return types.array[field_type(element), count]
    return types.sequence[field_type(element)]
