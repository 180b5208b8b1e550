"""Variants of a model with a mistake put in: edits of a copy, each at exactly one place."""

import shutil
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True, slots=True)
class Case:
    """Values of parameters, or the seed that draws them anew in the course of a mission."""

    values: dict[str, float]
    seed: int | None


@dataclass(frozen=True, slots=True)
class Mechanism:
    """How a mistake shows: failure codes, who gives up on which timeline, the token that the last repair is about.

    `rejects` is the timeline of what is rejected before that, if something is.
    """

    code: str
    reactor: str
    timeline: str
    broke: str
    rejects: str = ""


@dataclass(frozen=True, slots=True)
class Variant:
    """A mistake, and the cases in which it must show and must not."""

    name: str
    title: str
    folder: Path
    mission: str
    shows: Mechanism
    edits: tuple[tuple[str, str, str], ...]
    fails: tuple[Case, ...]
    passes: tuple[Case, ...]


def read_variant(file: Path) -> Variant:
    """Read the description of a variant."""
    data = tomllib.loads(file.read_text(encoding="utf-8"))
    return Variant(
        file.stem,
        data["title"],
        file.parent,
        data["mission"],
        Mechanism(**data["shows"]),
        tuple((edit["file"], edit["old"], edit["new"]) for edit in data["edit"]),
        tuple(_case(one) for one in data.get("fails", [])),
        tuple(_case(one) for one in data.get("passes", [])),
    )


def apply(variant: Variant, folder: Path) -> Path:
    """Copy the models into `folder`, put the mistake in, and give the copy's mission file.

    Raises ValueError for a place that is not there, or there more than once.
    """
    root = variant.folder.parent
    copy = folder / root.name
    shutil.copytree(root, copy)
    for name, old, new in variant.edits:
        file = copy / variant.folder.name / name
        text = file.read_text(encoding="utf-8")
        if text.count(old) != 1:
            raise ValueError(f"{variant.name}: {text.count(old)} places in {name} read {old!r}")
        file.write_text(text.replace(old, new), encoding="utf-8")
    return (copy / variant.folder.name / variant.mission).resolve()


def _case(given: dict[str, Any]) -> Case:
    values = {name: float(value) for name, value in given.items() if name != "seed"}
    return Case(values, given.get("seed"))
