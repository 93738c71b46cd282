"""A scene as path, TOML text or dict, for the native module."""

import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, Optional, Union

from . import _creepage
from ._arguments import path_of
from ._errors import InputError

Scene = Union[str, "os.PathLike[str]", Mapping[str, Any]]


def schema() -> dict[str, Any]:
    """The JSON Schema of a scene: what keys it may have, and what may stand there."""
    return json.loads(_creepage.schema())


class Source(NamedTuple):
    """What the native module takes for a scene: the name that errors give it, its text, and what is set on top."""

    name: str
    text: str
    overrides: list


def source(scene: Scene, overrides: Optional[Mapping[str, Any]] = None) -> Source:
    """The scene's text. A text is a path unless it holds a line break or ``=``, which every scene does."""
    if not isinstance(overrides, (Mapping, type(None))):
        raise InputError(f"found overrides = {overrides!r}; allowed: a dict of keys with values")
    keys = [f"{key}={'' if value is None else _override(value)}" for key, value in (overrides or {}).items()]
    if isinstance(scene, Source):
        return Source(scene.name, scene.text, [*scene.overrides, *keys])
    if isinstance(scene, Mapping):
        return Source("scene", _toml(scene), keys)
    if isinstance(scene, str) and ("\n" in scene or "=" in scene):
        return Source("scene", scene, keys)
    path = path_of("a scene", scene, "a path, a TOML text or a dict")
    try:
        return Source(path, Path(path).read_text(encoding="utf-8-sig"), keys)
    # Of a text that is none, or a path that cannot be one.
    except (OSError, ValueError) as error:
        message = f"{path}: cannot be read as a scene, a path, a TOML text or a dict: {error}"
        raise InputError(message, file=path) from error


def _override(value: Any) -> str:
    return value if isinstance(value, str) else _value(value)


def _toml(scene: Mapping[str, Any]) -> str:
    return "".join(f"{_text(key)} = {_value(value)}\n" for key, value in scene.items() if value is not None)


def _text(text: str) -> str:
    """A text as TOML has it: like JSON, but without its pairs for one character."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _value(value: Any) -> str:
    """A value as TOML on one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_text(k)} = {_value(v)}" for k, v in value.items() if v is not None) + " }"
    if isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray)):
        return "[" + ", ".join(map(_value, value)) + "]"
    if hasattr(value, "tolist"):
        # A number or an array of numpy.
        return _value(value.tolist())
    if isinstance(value, (int, float)):
        return repr(value)
    raise InputError(f"found {value!r} in the scene; allowed: texts, numbers, lists and dicts")
