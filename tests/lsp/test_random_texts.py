"""Whatever stands in a text, the editor gets its answer; `make editor-proof` opens 100,000 of them."""

import pytest

from tests.lsp.random_texts import opened


@pytest.mark.parametrize("first", range(0, 800, 200))
def test_any_words_in_any_order_are_analysed(first: int) -> None:
    for seed in range(first, first + 200):
        opened(seed)
