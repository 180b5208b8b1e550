"""Numbers for texts, so that arrays can hold them."""


class Names:
    """Texts and their numbers, in the order in which they were first seen."""

    def __init__(self) -> None:
        self.texts: list[str] = []
        self.numbers: dict[str, int] = {}

    def number(self, text: str) -> int:
        """The number of `text`; a new one if it was never seen."""
        number = self.numbers.setdefault(text, len(self.texts))
        if number == len(self.texts):
            self.texts.append(text)
        return number

    def text(self, number: int) -> str:
        """The text that has `number`."""
        return self.texts[number]
