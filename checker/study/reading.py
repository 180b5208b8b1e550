"""Read a study file: variants of one mission's models, how each is to be sampled, and what is expected of it."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from checker.codes import NO_FILE, NOT_TOML, OUT_OF_RANGE, TWICE
from checker.mission import LARGEST_SEED, MOST_MISSIONS
from checker.mission_table import MissionText, Table
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.read import read_source
from nddl_lang.text.toml_places import find_places
from nddl_lang.text.toml_slips import not_toml
from nddl_lang.text.values import toml_value

_DISTRIBUTIONS = ("uniform", "normal")
_MODES = ("inter", "intra")


@dataclass(frozen=True, slots=True)
class FileEdit:
    """A change of one place in a file; `old` stands there exactly once."""

    file: str  # relative to the folder of the study
    old: str
    new: str


@dataclass(frozen=True, slots=True)
class Variant:
    """A variant of the models. `expected` are failure rates by sampling, such as `uniform inter`.

    `beyond` names a variant whose mistake this one contains: missions that fail there too, with the same seed, are
    counted apart.
    """

    name: str
    title: str
    edits: tuple[FileEdit, ...]
    expected: Mapping[str, float]
    missions: int
    beyond: str = ""


@dataclass(frozen=True, slots=True)
class StudyFile:
    """What a study file says; paths are relative to `root`, the folder of the file."""

    name: str
    root: Path
    mission: str
    seed: int
    missions: int
    confidence: float
    corridor: float  # how far a rate may lie from the expected one
    time_limit: float  # seconds of wall time for one mission
    samplings: tuple[str, ...]
    variants: tuple[Variant, ...]


def read_study(path: Path) -> tuple[StudyFile | None, tuple[Diagnostic, ...]]:
    """Read the file at `path` (or raise OSError); None where a diagnostic is an error."""
    source = read_source(path)
    try:
        values = toml_value(source.text)
    except tomllib.TOMLDecodeError as problem:
        return None, (not_toml(NOT_TOML, source, str(problem)),)
    text = MissionText(source, find_places(source.text))
    top = Table(text, (), values, "a study file")
    head = top.table("study", "[study]", needed=True)
    missions = head.whole("missions", 200, 1, MOST_MISSIONS)
    distributions = _chosen(head, "distributions", _DISTRIBUTIONS)
    modes = _chosen(head, "modes", _MODES)
    samplings = tuple(f"{shape} {mode}" for mode in modes for shape in distributions)
    mission = head.string("mission")
    variants = _read_variants(top.tables("variant", needed=True), path.parent, samplings, missions)
    study = StudyFile(
        head.string("name"), path.parent, mission, head.whole("seed", 0, 0, LARGEST_SEED), missions,
        head.number("confidence", 0.95, 0.5, 0.999999), head.number("corridor", 0.08, 0.0, 1.0),
        head.number("time_limit", 600.0, 0.001), samplings, variants,
    )  # fmt: skip
    if mission and not (path.parent / mission).is_file():
        text.diagnostics.append(NO_FILE.at(text.value_span(("study", "mission")), path=mission))
    head.close()
    top.close()
    found = tuple(sorted(text.diagnostics, key=lambda one: one.span.begin))
    return (None if found else study), found


def _chosen(table: Table, key: str, known: tuple[str, ...]) -> tuple[str, ...]:
    """The words of a list, all of `known` where it is not written."""
    words = table.strings(key) or known
    for word in words:
        if word not in known:
            table.complain_of_value(key, word, f"among {', '.join(known)}")
    return words


def _read_variants(tables: list[Table], root: Path, samplings: tuple[str, ...], missions: int) -> tuple[Variant, ...]:
    variants: list[Variant] = []
    for table in tables:
        name = table.string("name")
        if name in [one.name for one in variants]:
            span = table.text.value_span((*table.path, "name"))
            table.text.diagnostics.append(TWICE.at(span, what="the variant", name=name))
        file = table.string("file", "")
        title = table.string("title", "")
        wanted = table.table("expected", "[variant.expected]")
        expected = {key: wanted.number(key, 0.0, 0.0, 1.0) for key in samplings if wanted.has(key)}
        wanted.asked += samplings
        wanted.close()
        beyond = table.string("beyond", "")
        if beyond and beyond not in [one.name for one in variants]:
            table.complain_of_value("beyond", beyond, "a variant named before")
        edits: tuple[FileEdit, ...] = ()
        if file and not (root / file).is_file():
            span = table.text.value_span((*table.path, "file"))
            table.text.diagnostics.append(NO_FILE.at(span, path=file))
        elif file:
            title, edits = _read_bug(table, root, file, title)
        variants.append(
            Variant(name, title, edits, expected, table.whole("missions", missions, 1, MOST_MISSIONS), beyond)
        )
        table.close()
    return tuple(variants)


def _read_bug(table: Table, root: Path, file: str, title: str) -> tuple[str, tuple[FileEdit, ...]]:
    """The title and the edits of a bug file, with files relative to the study."""
    span = table.text.value_span((*table.path, "file"))
    try:
        bug = toml_value((root / file).read_text(encoding="utf-8"))
        edits = []
        for one in bug["edit"]:
            name = (root / file).parent.joinpath(str(one["file"])).resolve().relative_to(root.resolve()).as_posix()
            edit = FileEdit(name, str(one["old"]), str(one["new"]))
            if (root / name).read_text(encoding="utf-8").count(edit.old) != 1:
                raise ValueError(f"`{name}` does not have the text to replace at exactly one place")
            edits.append(edit)
        return title or str(bug["title"]), tuple(edits)
    except (OSError, ValueError, KeyError, TypeError) as problem:
        reason = f"missing {problem}" if isinstance(problem, KeyError) else str(problem)
        table.text.diagnostics.append(
            OUT_OF_RANGE.at(span, key="file", wanted="a file whose edits can be made", found=f"`{file}`", help=reason)
        )
        return title, ()
