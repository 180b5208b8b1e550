"""Say where the page of a code can be read."""

from functools import cache
from importlib.metadata import PackageNotFoundError, metadata
from pathlib import Path

_LOCAL = Path(__file__).resolve().parent.parent / "docs" / "rules"
_LABEL = "documentation"


@cache
def page_of(code: str) -> str | None:
    """The page in this checkout, or else on the documentation site that the package names; None without either."""
    local = _LOCAL / f"{code}.md"
    if local.is_file():
        return local.as_uri()
    site = _site()
    return f"{site}/rules/{code}" if site is not None else None


@cache
def _site() -> str | None:
    try:
        links = metadata("nddlc").get_all("Project-URL") or ()
    except PackageNotFoundError:
        return None
    for link in links:
        label, _, address = str(link).partition(",")
        if label.strip().lower() == _LABEL:
            return address.strip().rstrip("/")
    return None
