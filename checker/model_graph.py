"""A model's file in, the model with all that it includes out, as the settings of its project say."""

from pathlib import Path

from nddl_lang.lint.configuration import settings_in
from nddl_lang.syntax.includes import LoadedModules, OpenText, load_module_graph
from nddl_lang.text.read import read_text


def read_model(path: Path, open_text: OpenText = read_text) -> LoadedModules:
    """Read a model; raises OSError where its file cannot be read. `open_text` gives the texts of files."""
    way = settings_in(path.parent)
    return load_module_graph(path, way.directories, way.dialect, open_text=open_text, most=way.most_lexemes)
