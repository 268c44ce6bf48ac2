"""Settings of all stages in one nested value, read from TOML; unknown names are rejected."""

import difflib
import inspect
import io
import json
import math
import tokenize
import types
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from enum import Enum
from pathlib import Path
from typing import Any, TypeVar, Union, get_args, get_origin, get_type_hints

from pilotage.errors import SettingsError, shown
from pilotage.io.toml_files import read_toml
from pilotage.localization import LocalizerSettings
from pilotage.navigation import NavigatorSettings
from pilotage.simulation import SimulatorSettings

Kind = TypeVar("Kind")

PLAIN = {float: "a number", int: "a whole number", bool: "true or false", str: "a text"}

LARGEST = 2**53
"""Larger whole numbers are not exact as floating point numbers."""


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of all stages; a file names only those that it changes."""

    localizer: LocalizerSettings = field(default_factory=LocalizerSettings)
    navigator: NavigatorSettings = field(default_factory=NavigatorSettings)
    simulator: SimulatorSettings = field(default_factory=SimulatorSettings)


def read_settings(path: Path | str | None) -> Settings:
    """Read settings from a TOML file; without one they are the defaults.

    Raises FileError if it cannot be read, SettingsError if it holds an unknown name or an invalid value.
    """
    if path is None:
        return Settings()
    tree = read_toml(path, "a settings file")
    try:
        return settings_from(tree)
    except SettingsError as error:
        raise SettingsError(f"{error}: {path}") from error


def settings_text(settings: object, name: str = "") -> str:
    """Write settings as TOML, a table for each stage; settings without a value are left out.

    The unit and the meaning of each setting follow it as a comment.
    """
    values = {one.name: getattr(settings, one.name) for one in fields(settings)}  # type: ignore[arg-type]
    plain = {key: value for key, value in values.items() if value is not None and not is_dataclass(value)}
    meaning = meanings(type(settings))
    lines = [
        f"{key} = {toml_value(value)}" + (f"  # {meaning[key]}" if key in meaning else "")
        for key, value in plain.items()
    ]
    own = "\n".join([f"[{name}]", *lines, ""]) if name and lines else ""
    nested = [
        settings_text(value, f"{name}.{key}".lstrip("."))
        for key, value in values.items()
        if is_dataclass(value)
    ]
    return "\n".join(part for part in (own, *nested) if part)


def meanings(kind: type) -> dict[str, str]:
    """Return what the comments behind the fields of a dataclass say, by field.

    >>> meanings(Settings)
    {}
    """
    names = {one.name for one in fields(kind)}
    found: dict[str, str] = {}
    name = ""
    try:
        source = inspect.cleandoc(inspect.getsource(kind))
    except (OSError, TypeError):  # installed without its source
        return found
    depth = 0
    is_code = False
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        depth += (token.type == tokenize.INDENT) - (token.type == tokenize.DEDENT)
        if token.type == tokenize.NAME and not is_code and depth == 1:
            name = token.string if token.string in names else ""
        if token.type == tokenize.COMMENT and is_code and name:
            found[name] = f"{found.get(name, '')} {without_directives(token.string)}".strip()
        is_code = token.type not in (tokenize.NEWLINE, tokenize.NL, tokenize.INDENT, tokenize.DEDENT) and (
            is_code or token.type != tokenize.COMMENT
        )
    return {key: text for key, text in found.items() if text}


def without_directives(comment: str) -> str:
    """Return the text of a comment, without what it says to tools.

    >>> without_directives("# [m] from wall to wall  # noqa: E501")
    '[m] from wall to wall'
    """
    parts = (part.strip() for part in comment.split("#"))
    return " ".join(part for part in parts if part and not part.startswith(("noqa", "type:", "fmt:")))


def toml_value(value: object) -> str:
    """Write one value."""
    if isinstance(value, Enum):
        return toml_value(value.value)
    if isinstance(value, tuple):
        return f"[{', '.join(map(toml_value, value))}]"
    if isinstance(value, str | bool):
        return json.dumps(value)
    return repr(float(value)) if isinstance(value, float) else repr(value)


def settings_from(tree: Mapping[str, object]) -> Settings:
    """Build settings from nested tables."""
    return build(Settings, tree, "")


def build(kind: type[Kind], tree: Mapping[str, object], name: str) -> Kind:
    """Build one frozen dataclass from a table of this name; fields that are not named keep their defaults."""
    hints = get_type_hints(kind)
    known = [one.name for one in fields(kind)]  # type: ignore[arg-type]
    for key in tree:
        if key not in known:
            raise SettingsError(unknown(key, known, name))
    values = {key: converted(hints[key], value, f"{name}{key}") for key, value in tree.items()}
    try:
        return kind(**values)
    except SettingsError:
        raise
    except (TypeError, ValueError) as error:
        raise SettingsError(f"setting {name.rstrip('.') or 'file'}: {error}") from error


def unknown(key: str, known: list[str], name: str) -> str:
    """Say that a name is unknown, and which one may have been meant."""
    near = difflib.get_close_matches(key, known, n=1, cutoff=0.0)
    hint = f", the nearest known one is {name}{near[0]}" if near else ""
    return f"unknown setting {name}{key}{hint}"


def converted(hint: Any, value: object, name: str) -> object:  # noqa: ANN401  # a type as annotations have it
    """Check a value against an annotation, and convert it."""
    if get_origin(hint) in (Union, types.UnionType):
        return converted(next(kind for kind in get_args(hint) if kind is not types.NoneType), value, name)
    if get_origin(hint) is tuple:
        return converted_list(get_args(hint), value, name)
    if is_dataclass(hint):
        if not isinstance(value, Mapping):
            raise SettingsError(f"setting {name} must be a table, got {shown(value)}")
        return build(hint, value, f"{name}.")  # type: ignore[arg-type]
    if isinstance(hint, type) and issubclass(hint, Enum):
        return chosen(hint, value, name)
    if hint in (int, float) and type(value) is int and abs(value) > LARGEST:
        raise SettingsError(f"setting {name} must be a number of at most 15 digits, got {shown(value)}")
    if hint is float and type(value) is int:
        return float(value)
    if hint not in PLAIN or type(value) is not hint:
        raise SettingsError(f"setting {name} must be {PLAIN.get(hint, hint)}, got {shown(value)}")
    if isinstance(value, float) and not math.isfinite(value):
        raise SettingsError(f"setting {name} must be finite, got {value}")
    return value


def converted_list(kinds: tuple[Any, ...], value: object, name: str) -> tuple[object, ...]:
    """Check an array against `tuple[kind, ...]` or `tuple[first, second]`."""
    if not isinstance(value, list):
        raise SettingsError(f"setting {name} must be an array, got {shown(value)}")
    if len(kinds) == 2 and kinds[1] is Ellipsis:
        kinds = (kinds[0],) * len(value)
    if len(kinds) != len(value):
        raise SettingsError(f"setting {name} must hold {len(kinds)} values, got {len(value)}")
    return tuple(
        converted(kind, one, f"{name}[{k}]") for k, (kind, one) in enumerate(zip(kinds, value, strict=True))
    )


def chosen(hint: type[Enum], value: object, name: str) -> Enum:
    """Find the member of an enumeration by its value."""
    for member in hint:
        if member.value == value:
            return member
    raise SettingsError(
        f"setting {name} must be one of {', '.join(str(m.value) for m in hint)}, got {shown(value)}"
    )
