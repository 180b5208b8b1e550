"""All pages of the findings, by code."""

from nddl_lang.lint.pages_names import NAME_PAGES
from nddl_lang.lint.pages_rules import RULE_LINT_PAGES
from nddl_lang.lint.pages_values import VALUE_PAGES
from nddl_lang.text.page import RulePage

_ALL = (*NAME_PAGES, *RULE_LINT_PAGES, *VALUE_PAGES)

PAGES: dict[str, RulePage] = {page.code.id: page for page in sorted(_ALL, key=lambda page: page.code.id)}
