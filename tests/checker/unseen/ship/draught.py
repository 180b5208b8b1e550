"""How deep the ship lies with its cargo."""

from runtime.user.constraint import function


def centimetres(boxes: float) -> int:
    return int(960 + 2.5 * boxes)


CONSTRAINTS = [function("draught_of", "boxes:number", "int", centimetres, "draught in centimetres")]
