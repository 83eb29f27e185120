"""The text of a field file, of the values that Python has."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from numbers import Real
from typing import Any


def text_of(u: Sequence[Any], /, **tables: Any) -> str:
    """The text of a field with this displacement; tables of the file are keywords."""
    if isinstance(u, str) or not isinstance(u, Sequence):
        raise TypeError(f"`u`: expected a list with a formula for each component, found {type(u).__name__}")
    field = {"title": "A field from Python", "dimension": len(u), **_table("field", tables.pop("field", {}))}
    material = tables.pop("material", None)
    if isinstance(material, str):
        material = {"model": material}
    first = {"field": field, "parameters": tables.pop("parameters", {}), "let": tables.pop("let", {})}
    rest = {"displacement": {"u": list(u)}, "material": material or {}, **tables}
    written = [_section(name, table) for name, table in {**first, **rest}.items() if table]
    return "\n".join(written)


def _table(name: str, table: Any) -> Mapping[str, Any]:
    if not isinstance(table, Mapping):
        raise TypeError(f"`{name}`: expected a dictionary, found {type(table).__name__}")
    return table


def _section(name: str, table: Any) -> str:
    if isinstance(table, Sequence) and not isinstance(table, str):
        return "\n".join(f"[[{name}]]\n{_lines(name, one)}" for one in table)
    return f"[{name}]\n{_lines(name, table)}"


def _lines(name: str, table: Any) -> str:
    return "".join(f"{_key(key)} = {_value(name, value)}\n" for key, value in _table(name, table).items())


def _key(key: Any) -> str:
    text = str(key)
    return text if text.isascii() and text.replace("_", "a").replace("-", "a").isalnum() else json.dumps(text)


def _value(name: str, value: Any) -> str:
    """A value in TOML: numbers by their digits, formulas as strings."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {_value(name, it)}" for key, it in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(name, it) for it in value) + "]"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(float(value))
    if hasattr(value, "free_symbols"):
        # SymPy.
        return json.dumps(str(value).replace("**", "^"))
    if isinstance(value, Real):
        # A fraction, or a number of NumPy.
        return json.dumps(str(value))
    raise TypeError(f"`{name}`: expected numbers, formulas, lists and dictionaries, found {type(value).__name__}")
