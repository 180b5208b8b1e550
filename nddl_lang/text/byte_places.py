"""Places in a text of bytes of its encoding, as readers of XML tell them: each asked for goes on from the last."""


class BytePlaces:
    """Where bytes of UTF-8 stand in their text; those that are asked for must not go back."""

    def __init__(self, encoded: bytes, first: int = 0, place: int = 0) -> None:
        """The byte `first` stands at `place`."""
        self._encoded = encoded
        self._at, self._place = first, place

    def place(self, byte: int) -> int:
        """The place of a byte; of an earlier one than asked before, the place of that."""
        if byte > self._at:
            self._place += len(self._encoded[self._at : byte].decode("utf-8", "replace"))
            self._at = byte
        return self._place
