"""The code of a choice that keeps a reactor from being compiled."""

from nddl_lang.text.diagnostic import Code, Severity

CHOICE_LEFT = Code("NDDL690", Severity.INFO, "lint", "not determined: {reason}")
