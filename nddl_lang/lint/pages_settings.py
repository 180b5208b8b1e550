"""The pages of the codes about the settings of a project."""

from nddl_lang.lint.codes import NOT_TOML, NOT_TRUSTED, UNKNOWN_KEY, UNREAD_MODULE, UNUSABLE_MODULE, WRONG_VALUE
from nddl_lang.text.page import RulePage

SETTINGS_PAGES = (
    RulePage(
        NOT_TOML,
        "`nddlc.toml`, or `pyproject.toml`, cannot be read as TOML.",
        "Settings that are understood in part only would silence what should be heard; so nothing is done at all.",
        "select = [NDDL5]\n",
        'select = ["NDDL5"]\n',
        "toml",
    ),
    RulePage(
        UNKNOWN_KEY,
        "The configuration has a key that means nothing; the keys are `select`, `ignore`, `include`, `dialect`, "
        "`fail-on`, `max-lexemes`, `constraints` and `severity`.",
        "A mistyped key would otherwise change nothing, and nobody would notice.",
        'selct = ["NDDL5"]\n',
        'select = ["NDDL5"]\n',
        "toml",
    ),
    RulePage(
        WRONG_VALUE,
        "A setting has a value of another kind, or one that is not among its choices.",
        "The message says what the setting can be; `docs/lint.md` lists all of them.",
        "[severity]\nNDDL501 = 3\n",
        '[severity]\nNDDL501 = "error"\n',
        "toml",
    ),
)
TRUST_PAGES = (
    RulePage(
        UNREAD_MODULE,
        "A Python module with constraints computes what it offers, so its text does not tell the names and signatures.",
        "`nddlc lint` and the editor run no Python of a project (`docs/security.md`). They read classes, calls of "
        "`function` and plain values; what is computed stays unknown, and unknown names are then not complained about. "
        "`nddlc lint --trust` runs the module.",
        "CONSTRAINTS = [make(name) for name in NAMES]\n",
        "CONSTRAINTS = [Near(), Far()]\n",
        "python",
    ),
    RulePage(
        UNUSABLE_MODULE,
        "A Python module with constraints raises an exception, does not come back, or ends the process when it is run.",
        "An editor that trusts the workspace shows this where the configuration names the module; on the command line "
        "it is a message, and the command ends with 2. What can be read from the module's text counts meanwhile. A "
        "module is tried by a process of its own first, so whatever it does, the editor's server goes on.",
        "DEPTHS = sum(range(10**12))\n",
        "DEPTHS = 10**12 * (10**12 - 1) // 2\n",
        "python",
    ),
    RulePage(
        NOT_TRUSTED,
        "A configuration asks for Python that does not belong to the project that was named on the command line.",
        "A file that somebody put there must not be run because a model beside it is planned. `docs/security.md` has "
        "the rule; `--trust` runs it all the same.",
        '[constraints]\nmodules = ["../shared/chart.py"]\n',
        '[constraints]\nmodules = ["chart.py"]\n',
        "toml",
    ),
)
