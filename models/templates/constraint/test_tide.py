"""The constraint refuses what is wrong and never loses a time that is right: `python3 test_tide.py`, or pytest."""

from pathlib import Path

from runtime.user.library import load_library
from runtime.user.sound import check_sound

(high_water,) = load_library(Path(__file__).parent, ["tide.py"], ()).constraints


def test_high_water_is_sound() -> None:
    check_sound(high_water, [(140,), (260,), (885,)], wrong=[(139,), (261,), (500,)])


if __name__ == "__main__":
    test_high_water_is_sound()
    print("high_water is sound")
