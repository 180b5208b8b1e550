"""Number what a configuration says about each kind of token, variable and resource; each is asked once, then looked up.

A row is one `Treatment`: its filters, its handlers, and the heap where its flaws wait. Flaws whose handler or whose
filters depend on more than their own bounds have no heap (NONE): they are looked at in every step.
"""

from array import array
from typing import Protocol

from runtime.solver.configuration.configuration import FlawHandler
from runtime.solver.configuration.handler_matching import (
    CHOICE_CODES,
    HANDLER_CODES,
    ORDER_CODES,
    Matching,
    TokenKind,
    Treatment,
)
from runtime.solver.configuration.words import CONSTRAINTS, INSTANT_ORDERS, ITERATIONS
from runtime.solver.tags import (
    FILTER_HORIZON,
    FILTER_HORIZON_VARIABLE,
    FILTER_INFINITE,
    FILTER_NOT_SINGLETON,
    NONE,
    ORDER_KEY,
    PREFER_EARLIEST,
)


class Vocabulary(Protocol):
    """The texts behind the numbers of the plan."""

    def predicate_text(self, predicate: int) -> str: ...
    def class_text(self, owner: int) -> str: ...
    def relation_text(self, relation: int) -> str: ...
    def name_text(self, name: int) -> str: ...
    def member_text(self, owner: int, place: int) -> str: ...
    def global_text(self, index: int) -> str: ...
    def value_text(self, v: int) -> str: ...
    def value_number(self, v: int, text: str) -> float | None: ...


class Treatments:
    """Rows of treatments, found by numbers of the plan."""

    def __init__(self, matching: Matching, vocabulary: Vocabulary, predicates: int) -> None:
        self.matching = matching
        self.vocabulary = vocabulary
        self.managers = len(matching.manager_kinds)
        self.manager_kind = array("q", matching.manager_kinds)
        self.by_predicate = not (matching.reads_masters or matching.reads_names)
        self.number_handlers()
        self.treatments = 0
        self.filter_first = array("q")
        self.filter_count = array("q")
        self.filter_code = array("q")
        self.filter_policy = array("q")
        self.first_handler = array("q")
        self.handler_count = array("q")
        self.handler_of = array("q")
        self.heap_of = array("q")
        self.rows: dict[tuple[int, Treatment], int] = {}
        self.kinds: dict[tuple[int, int, int, int], int] = {}
        self.kind_texts: list[TokenKind] = []
        self.kind_of_predicate = array("q", [NONE] * max(predicates, 1))
        self.token_rows: dict[int, int] = {}
        self.variable_rows: dict[tuple[int, int, int, int], int] = {}

    def number_handlers(self) -> None:
        """Lay the handlers out in arrays, and give each manager a heap per priority, the best one first."""
        handlers = self.matching.handlers
        self.handlers = len(handlers)
        self.handler_code = array("q", [HANDLER_CODES[one.component] for one in handlers])
        self.handler_priority = array("d", [one.priority for one in handlers])
        self.handler_most = array("q", [one.max_choices for one in handlers])
        self.handler_choice = array("q", [CHOICE_CODES[one.choice] for one in handlers])
        self.token_order = array("q", [order_code(one) for one in handlers])
        self.handler_constraint = array("q", [CONSTRAINTS.index(one.constraint) for one in handlers])
        self.handler_iterate = array("q", [ITERATIONS.index(one.iterate) for one in handlers])
        self.pairs_by_default = array(
            "q",
            [1 if not one.order and one.keep == "none" and one.constraint == "precedesOnly" else 0 for one in handlers],
        )
        orders = [[INSTANT_ORDERS.index(word) for word in one.order] for one in self.matching.managers]
        self.instant_order = array("q", [code for codes in orders for code in codes])
        self.instant_orders = array("q", [sum(map(len, orders[:k])) for k in range(len(orders) + 1)])
        self.prefers_earliest = array("q", [1 if codes[:1] == [PREFER_EARLIEST] else 0 for codes in orders])
        self.handler_guards = array("q", [len(one.guards) + len(one.master_guards) for one in handlers])
        priorities: list[float] = []
        first, count = [], []
        for numbers in self.matching.handlers_of:
            own = sorted({handlers[h].priority for h in numbers})
            first.append(len(priorities))
            count.append(len(own))
            priorities += own
        self.manager_heap = array("q", first)
        self.manager_heaps = array("q", count)
        self.heap_priority = array("d", priorities)
        self.heaps = len(priorities)

    def row(self, manager: int, treatment: Treatment | None) -> int:
        """The number of a treatment; NONE for none."""
        if treatment is None:
            return NONE
        known = self.rows.get((manager, treatment))
        if known is not None:
            return known
        self.filter_first = longer(self.filter_first, len(self.filter_code))
        self.filter_count = longer(self.filter_count, len(treatment.filters))
        for code, policy in treatment.filters:
            self.filter_code = longer(self.filter_code, code)
            self.filter_policy = longer(self.filter_policy, policy)
        usable = []
        for h in treatment.handlers:
            usable.append(h)
            if not self.handler_guards[h]:
                break
        self.first_handler = longer(self.first_handler, len(self.handler_of))
        self.handler_count = longer(self.handler_count, len(usable))
        for h in usable:
            self.handler_of = longer(self.handler_of, h)
        simple = (FILTER_HORIZON, FILTER_HORIZON_VARIABLE, FILTER_INFINITE, FILTER_NOT_SINGLETON)
        heap = NONE
        if len(usable) == 1 and all(code in simple for code, _ in treatment.filters):
            heap = self.manager_heap[manager]
            while self.heap_priority[heap] != self.handler_priority[usable[0]]:
                heap += 1
        self.heap_of = longer(self.heap_of, heap)
        row = self.treatments
        self.treatments = row + 1
        self.rows[(manager, treatment)] = row
        return row

    def token_kind(self, predicate: int, master: int, relation: int, label: int) -> int:
        """The number of a kind of token; `master` is a predicate, and NONE stands for what there is not."""
        if self.by_predicate:
            if self.kind_of_predicate[predicate] == NONE:
                self.kind_of_predicate[predicate] = len(self.kind_texts)
                self.kind_texts.append(TokenKind(self.vocabulary.predicate_text(predicate)))
            return self.kind_of_predicate[predicate]
        key = (predicate, master, relation, label)
        kind = self.kinds.get(key)
        if kind is None:
            kind = len(self.kind_texts)
            self.kinds[key] = kind
            texts = self.vocabulary
            self.kind_texts.append(
                TokenKind(
                    texts.predicate_text(predicate),
                    texts.predicate_text(master) if master >= 0 else None,
                    texts.relation_text(relation) if relation >= 0 else None,
                    texts.name_text(label) if label >= 0 else "",
                )
            )
        return kind

    def token_row(self, manager: int, kind: int) -> int:
        """What a manager of tokens does about tokens of a kind."""
        key = kind * self.managers + manager
        row = self.token_rows.get(key)
        if row is None:
            row = self.row(manager, self.matching.token(manager, self.kind_texts[kind]))
            self.token_rows[key] = row
        return row

    def variable_row(self, manager: int, kind: int, place: int) -> int:
        """What a manager of variables does about variable number `place` of tokens of a kind."""
        key = (manager, kind, place, 0)
        row = self.variable_rows.get(key)
        if row is None:
            token = self.kind_texts[kind]
            text = self.matching.variable_text(token.predicate, place)
            treatment = self.matching.token_variable(manager, token, text, False) if text is not None else None
            row = self.row(manager, treatment)
            self.variable_rows[key] = row
        return row

    def local_row(self, manager: int, kind: int, name: int) -> int:
        """What a manager of variables does about a local variable of the rules of tokens of a kind."""
        key = (manager, kind, name, 1)
        row = self.variable_rows.get(key)
        if row is None:
            text = self.vocabulary.name_text(name)
            row = self.row(manager, self.matching.token_variable(manager, self.kind_texts[kind], text, True))
            self.variable_rows[key] = row
        return row

    def place_of(self, predicate: int, name: str) -> int:
        """Which variable of its tokens a predicate calls `name`; NONE if none."""
        return self.matching.place_of(self.vocabulary.predicate_text(predicate), name)

    def member_row(self, manager: int, owner: int, name: int) -> int:
        """What a manager of variables does about a member of objects of class `owner`."""
        texts = self.vocabulary
        return self.row(manager, self.matching.member(manager, texts.class_text(owner), texts.member_text(owner, name)))

    def instant_row(self, manager: int, owner: int) -> int:
        """What a manager of resources does about resources of class `owner`."""
        key = (manager, owner, NONE, NONE)
        row = self.variable_rows.get(key)
        if row is None:
            row = self.row(manager, self.matching.instant(manager, self.vocabulary.class_text(owner)))
            self.variable_rows[key] = row
        return row

    def global_row(self, manager: int, name: int) -> int:
        """What a manager of variables does about a global variable."""
        return self.row(manager, self.matching.global_variable(manager, self.vocabulary.global_text(name)))


def order_code(handler: FlawHandler) -> int:
    """How an HSTS handler sorts tokens; by key for all others."""
    return ORDER_CODES[handler.order[0]] if handler.component.startswith("HSTS") and handler.order else ORDER_KEY


def longer(numbers: "array[int]", number: int) -> "array[int]":
    """An array with one number more; rows are few."""
    grown = array("q", numbers)
    grown.append(number)
    return grown
