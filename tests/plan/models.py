"""Load a model given as text, for tests."""

from typing import Any

from compiler.lower import compile_model
from nddl_lang.analysis import analyse_text
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.text.diagnostic import Diagnostic, Severity
from runtime.plan.database import Environment, PlanDatabase
from runtime.plan.readout.readout import read

TIMELINES = """
class T extends Timeline { predicate p { int x; } predicate q { int x; } predicate r { } }
"""
OBJECTS = """
T t = new T();
T u = new T();
close();
"""


def prepared(text: str, environment: Environment | None = None) -> PlanDatabase:
    """A database whose script has not run yet; statements that cannot be carried out pass."""
    analysis = analyse_text("model.nddl", text, Dialect.NDDLC)
    errors = [each for each in analysis.diagnostics if each.severity is Severity.ERROR]
    assert all(each.code.kind in ("state", "domain") for each in errors), [each.message for each in errors]
    return PlanDatabase(compile_model(analysis), environment)


def loaded(text: str, environment: Environment | None = None) -> PlanDatabase:
    """A database whose script has run to its end."""
    database = prepared(text, environment)
    assert database.run_script() is None
    return database


def stopped(text: str) -> Diagnostic:
    """What stopped the script."""
    fault = prepared(text).run_script()
    assert fault is not None
    return fault


def token(database: PlanDatabase, name: str) -> int:
    """A token by the name that the script gave it."""
    return next(t for t, label in database.script.labels.items() if label == name)


def domains(database: PlanDatabase) -> dict[str, str]:
    """All domains as texts."""
    found: dict[str, str] = read(database)["domains"]
    return found


def tokens(database: PlanDatabase) -> dict[str, dict[str, Any]]:
    """All tokens by name."""
    return {each["id"]: each for each in read(database)["tokens"]}
