"""All pages of the codes that the passes give, by code."""

from nddl_lang.semantics.pages_calls import CALL_PAGES
from nddl_lang.semantics.pages_duplicates import DUPLICATE_PAGES
from nddl_lang.semantics.pages_names import NAME_PAGES
from nddl_lang.semantics.pages_script import SCRIPT_PAGES
from nddl_lang.semantics.pages_types import TYPE_PAGES
from nddl_lang.text.page import RulePage

_ALL = (*NAME_PAGES, *DUPLICATE_PAGES, *TYPE_PAGES, *CALL_PAGES, *SCRIPT_PAGES)

PAGES: dict[str, RulePage] = {page.code.id: page for page in sorted(_ALL, key=lambda page: page.code.id)}
