"""Say about a code what its page in the documentation says: what it means, why, and an example of either kind."""

from dataclasses import dataclass

from nddl_lang.text.diagnostic import Code


@dataclass(frozen=True, slots=True)
class RulePage:
    """The page of one code.

    `what` and `why` are sentences in Markdown. `bad` is a whole text that draws the code (and no other error),
    `good` the same text mended; a dialect other than the default is declared in the first line of the text.
    `language` is what the text is written in: `nddl`, `toml` or `xml`.
    """

    code: Code
    what: str
    why: str
    bad: str
    good: str
    language: str = "nddl"
