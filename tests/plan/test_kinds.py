"""Classes that inherit predicates: which predicate a child has, and which tokens may merge."""

from pathlib import Path

from tests.plan.models import text_of_tokens
