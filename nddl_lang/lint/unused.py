"""List the codes about what has no use, and those that only all models together can tell."""

from nddl_lang.lint.codes import (
    FREE_PARAMETER,
    NEVER_FIRES,
    NO_EFFECT,
    NO_FILTER,
    UNREACHABLE,
    UNUSED_FORMAL,
    UNUSED_GLOBAL,
    UNUSED_LABEL,
    UNUSED_LOCAL,
    UNUSED_MEMBER,
    UNUSED_PARAMETER,
    UNUSED_SUPPRESSION,
    UNUSED_TYPE,
    UNUSED_VALUE,
)

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
