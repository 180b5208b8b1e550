"""The table of the founding paper's parts names tests, cases and fixtures that exist."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_every_row_names_what_is_there() -> None:
    page = (ROOT / "docs" / "paper.md").read_text(encoding="utf-8")
    rows = [line.split(" | ") for line in page.splitlines() if re.match(r"\| \d", line)]
    assert {int(row[0].strip("| ")) for row in rows} == {1, 3, 4, 5, 7, *range(11, 17), 18, *range(20, 25), 26}
    for row in rows:
        tests = re.findall(r"`(tests/[\w/]+\.py)::(\w+)`", row[-1])
        cases = re.findall(r"case `(\w+)`", row[-1])
        fixtures = re.findall(r"fixture `([\w./]+)`", row[-1])
        assert tests or cases or fixtures, row
        for file, name in tests:
            assert f"def {name}(" in (ROOT / file).read_text(encoding="utf-8"), (file, name)
        assert all((ROOT / "tests/executive/cases" / case / "expected.json").exists() for case in cases), cases
        assert all((ROOT / fixture).exists() for fixture in fixtures), fixtures
