"""List the codes about what has no use, and those that only all models together can tell."""

from nddl_lang.lint.declarations import (
    FREE_PARAMETER,
    UNUSED_GLOBAL,
    UNUSED_MEMBER,
    UNUSED_PARAMETER,
    UNUSED_TYPE,
    UNUSED_VALUE,
)
from nddl_lang.lint.local_names import UNUSED_FORMAL, UNUSED_LABEL, UNUSED_LOCAL
from nddl_lang.lint.portability import NO_FILTER
from nddl_lang.lint.structure import NEVER_FIRES, NO_EFFECT, UNREACHABLE
from nddl_lang.lint.suppression import UNUSED_SUPPRESSION

# Editors show such text faded.
UNUSED = (
    UNUSED_LOCAL,
    UNUSED_LABEL,
    UNUSED_FORMAL,
    UNUSED_GLOBAL,
    UNUSED_MEMBER,
    UNUSED_VALUE,
    UNUSED_TYPE,
    UNUSED_PARAMETER,
    NO_FILTER,
    NEVER_FIRES,
    UNUSED_SUPPRESSION,
)

# Of a file that several models include, these hold if they hold in each of them.
OF_ALL_MODELS = frozenset(
    (
        UNUSED_GLOBAL,
        UNUSED_MEMBER,
        UNUSED_VALUE,
        UNUSED_TYPE,
        UNUSED_PARAMETER,
        FREE_PARAMETER,
        UNREACHABLE,
        NEVER_FIRES,
        NO_EFFECT,
        UNUSED_SUPPRESSION,
    )
)
