"""A message as JSON in; why the protocol has it refused, and what is answered then, out."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from lsprotocol import types

_INVALID = int(types.ErrorCodes.InvalidRequest)
_NOT_BEGUN = int(types.ErrorCodes.ServerNotInitialized)


@dataclass(frozen=True, slots=True)
class RefusedMessage:
    """Why a message is refused; `number` names the request, None one that cannot be told."""

    number: int | str | None
    code: int
    reason: str
    is_answered: bool = True

    def response(self) -> dict[str, Any]:
        """What is answered; lsprotocol would leave out an id that is null."""
        return {"jsonrpc": "2.0", "id": self.number, "error": {"code": self.code, "message": self.reason}}


def unreadable(reason: str) -> RefusedMessage:
    """The refusal of a body that is not JSON."""
    return RefusedMessage(None, int(types.ErrorCodes.ParseError), reason)


def refusals(message: Any, *, is_begun: bool, is_dismissed: bool) -> Iterator[RefusedMessage]:
    """Why a message is not looked at; several reasons for a batch, which the protocol does not have."""
    if not isinstance(message, list):
        yield from _refusals_of_one(message, is_begun, is_dismissed)
    elif not message:
        yield RefusedMessage(None, _INVALID, "an empty batch")
    else:
        for each in message:
            number = _number(each)
            is_asked = number is not None or not isinstance(each, dict)
            yield RefusedMessage(number, _INVALID, "a batch, which the protocol does not have", is_asked)


def _refusals_of_one(message: Any, is_begun: bool, is_dismissed: bool) -> Iterator[RefusedMessage]:
    number = _number(message)
    if not isinstance(message, dict) or message.get("jsonrpc") != "2.0":
        yield RefusedMessage(number, _INVALID, "a message of JSON-RPC 2.0 is an object with `jsonrpc` 2.0")
    elif "method" not in message:
        if "result" not in message and "error" not in message:
            yield RefusedMessage(number, _INVALID, "a message has a method, a result or an error")
    elif not isinstance(message["method"], str):
        yield RefusedMessage(number, _INVALID, "a method is a string")
    elif "id" in message and number is None:
        yield RefusedMessage(None, _INVALID, "the id of a request is a number or a string")
    elif number is not None and types.METHOD_TO_TYPES.get(message["method"], ("", ""))[1] is None:
        yield RefusedMessage(number, _INVALID, f"`{message['method']}` is a notification, which has no id")
    else:
        yield from _out_of_turn(message["method"], number, is_begun, is_dismissed)


def _out_of_turn(method: str, number: int | str | None, is_begun: bool, is_dismissed: bool) -> Iterator[RefusedMessage]:
    is_asked = number is not None
    if method == types.EXIT and not is_asked:
        return
    if is_dismissed:
        yield RefusedMessage(number, _INVALID, "the session is shut down", is_asked)
    elif not is_begun and method != types.INITIALIZE:
        yield RefusedMessage(number, _NOT_BEGUN, "the session has not begun: `initialize` comes first", is_asked)
    elif is_begun and method == types.INITIALIZE:
        yield RefusedMessage(number, _INVALID, "the session has begun already", is_asked)


def _number(message: Any) -> int | str | None:
    number = message.get("id") if isinstance(message, dict) else None
    return number if isinstance(number, int | str) and not isinstance(number, bool) else None
