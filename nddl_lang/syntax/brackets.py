"""Follow the brackets of a text that may be wrong anywhere, as far as it takes to see where a statement ends."""

# How deep brackets may be nested: whoever walks the tree recursively must come back.
DEPTH_LIMIT = 200
STEPS = "state it in several steps, with variables between them"

# After one of these a `{` opens a set of values; after anything else, a block of statements.
_BEFORE_SET = frozenset(("=", "==", "!=", "<", "<=", ">", ">=", "in", ",", "(", "[", "SET", "BASETYPE", "RELATION"))
_OPENERS = {")": "(", "]": "["}


class Brackets:
    """The brackets that are open; `{` counts as a block or as a set by what stands before it."""

    __slots__ = ("in_typedef", "open")

    def __init__(self) -> None:
        self.open: list[str] = []  # "(", "[", "{" for a block, "SET" for a set
        self.in_typedef = False

    def __bool__(self) -> bool:
        return bool(self.open)

    def closes_statement(self, kind: str, previous: str | None) -> bool:
        """Take in one of `( ) [ ] { } ;`; whether a top-level statement may end with it.

        `;` and `}` close whatever parentheses were left open before them: neither can stand inside any.
        """
        stack = self.open
        if kind == "(" or kind == "[":
            stack.append(kind)
            return False
        if kind == "{":
            stack.append("SET" if previous in _BEFORE_SET or self.in_typedef else "{")
            return False
        if kind == ";":
            self.in_typedef = False
            while stack and stack[-1] != "{":
                stack.pop()
            return not stack
        if kind == "}":
            while stack and stack[-1] in "([":
                stack.pop()
            return not stack or (stack.pop() == "{" and not stack)
        if stack and stack[-1] == _OPENERS[kind]:
            stack.pop()
        return False

    @property
    def innermost(self) -> str | None:
        """The bracket that was opened last and is still open."""
        return self.open[-1] if self.open else None

    @property
    def is_too_deep(self) -> bool:
        """Whether more are open than anybody can follow."""
        return len(self.open) > DEPTH_LIMIT
