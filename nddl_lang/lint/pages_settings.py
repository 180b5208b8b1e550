"""The pages of the codes about the settings of a project."""

from nddl_lang.lint.codes import NOT_TOML, UNKNOWN_KEY, WRONG_VALUE
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
        "`fail-on`, `constraints` and `severity`.",
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
