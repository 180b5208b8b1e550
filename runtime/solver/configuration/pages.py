"""The pages of the codes about the configuration of a solver."""

from functools import partial

from nddl_lang.text.page import RulePage
from runtime.solver.configuration.codes import (
    BOTH_LEVELS,
    EMPTY_VALUES,
    FORBIDDEN_DOCTYPE,
    MISPLACED_HANDLER,
    MISSING_ATTRIBUTE,
    NOT_A_NUMBER,
    NOT_READABLE,
    UNKNOWN_ATTRIBUTE,
    UNKNOWN_CHOICE,
    UNKNOWN_ELEMENT,
    UNKNOWN_FILTER,
    UNKNOWN_HANDLER,
    UNKNOWN_MANAGER,
    WRONG_ROOT,
)

_page = partial(RulePage, language="xml")


def _solver(manager: str, inside: str) -> str:
    """A configuration of one manager with an element inside."""
    return f"<Solver>\n  <{manager}>\n    {inside}\n  </{manager}>\n</Solver>\n"


SOLVER_PAGES = (
    _page(
        NOT_READABLE,
        "The configuration cannot be read as XML, or as TOML.",
        "Nothing of it is used.",
        "<Solver>\n",
        "<Solver>\n</Solver>\n",
    ),
    _page(
        WRONG_ROOT,
        "The outermost element of the configuration is not `Solver`.",
        "A file of another kind was named, perhaps.",
        "<Planner>\n</Planner>\n",
        "<Solver>\n</Solver>\n",
    ),
    _page(
        UNKNOWN_MANAGER,
        "There is no flaw manager of that name.",
        "There are `ThreatManager`, `OpenConditionManager` and `UnboundVariableManager`.",
        '<Solver>\n  <FlawManager component="ThreatsManager"/>\n</Solver>\n',
        "<Solver>\n  <ThreatManager/>\n</Solver>\n",
    ),
    _page(
        UNKNOWN_FILTER,
        "There is no filter of that name.",
        "A filter says which flaws are left alone; with a mistyped one the search would mend too much.",
        _solver("UnboundVariableManager", '<FlawFilter component="Singletons"/>'),
        _solver("UnboundVariableManager", '<FlawFilter component="Singleton"/>'),
    ),
    _page(
        UNKNOWN_HANDLER,
        "There is no handler of that name.",
        "A handler says in which order the ways to mend a flaw are tried.",
        _solver("UnboundVariableManager", '<FlawHandler component="Minimum"/>'),
        _solver("UnboundVariableManager", '<FlawHandler component="Min"/>'),
    ),
    _page(
        MISPLACED_HANDLER,
        "The handler is for flaws of another kind than its manager has.",
        "EUROPA leaves it out too, without a word.",
        _solver("ThreatManager", '<FlawHandler component="Min"/>'),
        _solver("UnboundVariableManager", '<FlawHandler component="Min"/>'),
    ),
    _page(
        UNKNOWN_ATTRIBUTE,
        "The element has no such attribute.",
        "What was meant by it has no effect.",
        '<Solver>\n  <UnboundVariableManager defaultPriorty="5"/>\n</Solver>\n',
        '<Solver>\n  <UnboundVariableManager defaultPriority="5"/>\n</Solver>\n',
    ),
    _page(
        UNKNOWN_ELEMENT,
        "No such element, or key, can stand here.",
        "What was meant by it has no effect.",
        _solver("UnboundVariableManager", '<Handler component="Min"/>'),
        _solver("UnboundVariableManager", '<FlawHandler component="Min"/>'),
    ),
    _page(
        UNKNOWN_CHOICE,
        "An attribute has a value that is none of its choices.",
        "The message lists all of them.",
        _solver("ThreatManager", '<FlawHandler component="HSTSThreatDecisionPoint" order="soon"/>'),
        _solver("ThreatManager", '<FlawHandler component="HSTSThreatDecisionPoint" order="early"/>'),
    ),
    _page(
        NOT_A_NUMBER,
        "A priority is not a number, or too large a one.",
        "Flaws of lower numbers are mended first.",
        '<Solver>\n  <UnboundVariableManager defaultPriority="high"/>\n</Solver>\n',
        '<Solver>\n  <UnboundVariableManager defaultPriority="5"/>\n</Solver>\n',
    ),
    _page(
        MISSING_ATTRIBUTE,
        "The element lacks an attribute without which it says nothing.",
        "It cannot be guessed.",
        _solver("UnboundVariableManager", '<FlawHandler component="Min">\n      <Guard name="x"/>\n    </FlawHandler>'),
        _solver(
            "UnboundVariableManager",
            '<FlawHandler component="Min">\n      <Guard name="x" value="3"/>\n    </FlawHandler>',
        ),
    ),
    _page(
        EMPTY_VALUES,
        "An order of values lists none.",
        "Nothing would be left to try.",
        _solver("UnboundVariableManager", '<FlawHandler component="ValEnum"/>'),
        _solver(
            "UnboundVariableManager", '<FlawHandler component="ValEnum">\n      <Value val="1"/>\n    </FlawHandler>'
        ),
    ),
    _page(
        BOTH_LEVELS,
        "Flaws are to be ordered by the lower and by the upper level of a resource at once.",
        "One order excludes the other.",
        '<Solver>\n  <ResourceThreatManager order="lower,upper"/>\n</Solver>\n',
        '<Solver>\n  <ResourceThreatManager order="lower"/>\n</Solver>\n',
    ),
    _page(
        FORBIDDEN_DOCTYPE,
        "The file begins with a document type declaration.",
        "Such declarations can name other files and blow a text up without end; nothing here needs them.",
        '<!DOCTYPE Solver SYSTEM "solver.dtd">\n<Solver>\n</Solver>\n',
        "<Solver>\n</Solver>\n",
    ),
)
