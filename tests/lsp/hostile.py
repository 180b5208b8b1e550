"""Messages as no editor should send them: seeds in; bytes on the wire and what must come back out.

Parameters are made from the types of the protocol, of every method, and then spoilt in some places.
"""

import json
import random
import types as python_types
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any, Union, get_args, get_origin, get_type_hints

import attrs
from lsprotocol import types

URI = "untitled:a"
MODEL = """\
enum Mode { Slow, Fast }
class Gps extends Timeline { predicate Idle { } predicate Busy { int load; Mode mode; } }
Gps gps = new Gps();
int LIMIT = 5;
Gps::Busy {
  load <= LIMIT;
  if (mode == Fast) { met_by(Idle before_it); before_it.duration >= 2; }
}
goal(gps.Busy one);
"""
URIS = [
    *(URI, URI, URI, "untitled:b", "", "x", "file:///\0", "file:///%00", "file:///%ff", "file://host/share/a.nddl"),
    *("http://example.org/a.nddl", "file:///dev/zero", "file:///proc/self/mem", "file:///", "untitled:mission.toml"),
    *("file:///nowhere/a.nddl", "file:///nowhere/mission.toml", "file:///nowhere/nddlc.toml", "file:" + "a" * 5000),
    *("file:///nowhere/../../a.nddl", "git:/a.nddl?{}", "FILE:///a.nddl", "file:a.nddl", "\ud800", "untitled:\n"),
]
TEXTS = [
    *(
        "",
        "a",
        "LIMIT",
        "class",
        "é",
        "\ud800",
        "\0",
        "int x;\r\rint y;",
        "{" * 3000,
        "(" * 3000,
        '"',
        "/*",
        "#include",
    ),
    *('#include "/dev/zero"\n', '#include "a"\n' * 300, "a." * 2000, "int a;\n" * 500, "x" * 20_000, "goal(gps.Busy);"),
]
VALUES: list[Any] = [
    *(None, True, False, 0, -1, 2**31, 2**63, 2**64, -(2**40), 1.5, float("nan"), float("inf"), 1e308),
    *("", "x", URI, "file:///\0", "\ud800", [], {}, [[]], [None], {"uri": URI}, {"": None}, {"jsonrpc": "2.0"}),
    *({"jsonrpc": "2.0", "id": 3, "method": "exit"}, ["a"] * 100, {"a": {"a": {"a": {"a": []}}}}),
]
NUMBERS = [*range(12), 0, 80, 5000, 2**31 - 1, 2**31, 2**40, -1, -(2**40)]
UNKNOWN = ["", "nonsense", "textDocument/", "$/nonsense", "hover", "textDocument/hover ", "__class__", "é", "x" * 3000]
OWN = ["nddl/viewPlan", "nddl/viewNetwork", "nddl/viewConflict"]
ENDINGS = {"shutdown", "exit"}  # they belong to sessions of their own
METHODS = sorted({*types.METHOD_TO_TYPES, *OWN} - ENDINGS)
COMMANDS = ["nddl.check", "nddl.explain", "nddl.certify", "nddl.nonsense", "", "__init__"]


@dataclass(frozen=True, slots=True)
class Hostile:
    """What is sent, the requests in it that must be answered, and whether it may take the next message with it."""

    content: bytes
    asked: tuple[int | str, ...]
    kind: str
    is_torn: bool = False


def framed(body: bytes) -> bytes:
    """A body with its header."""
    return b"Content-Length: %d\r\n\r\n%b" % (len(body), body)


def written(value: Any) -> bytes:
    """A value as JSON, with NaN and lone surrogates if it has them."""
    return json.dumps(value).encode()


def message(chance: random.Random, number: int) -> Hostile:
    """One of any kind; `number` is free to name a request."""
    dice = chance.random()
    for share, kind in _KINDS:
        if dice < share:
            return kind(chance, number)
        dice -= share
    return _of_method(chance, number)


def _parameters(chance: random.Random, method: str) -> Any:
    spoilt = chance.choice((0, 0.02, 0.2))
    if method in OWN:
        return _made(chance, types.ExecuteCommandParams | types.HoverParams | dict, "", 0, spoilt)
    wanted = types.METHOD_TO_TYPES[method][2]
    return _made(chance, wanted, "", 0, spoilt) if wanted is not None else chance.choice(VALUES)


def _made(chance: random.Random, wanted: Any, name: str, depth: int, spoilt: float) -> Any:
    """A value of a type of the protocol; here and there of another one."""
    if chance.random() < spoilt or depth > 7:
        return chance.choice(VALUES)
    origin, arguments = get_origin(wanted), get_args(wanted)
    if origin in (Union, python_types.UnionType):
        return _made(chance, chance.choice(arguments), name, depth, spoilt)
    if isinstance(wanted, type) and attrs.has(wanted):
        hints = get_type_hints(wanted)
        return {
            _camel(field.name): _made(chance, hints[field.name], field.name, depth + 1, spoilt)
            for field in attrs.fields(wanted)
            if chance.random() > (0.02 if field.default is attrs.NOTHING else 0.6)
        }
    if isinstance(wanted, type) and issubclass(wanted, Enum):
        return chance.choice(list(wanted)).value
    if isinstance(origin, type) and issubclass(origin, tuple):
        return [_made(chance, each, name, depth + 1, spoilt) for each in arguments if each is not ...]
    if isinstance(origin, type) and issubclass(origin, Sequence):
        return [_made(chance, arguments[0], name, depth + 1, spoilt) for _ in range(chance.randrange(3))]
    if wanted is str:
        return _text(chance, name)
    if wanted is int:
        return chance.choice(NUMBERS)
    return None if wanted is type(None) else chance.choice(VALUES)


def _camel(name: str) -> str:
    head, *rest = name.rstrip("_").split("_")
    return head + "".join(each.capitalize() for each in rest)


def _text(chance: random.Random, name: str) -> str:
    if "uri" in name:
        return chance.choice(URIS)
    return chance.choice(COMMANDS) if name == "command" else chance.choice(TEXTS)


def _of_method(chance: random.Random, number: int) -> Hostile:
    method = chance.choice(METHODS)
    whole = {"jsonrpc": "2.0", "method": method, "params": _parameters(chance, method)}
    is_request = method in OWN or types.METHOD_TO_TYPES[method][1] is not None
    if is_request == (chance.random() < 0.97):
        return Hostile(framed(written({**whole, "id": number})), (number,), method)
    return Hostile(framed(written(whole)), (), method)


def _unknown(chance: random.Random, number: int) -> Hostile:
    whole = {"jsonrpc": "2.0", "method": chance.choice(UNKNOWN), "params": chance.choice(VALUES)}
    if chance.random() < 0.2:
        return Hostile(framed(written(whole)), (), "unknown notification")
    return Hostile(framed(written({**whole, "id": number})), (number,), "unknown request")


def _of_wrong_shape(chance: random.Random, number: int) -> Hostile:
    whole: dict[str, Any] = {"jsonrpc": "2.0", "id": number, "method": "textDocument/hover", "params": {}}
    spoilt = chance.choice(["jsonrpc", "method", "params"])
    if chance.random() < 0.4:
        del whole[spoilt]
    else:
        whole[spoilt] = chance.choice(VALUES)
    # Without a method it may be an answer to what the server never asked.
    return Hostile(framed(written(whole)), (number,) if "method" in whole else (), f"wrong {spoilt}")


def _of_odd_id(chance: random.Random, number: int) -> Hostile:
    names = [2**53 + number, 10**400 + number, -number, f"é{number}", f"\0{number}", "9" * 3000 + str(number)]
    name: Any = chance.choice([*names, None, True, 1.5, [], {}, {"a": number}])
    params = _parameters(chance, "textDocument/hover")
    whole = {"jsonrpc": "2.0", "id": name, "method": "textDocument/hover", "params": params}
    return Hostile(framed(written(whole)), (name,) if name in names else (), "odd id")


def _taken_back(chance: random.Random, number: int) -> Hostile:
    name: Any = chance.choice([number, number - 1, 2**70, "x", None, [], {}, 1.5, True])
    params = chance.choice([{"id": name}, {}, None, [name]])
    return Hostile(framed(written({"jsonrpc": "2.0", "method": "$/cancelRequest", "params": params})), (), "cancel")


def _answer(chance: random.Random, number: int) -> Hostile:
    end: dict[str, Any] = chance.choice([{"result": chance.choice(VALUES)}, {"error": chance.choice(VALUES)}, {}])
    name: Any = chance.choice([number, "x", None, [], {}])
    return Hostile(framed(written({"jsonrpc": "2.0", "id": name, **end})), (), "answer to nothing")


def _batch(chance: random.Random, number: int) -> Hostile:
    parts = [_of_method(chance, number * 10 + digit) for digit in range(chance.randrange(3))]
    bodies = [json.loads(part.content.partition(b"\r\n\r\n")[2]) for part in parts]
    return Hostile(framed(written(chance.choice([bodies, [bodies], [1, *bodies]]))), (), "batch")


def _no_message(chance: random.Random, number: int) -> Hostile:
    bodies = [
        *(b"", b" ", b"{", b"}", b"nul", b"null", b"1", b'"x"', b"[]", b"{}", b"[[]]", b"NaN", b"\0", b"{'a': 1}"),
        *(
            b"\xff\xfe",
            b"\xef\xbb\xbf{}",
            '{"jsonrpc": "2.0"}'.encode("utf-16"),
            b'{"\xff": 1}',
            b'{"jsonrpc": "\xc3("}',
        ),
        *(b"[" * 100_000, b'{"a":' * 20_000, b"9" * 6000, b'{"jsonrpc":"2.0","id":%b}' % (b"9" * 6000), b"a" * 100_000),
        written(chance.choice(VALUES)),
        written(number),
    ]
    return Hostile(framed(chance.choice(bodies)), (), "no message")


def _spoilt(chance: random.Random, number: int) -> Hostile:
    whole = bytearray(_of_method(chance, number).content.partition(b"\r\n\r\n")[2])
    for _ in range(chance.randrange(1, 4)):
        at = chance.randrange(len(whole))
        whole[at : at + chance.choice((0, 1, 1, 9))] = chance.choice([b"", b"\0", b"\xff", b"}", b'"', b"[", b"\xc3"])
    return Hostile(framed(bytes(whole)), (), "spoilt bytes")


def _of_odd_header(chance: random.Random, number: int) -> Hostile:
    body = written({"jsonrpc": "2.0", "id": number, "method": "textDocument/hover", "params": {}})
    heads = [
        *(b"content-length: %d\r\n\r\n", b"CONTENT-LENGTH:%d\r\n\r\n", b"Content-Length:   %d  \r\n\r\n"),
        b"Content-Type: application/vscode-jsonrpc; charset=utf-8\r\nContent-Length: %d\r\n\r\n",
        *(b"Content-Length: %d\n\n", b"X: y\r\nContent-Length: %d\r\nContent-Type: \xff\r\n\r\n"),
        *(
            b"\r\n\r\nContent-Length: %d\r\n\r\n",
            b"nonsense\r\n\r\nContent-Length: -4\r\n\r\nContent-Length: %d\r\n\r\n",
        ),
    ]
    return Hostile(chance.choice(heads) % len(body) + body, (number,), "odd header")


def _torn(chance: random.Random, number: int) -> Hostile:
    body = written({"jsonrpc": "2.0", "id": number, "method": "textDocument/hover", "params": {}})
    heads = [
        b"Content-Length: %d\r\n\r\n" % (len(body) + chance.choice([-40, -3, -1, 1, 5, 300])),
        *(b"Content-Length: 99999999999\r\n\r\n", b"Content-Length: %b\r\n\r\n" % (b"9" * 300), b"\xff" * 20_000, b""),
        *(b"Content-Length: \r\n\r\n", b"Content-Length: 4 4\r\n\r\n", b"Content-Length\r\n\r\n", b"\r\n" * 9000),
    ]
    return Hostile(chance.choice(heads) + body, (), "torn", is_torn=True)


_KINDS = [
    (0.04, _unknown),
    (0.03, _of_wrong_shape),
    (0.03, _of_odd_id),
    (0.02, _taken_back),
    (0.02, _answer),
    (0.03, _batch),
    (0.04, _no_message),
    (0.05, _spoilt),
    (0.03, _of_odd_header),
    (0.02, _torn),
]
