"""Handler table: a numbered row of filters and handlers per kind of token, variable and resource.

Each is matched once, then looked up. A row also has the heap where its flaws wait; flaws whose handler or filters
depend on more than their own bounds have none (NONE): they are dynamic, looked at in every step.
"""

from array import array

from runtime.constraints.domains.arrays import grown
from runtime.plan.database import PlanDatabase
from runtime.plan.tags import ROLE_GLOBAL, ROLE_LOCAL, ROLE_MEMBER, ROLE_TOKEN
from runtime.solver.configuration.configuration import FlawHandler
from runtime.solver.configuration.handler_matching import HandlerMatching, HandlerRow, TokenKind
from runtime.solver.configuration.words import (
    CHOICES,
    CONSTRAINTS,
    HANDLERS,
    ITERATIONS,
    RESOURCE_ORDERS,
    TOKEN_ORDERS,
)
from runtime.solver.tags import (
    FILTER_HORIZON,
    FILTER_HORIZON_VARIABLE,
    FILTER_INFINITE,
    FILTER_NOT_SINGLETON,
    NONE,
    ORDER_KEY,
    PREFER_EARLIEST,
)

_UNKNOWN = -2  # a row that nobody has asked for yet
_FEW = 32  # variables of a token whose rows are looked up by number
_ROLE_RESOURCE = 5  # behind the roles of variables


class HandlerTable:
    """Rows, found by numbers of the plan."""

    def __init__(self, matching: HandlerMatching, database: PlanDatabase) -> None:
        self.matching = matching
        self.database = database
        self.program = database.program
        self.managers = len(matching.manager_kinds)
        self.manager_kind = array("q", matching.manager_kinds)
        self.by_predicate = matching.is_by_predicate
        self._number_handlers()
        self.filter_first = array("q")
        self.filter_count = array("q")
        self.filter_code = array("q")
        self.filter_policy = array("q")
        self.first_handler = array("q")
        self.handler_count = array("q")
        self.handler_of = array("q")
        self.heap_of = array("q")
        self.rows: dict[tuple[int, HandlerRow], int] = {}
        self.kinds: dict[tuple[int, int, int, int, bool], int] = {}
        self.kind_texts: list[TokenKind] = []
        self.kind_of_predicate = array("q", [NONE] * max(len(self.program.predicates), 1))
        self.token_rows = array("q", [_UNKNOWN]) * (8 * self.managers)  # by kind and manager
        self.variable_rows = array("q", [_UNKNOWN]) * (8 * self.managers * _FEW)  # those of the first variables, too
        self.other_rows: dict[int, int] = {}

    def _number_handlers(self) -> None:
        """Lay the handlers out in arrays, and give each manager a heap per priority, the best one first."""
        handlers = self.matching.handlers
        self.handlers = len(handlers)
        self.handler_code = array("q", [HANDLERS[one.component][1] for one in handlers])
        self.handler_priority = array("d", [one.priority for one in handlers])
        self.handler_most = array("q", [one.max_choices for one in handlers])
        self.handler_choice = array("q", [CHOICES.index(one.choice) for one in handlers])
        self.token_order = array("q", [_order_code(one) for one in handlers])
        self.handler_constraint = array("q", [CONSTRAINTS.index(one.constraint) for one in handlers])
        self.handler_iterate = array("q", [ITERATIONS.index(one.iterate) for one in handlers])
        self.pairs_by_default = array(
            "q",
            [1 if not one.order and one.keep == "none" and one.constraint == "precedesOnly" else 0 for one in handlers],
        )
        orders = [[RESOURCE_ORDERS.index(word) for word in one.order] for one in self.matching.managers]
        self.resource_order = array("q", [code for codes in orders for code in codes])
        self.resource_orders = array("q", [sum(map(len, orders[:k])) for k in range(len(orders) + 1)])
        self.prefers_earliest = array("q", [1 if codes[:1] == [PREFER_EARLIEST] else 0 for codes in orders])
        self.handler_guards = array("q", [len(one.guards) + len(one.parent_guards) for one in handlers])
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

    def _row(self, manager: int, found: HandlerRow | None) -> int:
        """The number of a row; NONE for none."""
        if found is None:
            return NONE
        known = self.rows.get((manager, found))
        if known is not None:
            return known
        self.filter_first = _longer(self.filter_first, len(self.filter_code))
        self.filter_count = _longer(self.filter_count, len(found.filters))
        for code, policy in found.filters:
            self.filter_code = _longer(self.filter_code, code)
            self.filter_policy = _longer(self.filter_policy, policy)
        usable = []
        for h in found.handlers:
            usable.append(h)
            if not self.handler_guards[h]:
                break
        self.first_handler = _longer(self.first_handler, len(self.handler_of))
        self.handler_count = _longer(self.handler_count, len(usable))
        for h in usable:
            self.handler_of = _longer(self.handler_of, h)
        simple = (FILTER_HORIZON, FILTER_HORIZON_VARIABLE, FILTER_INFINITE, FILTER_NOT_SINGLETON)
        heap = NONE
        if len(usable) == 1 and all(code in simple for code, _ in found.filters):
            heap = self.manager_heap[manager]
            while self.heap_priority[heap] != self.handler_priority[usable[0]]:
                heap += 1
        self.heap_of = _longer(self.heap_of, heap)
        row = len(self.rows)
        self.rows[(manager, found)] = row
        return row

    def token_kind(self, predicate: int, parent: int, relation: int, label: int, rejectable: bool) -> int:
        """The number of a kind of token; `parent` is a predicate; NONE stands for what there is not."""
        if self.by_predicate:
            if self.kind_of_predicate[predicate] == NONE:
                self.kind_of_predicate[predicate] = len(self.kind_texts)
                self.kind_texts.append(TokenKind(self.program.predicates[predicate].name))
            return self.kind_of_predicate[predicate]
        key = (predicate, parent, relation, label, rejectable)
        kind = self.kinds.get(key)
        if kind is None:
            kind = len(self.kind_texts)
            self.kinds[key] = kind
            database = self.database
            self.kind_texts.append(
                TokenKind(
                    self.program.predicates[predicate].name,
                    self.program.predicates[parent].name if parent >= 0 else None,
                    database.relation_names[relation] if relation >= 0 else None,
                    database.names.text(label) if label >= 0 else "",
                    rejectable,
                )
            )
        return kind

    def token_row(self, manager: int, kind: int) -> int:
        """The row of a manager for tokens of a kind."""
        at = kind * self.managers + manager
        if at >= len(self.token_rows):
            self.token_rows = grown(self.token_rows, 2 * at, _UNKNOWN)
        if self.token_rows[at] == _UNKNOWN:
            self.token_rows[at] = self._row(manager, self.matching.token(manager, self.kind_texts[kind]))
        return self.token_rows[at]

    def variable_row(self, manager: int, kind: int, number: int) -> int:
        """The row of a manager for variable `number` of tokens of a kind."""
        if number >= _FEW:
            return self.other_row(ROLE_TOKEN, manager, kind, number)
        at = (kind * self.managers + manager) * _FEW + number
        if at >= len(self.variable_rows):
            self.variable_rows = grown(self.variable_rows, 2 * at, _UNKNOWN)
        if self.variable_rows[at] == _UNKNOWN:
            self.variable_rows[at] = self._match(ROLE_TOKEN, manager, kind, number)
        return self.variable_rows[at]

    def resource_row(self, manager: int, owner: int) -> int:
        """The row of a manager for resources of class `owner`."""
        return self.other_row(_ROLE_RESOURCE, manager, owner, 0)

    def other_row(self, role: int, manager: int, owner: int, name: int) -> int:
        """The row of a manager for a variable of that role, or a resource; `owner` is a kind of token, or a class."""
        key = (((owner << 30) + name) * self.managers + manager) * 8 + role
        row = self.other_rows.get(key)
        if row is None:
            row = self._match(role, manager, owner, name)
            self.other_rows[key] = row
        return row

    def _match(self, role: int, manager: int, owner: int, name: int) -> int:
        """The row that the configuration has for a variable or a resource; NONE for what is not to be decided."""
        matching, program, texts = self.matching, self.program, self.database.names
        if role == ROLE_GLOBAL:
            found = matching.lasting_variable(manager, None, program.globals[name][0])
        elif role == ROLE_MEMBER:
            found = matching.lasting_variable(
                manager, program.classes[owner].name, program.classes[owner].members[name].name
            )
        elif role == _ROLE_RESOURCE:
            found = matching.resource(manager, program.classes[owner].name)
        elif role == ROLE_LOCAL:
            found = matching.token_variable(manager, self.kind_texts[owner], texts.text(name), True)
        else:
            token = self.kind_texts[owner]
            text = matching.variable_text(token.predicate, name)
            found = None if text is None else matching.token_variable(manager, token, text, False)
        return self._row(manager, found)


def _order_code(handler: FlawHandler) -> int:
    """The code of the order in which an HSTS handler sorts; by key for all others."""
    is_hsts = handler.component.startswith("HSTS")
    return TOKEN_ORDERS.index(handler.order[0]) if is_hsts and handler.order else ORDER_KEY


def _longer(numbers: "array[int]", number: int) -> "array[int]":
    """An array with one number more; rows are few."""
    grown = array("q", numbers)
    grown.append(number)
    return grown
