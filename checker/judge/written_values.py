"""Values in a document, read by the type that the model declares; a value of another type is a mistake."""

import json
from collections.abc import Mapping
from math import inf, isfinite
from typing import Any

from compiler.program import Program, TypeCode
from nddl_lang.text.nearest import nearest
from runtime.executive.record import ObjectRecord, OpenValues, Value, ValueRange

_Scalar = float | int | bool | str
TICK = TypeCode("int", "int", None)
_LONGEST_LIST = 14
_NAMES = {"int": "a whole number", "float": "a number", "bool": "true or false", "string": "a text"}


class DocumentError(ValueError):
    """A document that is not of the form that docs/validate.md describes, and what would be."""

    def __init__(self, message: str, advice: str | None = None) -> None:
        super().__init__(message)
        self.advice = advice


def unknown(what: str, name: str, known: Mapping[str, Any] | tuple[str, ...] | list[str]) -> DocumentError:
    """The complaint about a name that nothing has, with the one that may be meant."""
    meant = nearest(name, known)
    if meant is not None:
        return DocumentError(what, f"did you mean `{meant}`?")
    if not known or len(known) > _LONGEST_LIST:
        return DocumentError(what)
    return DocumentError(what, f"known: {', '.join(known)}")


class TypedValues:
    """Reads values of a model's types."""

    def __init__(self, program: Program, objects: tuple[ObjectRecord, ...]) -> None:
        self.enums = dict(program.enums)
        self.objects = {each.name: each.class_name for each in objects}
        self.bases = {each.name: each.base for each in program.classes}

    def read(self, data: Any, type_: TypeCode, where: str) -> Value:
        """A value: itself, `{"between": [lower, upper]}` (null: no bound) or `{"one_of": [...]}`."""
        match data:
            case {"between": [lower, upper], **rest} if not rest:
                return self._range(lower, upper, where)
            case {"one_of": [_, *_] as values, **rest} if not rest:
                return OpenValues(tuple([self._scalar(each, type_, where) for each in values]))
            case {"between": _} | {"one_of": _}:
                advice = '`{"between": [lower, upper]}` has two numbers or null, `{"one_of": [...]}` at least one value'
                raise DocumentError(f"{where}: {json.dumps(data)} is no range", advice)
            case _:
                return self._scalar(data, type_, where)

    def _range(self, lower: Any, upper: Any, where: str) -> Value:
        for each in (lower, upper):
            if each is not None and not _is_number(each):
                raise DocumentError(f"{where}: {json.dumps(each)} is no bound", "a bound is a number, or null for none")
        if lower is not None and upper is not None and lower > upper:
            raise DocumentError(f"{where}: nothing lies between {lower} and {upper}", "the lower bound comes first")
        return ValueRange(-inf if lower is None else lower, inf if upper is None else upper)

    def _scalar(self, data: Any, type_: TypeCode, where: str) -> _Scalar:
        match type_.kind:
            case "float" if _is_number(data) or data in ("inf", "-inf"):
                return float(data)
            case "int" if _is_number(data) and data == int(data):
                return int(data)
            case "bool" if isinstance(data, bool):
                return data
            case "bool" if data in (0, 1) and _is_number(data):
                return bool(data)
            case "string" if isinstance(data, str):
                return data
            case "int" | "float" | "bool" | "string":
                wanted = _NAMES[type_.kind]
                raise DocumentError(
                    f"{where}: {json.dumps(data)} is not {wanted}", f"the model declares `{type_.kind}`"
                )
            case "object":
                return self._object(data, type_.type_name, where)
            case "enum" if type_.type_name in self.enums:
                values = self.enums[type_.type_name]
                if data in values:
                    return str(data)
                raise unknown(f"{where}: {json.dumps(data)} is no value of `{type_.type_name}`", str(data), values)
            case _ if isinstance(data, (bool, int, float, str)):
                return data
            case _:
                raise DocumentError(f"{where}: {json.dumps(data)} is no value")

    def _object(self, data: Any, class_name: str, where: str) -> str:
        names = [name for name, own in self.objects.items() if self._is_kind_of(own, class_name)]
        if data in names:
            return str(data)
        if isinstance(data, str) and data in self.objects:
            what = f"{where}: `{data}` is of the class `{self.objects[data]}`, not `{class_name}`"
            raise DocumentError(what, f"known: {', '.join(names[:_LONGEST_LIST])}" if names else None)
        raise unknown(f"{where}: the model has no object {json.dumps(data)}", str(data), names)

    def _is_kind_of(self, class_name: str, other: str) -> bool:
        found: str | None = class_name
        while found is not None and found != other:
            found = self.bases.get(found)
        return found is not None or other not in self.bases


def _is_number(data: Any) -> bool:
    return isinstance(data, (int, float)) and not isinstance(data, bool) and isfinite(data)
