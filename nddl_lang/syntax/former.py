"""Recognise words of earlier dialects of NDDL and say what to write today."""

from nddl_lang.syntax.piece import Piece


def replace_former(piece: Piece) -> None:
    """Report the constructs of earlier dialects in `piece` and leave in its lexemes what can be understood."""
    del piece
