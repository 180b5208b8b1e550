"""`nddlc new`: write a model, a simulator, a mission and what a project needs beside them, ready to be checked."""

import re
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

import click

from nddlc.inputs import Unusable, write_text

TEMPLATES = (
    *("survey", "rover", "blank"),
    *("battery", "deadline", "retry", "window", "noise", "constraint", "lookout"),  # those of docs/cookbook.md
)
# What every project gets: the name of the template's file, and where it goes.
_COMMON = {"nddlc.toml": "nddlc.toml", "gitignore": ".gitignore", "workflow.yml": ".github/workflows/missions.yml"}
_NAME = re.compile(r"[A-Za-z][\w.-]*")


@click.command()
@click.argument("name")
@click.argument("more", nargs=-1, metavar="")
@click.option(
    "--template", type=click.Choice(TEMPLATES), help="What to begin with; by default what NAME says, or survey."
)
def command(name: str, more: tuple[str, ...], template: str | None) -> int:
    """Begin a project: a model, its simulator and a mission, in the new folder NAME, a name or a path.

    survey has a fault on purpose, which the tutorial finds and mends; all others hold. From battery on they are the
    recipes of the cookbook, one each. Nothing that exists is written over.
    """
    if more:
        meant = f"nddlc new {more[0]} --template {name}" if name in TEMPLATES else f"nddlc new {name}"
        raise Unusable(f"a project has one name, `{' '.join(more)}` is too much", f"`{meant}` makes one")
    folder = Path(name)
    if _NAME.fullmatch(folder.name) is None:
        raise Unusable(
            f"`{folder.name}` is no name for a project",
            "it begins with a letter; letters, digits, `_`, `-` and `.` follow",
        )
    texts = _project_texts(template or (folder.name if folder.name in TEMPLATES else TEMPLATES[0]), folder.name)
    there = [path for path in texts if (folder / path).exists()]
    if folder.is_file() or there:
        raise Unusable(f"`{folder / there[0] if there else folder}` exists already", "choose another name")
    for path, text in texts.items():
        try:
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
        except OSError as problem:
            raise Unusable(f"cannot make `{(folder / path).parent}`: {problem.strerror or problem}") from None
        write_text(folder / path, text)
    models = sorted(path for path in texts if path.endswith(".nddl"))
    click.echo(f"made `{folder}`:\n  models: {', '.join(models)}\n  mission: mission.toml")
    click.echo(f"  beside: {', '.join(sorted({*texts} - {*models, 'mission.toml'}))}")
    click.echo(f"\nnext:\n  cd {folder}\n  nddlc run       # one mission\n  nddlc check     # many")
    return 0


def _project_texts(template: str, name: str) -> dict[str, str]:
    """The texts of a new project by their paths, as the template has them but for the project's name."""
    root = files("models") / "templates"
    texts = {path: _text(root / "common" / file) for file, path in _COMMON.items()}
    for file in sorted((root / template).iterdir(), key=lambda each: each.name):
        if not file.is_file():
            continue
        text = _text(file)
        if file.name == "mission.toml":
            text = text.replace(f'\nname = "{template}"\n', f'\nname = "{name}"\n', 1)
        elif file.name == "README.md":
            text = text.replace(f"# {template}\n", f"# {name}\n", 1)
        texts[file.name] = text
    return texts


def _text(file: Traversable) -> str:
    return file.read_text(encoding="utf-8")
