"""List the words that attributes of a configuration may hold; the first of each list is the default.

The order is that of the codes in `codes.py`.
"""

POLICIES = ("PartiallyContained", "PossiblyContained", "TotallyContained")
CHOICES = ("mergeFirst", "activateFirst", "mergeOnly", "activateOnly")
TOKEN_ORDERS = ("early", "late", "near", "far", "ascendingKey")
INSTANT_ORDERS = ("lower", "upper", "most", "least", "earliest", "latest")
PAIR_WORDS = ("earliest", "latest", "longest", "shortest", "ascendingKey", "descendingKey")
PAIR_ORDERS = (*(word + end for word in PAIR_WORDS for end in ("Predecessor", "Successor")), "leastImpact")
KEEPS = ("none", "predecessorNot", "successor", "both")
CONSTRAINTS = ("precedesOnly", "precedesFirst", "concurrentOnly", "concurrentFirst")
ITERATIONS = ("pairFirst", "constraintFirst")
