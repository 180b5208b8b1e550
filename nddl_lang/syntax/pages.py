"""All pages of the codes about syntax and includes, by code."""

from nddl_lang.syntax.pages_dialects import DIALECT_PAGES
from nddl_lang.syntax.pages_lexemes import LEXEME_PAGES
from nddl_lang.syntax.pages_statements import STATEMENT_PAGES
from nddl_lang.text.page import RulePage

_ALL = (*LEXEME_PAGES, *STATEMENT_PAGES, *DIALECT_PAGES)

PAGES: dict[str, RulePage] = {page.code.id: page for page in sorted(_ALL, key=lambda page: page.code.id)}
