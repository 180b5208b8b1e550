"""Check one top-level statement with the declarations of the statements above it."""

from typing import assert_never

from nddl_lang.semantics.classes import check_class
from nddl_lang.semantics.constraining import check_call_constraint, check_expression_constraint
from nddl_lang.semantics.declarations import check_enum, check_globals, check_typedef
from nddl_lang.semantics.methods import check_method
from nddl_lang.semantics.rules import check_rule
from nddl_lang.semantics.scope import BlockKind, Context, Scope
from nddl_lang.semantics.script import check_assignment, check_goal, check_new, check_script_relation
from nddl_lang.syntax.nodes import (
    Allocation,
    Assignment,
    BrokenStatement,
    CallConstraint,
    ClassDecl,
    EnumDecl,
    ExprConstraint,
    GoalStatement,
    Include,
    MethodCall,
    Relation,
    RuleDecl,
    Statement,
    TypedefDecl,
    VariableDecl,
)


def check_statement(context: Context, node: Statement) -> None:
    """Declare what `node` declares, tie its names, and complain about what is wrong with it."""
    match node:
        case RuleDecl():
            check_rule(context, node)
        case ClassDecl():
            check_class(context, node)
        case VariableDecl():
            check_globals(context, node)
        case EnumDecl():
            check_enum(context, node)
        case TypedefDecl():
            check_typedef(context, node)
        case GoalStatement():
            check_goal(context, node)
        case Assignment():
            check_assignment(context, node)
        case CallConstraint():
            check_call_constraint(context, Scope(BlockKind.SCRIPT), node)
        case ExprConstraint():
            check_expression_constraint(context, Scope(BlockKind.SCRIPT), node)
        case Relation():
            check_script_relation(context, node)
        case MethodCall():
            check_method(context, node)
        case Allocation():
            check_new(context, node)
        case Include() | BrokenStatement():
            pass
        case _:
            assert_never(node)
