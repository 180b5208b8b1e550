"""Compile a model: the checked meaning of its text in, the program that the runtime loads out."""

from compiler import constants
from compiler.body import Body, Frame, Model
from compiler.declarations import all_predicates, class_code, effects_of, firing_rules, predicate_code, rule_code
from compiler.program import PredicateCode, Program, TypeCode
from compiler.script import execute
from nddl_lang.analysis import Analysis
from nddl_lang.syntax.nodes import RuleDecl


def compile_model(analysis: Analysis) -> Program:
    """Lower a model that has no errors."""
    schema = analysis.schema
    model = Model(schema, analysis.tables, callables=analysis.callables)
    script = Body(model, Frame(tokens=0))
    declared: list[int] = []
    for statement in analysis.statements:
        if isinstance(statement, RuleDecl):
            declared.append(len(script.code))
        execute(statement, script)
    classes = tuple(class_code(class_, model) for class_ in schema.classes.values())
    predicates = tuple(_predicates(model))  # before the rules: their guards ask what defines a parameter
    rules = [rule_code(rule, position, model) for rule, position in zip(schema.rules, declared, strict=True)]
    return Program(
        tuple((enum.name, enum.values) for enum in schema.enums.values()),
        classes,
        predicates,
        tuple(rules),
        _globals(model),
        tuple(script.code),
        script.frame.slots,
        script.frame.tokens,
        tuple(model.sampled.values()),
    )


def _predicates(model: Model) -> list[PredicateCode]:
    codes: list[PredicateCode] = []
    for predicate in all_predicates(model.schema):
        rules = firing_rules(predicate, model.schema)
        codes.append(predicate_code(predicate, rules, effects_of(predicate, rules, model), model))
    return codes


def _globals(model: Model) -> tuple[tuple[str, TypeCode], ...]:
    return tuple((variable.name, constants.type_code(variable.type)) for variable in model.globals)
