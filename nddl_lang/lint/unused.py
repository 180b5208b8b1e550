"""List the codes about what has no use: editors show such text faded."""

from nddl_lang.lint.declarations import UNUSED_GLOBAL, UNUSED_MEMBER, UNUSED_PARAMETER, UNUSED_TYPE, UNUSED_VALUE
from nddl_lang.lint.local_names import UNUSED_FORMAL, UNUSED_LABEL, UNUSED_LOCAL
from nddl_lang.lint.portability import NO_FILTER
from nddl_lang.lint.structure import NEVER_FIRES
from nddl_lang.lint.suppression import UNUSED_SUPPRESSION

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
