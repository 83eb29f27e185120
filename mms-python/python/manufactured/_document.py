"""Documents as typed objects."""

from __future__ import annotations

import copy
import keyword
import types
import typing
from dataclasses import dataclass, fields
from typing import Any, TypeVar

D = TypeVar("D", bound="Document")


_HINTS: dict[type[Any], dict[str, Any]] = {}


def _hints(kind: type[Any]) -> dict[str, Any]:
    """The types of a document's keys, which are evaluated once."""
    if kind not in _HINTS:
        _HINTS[kind] = typing.get_type_hints(kind)
    return _HINTS[kind]


def _made(hint: Any, value: Any) -> Any:
    """A value of a document as its type has it."""
    if value is None:
        return None
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin in (typing.Union, types.UnionType):
        return _made(next(it for it in arguments if it is not type(None)), value)
    if origin is list:
        return [_made(arguments[0], it) for it in value]
    if origin is dict:
        return {key: _made(arguments[1], it) for key, it in value.items()}
    if isinstance(hint, type) and issubclass(hint, Document):
        return hint.from_dict(value)
    return value


@dataclass(frozen=True, kw_only=True)
class Document:
    """A document, or a part of one, with a type for each key."""

    @classmethod
    def from_dict(cls: type[D], document: dict[str, Any]) -> D:
        """The document of what JSON has. A key that this version does not know is kept for `to_dict`."""
        hints = _hints(cls)
        values: dict[str, Any] = {}
        for field in fields(cls):
            name = field.name.removesuffix("_")
            key = name if keyword.iskeyword(name) else field.name
            if key in document:
                values[field.name] = _made(hints[field.name], document[key])
        made = cls(**values)
        object.__setattr__(made, "_document", document)
        return made

    def to_dict(self) -> dict[str, Any]:
        """The document that the command prints with --json."""
        document: dict[str, Any] = self.__dict__["_document"]
        return copy.deepcopy(document)
