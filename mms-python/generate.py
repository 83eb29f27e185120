"""Writes files from lists of the compiler and from the types of its documents, or with --check prints the differences.

python/manufactured/documents.py has a class for each document that the library returns, made of docs/documents.schema.json.
python/manufactured/_native.pyi has the signatures of the extension module: the methods for quantities follow from the list
of quantities in it.
"""

import argparse
import difflib
import json
import keyword
import pathlib
import re
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
PACKAGE = HERE / "python" / "manufactured"
SCHEMA = HERE.parent / "docs" / "documents.schema.json"

# The documents that functions of the library return; the others follow.
RETURNED = ["judge", "diagnose", "study"]

HEAD = '"""The documents that the library returns. generate.py wrote this; change the types in mms-documents."""\n'


def class_name(key):
    return "".join(part.capitalize() for part in key.split("-"))


def referred(schema):
    """The keys of the classes that a schema refers to."""
    return re.findall(r'"#/\$defs/([a-z-]+)"', json.dumps(schema))


def annotation(schema):
    """The annotation of a value, without the None that it may be."""
    if "$ref" in schema:
        return class_name(schema["$ref"].rsplit("/", 1)[1])
    if "anyOf" in schema or "oneOf" in schema:
        parts = schema.get("anyOf") or schema["oneOf"]
        return " | ".join(dict.fromkeys(annotation(it) for it in parts))
    kinds = schema.get("type", [])
    kinds = [kinds] if isinstance(kinds, str) else kinds
    simple = {"string": "str", "number": "float", "integer": "int", "boolean": "bool", "null": "None"}
    found = []
    for kind in kinds:
        if kind == "array":
            found.append(f"list[{annotation(schema['items'])}]")
        elif kind == "object" and "additionalProperties" in schema:
            found.append(f"dict[str, {annotation(schema['additionalProperties'])}]")
        elif kind == "object":
            found.append("dict[str, Any]")
        else:
            found.append(simple[kind])
    return " | ".join(found) or "Any"


def sentence(text, indent):
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", " ".join(text.split()))
    lines = textwrap.wrap(text, 108 - len(indent)) or [""]
    return f'\n{indent}'.join([f'{indent}"""{lines[0]}', *lines[1:]]) + '"""\n'


def document(key, schema):
    lines = [f"\n\n@dataclass(frozen=True, kw_only=True)\nclass {class_name(key)}(Document):\n"]
    lines.append(sentence(schema.get("description", f"The part {key} of a document."), "    ") + "\n")
    for name, value in schema.get("properties", {}).items():
        is_needed = name in schema.get("required", [])
        kind = annotation(value)
        if not is_needed and "None" not in kind.split(" | "):
            kind += " | None"
        default = "" if is_needed else " = None"
        name += "_" if keyword.iskeyword(name) else ""
        lines.append(f"    {name}: {kind}{default}\n")
        if "description" in value:
            lines.append(sentence(value["description"], "    "))
    return "".join(lines)


def documents():
    definitions = json.loads(SCHEMA.read_text())["$defs"]
    keys, rest = [], list(RETURNED)
    while rest:
        key = rest.pop(0)
        if key not in keys:
            keys.append(key)
            rest.extend(referred(definitions[key]))
    imports = "\nfrom dataclasses import dataclass\nfrom typing import Any\n\nfrom ._document import Document\n"
    names = ["Any"] if any("Any" in annotation(definitions[key]) for key in keys) else []
    if not names and "Any" not in "".join(document(key, definitions[key]) for key in keys):
        imports = imports.replace("from typing import Any\n", "")
    head = f'{HEAD}\nfrom __future__ import annotations\n{imports}'
    return head + "".join(document(key, definitions[key]) for key in keys)


NATIVE = '''"""The extension module. generate.py wrote this."""

from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any, TypeVar, final, overload

import numpy as np
import numpy.typing as npt

# An array has the precision of X: float32 or float64.
_Real = TypeVar("_Real", np.float32, np.float64)
_Shape = TypeVar("_Shape", bound=tuple[int, ...])
_Of = np.ndarray[_Shape, np.dtype[_Real]]
_Array = npt.NDArray[Any]
_Doubles = npt.NDArray[np.float64]
_Numbers = npt.ArrayLike
_Parameter = float | str | Any

__version__: str

class MmsError(ValueError): ...

class FieldError(MmsError):
    places: list[tuple[str, int, int, str]]

'''

CLASSES = {
    "Field": ("X: _Numbers, t: float | None = None", """\
    def __init__(self, u: Sequence[Any], **tables: Any) -> None: ...
    @property
    def text(self) -> str: ...
    def save(self, path: str | PathLike[str]) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def dimension(self) -> int: ...
    @property
    def parameters(self) -> dict[str, float]: ...
    @property
    def faces(self) -> list[str]: ...
    @property
    def boundary(self) -> dict[str, str]: ...
    @property
    def bounds(self) -> tuple[list[float], list[float]]: ...
    def grid(
        self, cells: str, per_cell: str = "2"
    ) -> tuple[float, npt.NDArray[np.float64], npt.NDArray[np.float64]]: ...
    @property
    def window(self) -> tuple[float, float] | None: ...
    @property
    def quantities(self) -> list[str]: ...
    @property
    def material(self) -> Material: ...
    def at(self, t: float) -> Now: ...
    def points(self, X: _Numbers) -> AtPoints: ...
    def sample(self, count: int) -> npt.NDArray[np.float64]: ...
    def set(self, **parameters: _Parameter) -> Field: ...
    def evaluate(self, quantity: str, X: _Numbers, t: float | None = None, *, face: str | None = None) -> _Array: ...
    def traction(self, face: str, X: _Numbers, t: float | None = None) -> _Array: ...
    def show(self, *quantities: str, format: str = "text") -> str: ...
    def __getattr__(self, name: str) -> Any: ...
"""),
    "Now": ("X: _Numbers", """\
    @property
    def time(self) -> float: ...
    def traction(self, face: str, X: _Numbers) -> _Array: ...
    def evaluate(self, quantity: str, X: _Numbers, *, face: str | None = None) -> _Array: ...
    def __getattr__(self, name: str) -> Any: ...
"""),
    "AtPoints": ("t: float | None = None", """\
    def traction(self, face: str, t: float | None = None) -> _Array: ...
    def evaluate(self, quantity: str, t: float | None = None, *, face: str | None = None) -> _Array: ...
    def __getattr__(self, name: str) -> Any: ...
"""),
}

REST = '''
@final
class Material:
    def P(self, H: _Numbers, X: _Numbers | None = None, t: float | None = None) -> _Array: ...

@final
class Level:
    def __init__(
        self,
        h: float | None = None,
        X: _Numbers | None = None,
        u: _Numbers | None = None,
        *,
        t: float | None = None,
        cells: Sequence[tuple[int | str, Any]] | None = None,
        **quantities: _Numbers,
    ) -> None: ...
    @property
    def h(self) -> float | None: ...
    @property
    def t(self) -> float | None: ...
    @property
    def names(self) -> list[str]: ...

def field(name: str, /, **parameters: _Parameter) -> Field: ...
def load(path: str | PathLike[str], /, **parameters: _Parameter) -> Field: ...
def loads(text: str, material: str | None = None, /, **parameters: _Parameter) -> Field: ...
def gallery() -> list[str]: ...
def judge(
    field: Field,
    results: Sequence[Level | str | PathLike[str]],
    quantities: Sequence[str],
    times: Sequence[float],
    orders: Sequence[tuple[str | None, float]],
    tolerance: float | None,
    start: str | None,
    over: str | None,
    part: bool,
    all_components: bool,
    progress: Callable[[str], object] | None,
) -> dict[str, str | None]: ...
def diagnose(
    field: Field,
    results: Sequence[Level | str | PathLike[str]],
    law: str | None,
    quantities: Sequence[str],
    times: Sequence[float],
    time_steps: Sequence[float],
    orders: Sequence[tuple[str | None, float]],
    without: Sequence[str],
    residual_sign: float,
    nodal: bool,
    progress: Callable[[str], object] | None,
) -> tuple[dict[str, str | None], list[str]]: ...
def study(
    field: Field, options: Sequence[str], progress: Callable[[str], object] | None
) -> dict[str, str | None]: ...
def command(file: str, words: Sequence[str], arguments: Sequence[str]) -> int: ...
'''


def signatures(name, arguments, is_vector):
    """The signatures of a quantity: a vector has the shape of X, and all have its precision; other numbers are doubles."""
    if "X" not in arguments:
        return f"    def {name}(self, {arguments}) -> _Array:\n"
    kind = "_Of[_Shape, _Real]" if is_vector else "npt.NDArray[_Real]"
    first = arguments.replace("_Numbers", kind)
    return (f"    @overload\n    def {name}(self, {first}) -> {kind}: ...\n"
            f"    @overload\n    def {name}(self, {arguments}) -> _Doubles:\n")


def native():
    import manufactured as mf

    text, field = NATIVE, mf.field("travelling_wave_2d")
    for name, (arguments, rest) in CLASSES.items():
        text += f"@final\nclass {name}:\n"
        written = {}
        for attribute, value in vars(getattr(mf, name)).items():
            doc = getattr(value, "__doc__", None) or ""
            if "The unit is" not in doc:
                continue
            # Each quantity under its name, and then its alias.
            if doc in written:
                text += f"    {attribute} = {written[doc]}\n"
                continue
            written[doc] = attribute
            summary, unit = doc.split("The unit is ")
            is_vector = field.evaluate(attribute, [[0.5, 0.5]], 0.0).ndim == 2
            text += signatures(attribute, arguments, is_vector)
            text += sentence(f"{summary}Unit: " + unit.split("\n")[0], "        ")
        text += rest + "\n"
    return text.rstrip("\n") + "\n" + REST


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="change nothing, and exit with 1 if something differs")
    is_check = parser.parse_args().check
    differs = False
    for path, make in [(PACKAGE / "documents.py", documents), (PACKAGE / "_native.pyi", native)]:
        text = make()
        old = path.read_text() if path.exists() else ""
        if old == text:
            continue
        differs = True
        if is_check:
            lines = difflib.unified_diff(old.splitlines(), text.splitlines(), str(path), "generate.py", lineterm="")
            print("\n".join(lines))
        else:
            path.write_text(text)
    sys.exit(is_check and differs)


if __name__ == "__main__":
    main()
