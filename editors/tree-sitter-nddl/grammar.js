/**
 * NDDL for tree-sitter: both dialects at once, and what is being typed.
 *
 * It follows nddl_lang/syntax/grammar.lark. `tree-sitter generate --abi 14` makes src/ anew; tests/editors holds it to
 * the parser of nddlc on every model of the repository.
 */

const RELATIONS = [
  'any', 'before', 'after', 'meets', 'met_by', 'starts', 'ends', 'equals', 'equal', 'contains', 'contained_by',
  'parallels', 'paralleled_by', 'starts_before', 'starts_after', 'starts_before_end', 'starts_during', 'ends_before',
  'ends_after', 'ends_after_start', 'ends_during', 'contains_start', 'contains_end',
];

const OR = 1, AND = 2, COMPARISON = 3, SUM = 4, PRODUCT = 5, UNARY = 6;

const listed = (rule) => seq(rule, repeat(seq(',', rule)));

module.exports = grammar({
  name: 'nddl',

  extras: ($) => [/[\s\uFEFF]/, $.comment],

  word: ($) => $.identifier,

  supertypes: ($) => [$.statement, $.expression],

  rules: {
    model: ($) => repeat($.statement),

    statement: ($) =>
      choice(
        ';',
        $.block,
        $.include,
        $.typedef,
        $.enum,
        $.variables,
        $.assignment,
        $.constraint,
        $.close_all,
        $.class,
        $.predicate,
        $.constructor,
        $.super_call,
        $.rule,
        $.if,
        $.foreach,
        $.goal,
        $.relation,
      ),

    block: ($) => seq('{', repeat($.statement), '}'),

    include: ($) => seq('#include', field('file', $.string)),

    typedef: ($) =>
      seq('typedef', field('type', $.type), field('domain', choice($.interval, $.set)), field('name', $.identifier), ';'),

    enum: ($) => seq('enum', field('name', $.identifier), '{', listed(field('value', $.identifier)), '}'),

    variables: ($) => seq(optional('filter'), field('type', $.type), listed($.declarator), ';'),

    declarator: ($) =>
      seq(
        field('name', $.identifier),
        optional(choice(seq('=', field('value', $.expression)), seq('(', field('value', $.expression), ')'))),
      ),

    type: ($) => choice('int', 'float', 'bool', 'string', $.identifier),

    assignment: ($) => seq(field('target', choice($.name, $.path)), choice('=', 'in'), field('value', $.expression), ';'),

    constraint: ($) => seq(optional('enforce'), $.expression, optional(seq(':', field('label', $.string))), ';'),

    close_all: (_) => seq('close', '(', ')', ';'),

    class: ($) =>
      seq(
        'class',
        field('name', $.identifier),
        choice(';', seq(optional(seq('extends', field('base', $.identifier))), field('body', $.block))),
      ),

    predicate: ($) => seq(choice('predicate', 'action'), field('name', $.identifier), field('body', $.block)),

    constructor: ($) =>
      prec.dynamic(
        1,
        seq(field('name', $.identifier), '(', optional(listed($.parameter)), ')', field('body', $.block)),
      ),

    parameter: ($) => seq(field('type', $.type), field('name', $.identifier)),

    super_call: ($) => seq('super', $.arguments, ';'),

    rule: ($) =>
      seq(field('class', $.identifier), '::', field('predicate', $.identifier), field('body', $.statement)),

    if: ($) =>
      prec.right(
        seq('if', '(', field('condition', $.expression), ')', field('then', $.statement),
          optional(seq('else', field('otherwise', $.statement)))),
      ),

    foreach: ($) =>
      seq('foreach', '(', field('name', $.identifier), 'in', field('values', choice($.name, $.this, $.path)), ')',
        field('body', $.statement)),

    goal: ($) => seq(choice('goal', 'fact', 'rejectable'), '(', listed($.instance), ')', ';'),

    relation: ($) =>
      seq(
        optional(field('origin', choice($.name, $.this))),
        field('relation', $.relation_word),
        repeat(field('bounds', $.interval)),
        choice(field('target', choice($.name, $.this, $.path)), seq('(', optional(listed($.instance)), ')')),
        ';',
      ),

    relation_word: (_) => choice(...RELATIONS),

    instance: ($) =>
      seq(
        optional(field('role', choice('condition', 'effect'))),
        field('predicate', choice($.name, $.this, $.path)),
        optional(field('name', $.identifier)),
      ),

    expression: ($) =>
      choice(
        $.binary,
        $.unary,
        $.number,
        $.string,
        $.boolean,
        $.name,
        $.this,
        $.path,
        $.interval,
        $.set,
        $.parenthesised,
        $.new,
        $.call,
        $.method_call,
      ),

    binary: ($) =>
      choice(
        ...[
          [OR, '||'],
          [AND, '&&'],
          [COMPARISON, choice('==', '!=', '<', '<=', '>', '>=')],
          [SUM, choice('+', '-')],
          [PRODUCT, choice('*', '/')],
        ].map(([level, operator]) =>
          prec.left(
            level,
            seq(field('left', $.expression), field('operator', operator), field('right', $.expression)),
          ),
        ),
      ),

    unary: ($) => prec(UNARY, seq(field('operator', choice('-', '+', '!')), $.expression)),

    parenthesised: ($) => seq('(', $.expression, ')'),

    new: ($) => seq('new', field('class', $.identifier), $.arguments),

    call: ($) => prec(8, seq(field('function', $.identifier), $.arguments)),

    method_call: ($) => prec(8, seq(field('method', $.path), $.arguments)),

    arguments: ($) => seq('(', optional(listed($.expression)), ')'),

    name: ($) => $.identifier,

    this: (_) => 'this',

    path: ($) =>
      seq(choice($.identifier, $.this), repeat1(seq('.', field('member', choice($.identifier, alias('close', $.identifier)))))),

    // A bound is no sum: `[1 -2]` holds two bounds.
    interval: ($) => seq('[', field('least', $._bound), optional(','), field('most', $._bound), ']'),

    _bound: ($) => choice($.number, $.name, $.this, $.path, $.call, $.parenthesised, alias($._negative, $.unary), $.boolean, $.string),

    _negative: ($) => prec(UNARY, seq(field('operator', choice('-', '+')), $._bound)),

    set: ($) => seq('{', listed($.expression), '}'),

    boolean: (_) => choice('true', 'false'),

    number: (_) =>
      choice('inf', 'inff', /[0-9]+[lLfFdD]?/, /([0-9]+\.[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?[fFdD]?/, /[0-9]+[eE][+-]?[0-9]+[fFdD]?/),

    string: ($) => seq('"', repeat(choice(token.immediate(/[^"\\\n]+/), $.escape)), token.immediate('"')),

    escape: (_) => token.immediate(/\\./),

    identifier: (_) => /[\p{L}_$][\p{L}\p{N}_$]*/u,

    comment: (_) => token(choice(/\/\/[^\n]*/, seq('/*', /[^*]*\*+([^/*][^*]*\*+)*/, '/'))),
  },
});
