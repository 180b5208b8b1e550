"""Read the founding paper's batch file (Figure 10): XML in, sampled parameters and the batch seed out.

A `SampledParameter` holds a `BatchSampler`, which draws once per mission, and a `Sampler`, which is copied into the
mission. With a component `ReSeeded...` the batch sampler draws seeds and the sampler draws values every
`UpdateFrequency` ticks; with the others one value per mission is drawn. Values stand in elements or in attributes; a
text with several elements at its top, as printed, is read too.
"""

import math
from dataclasses import dataclass, field
from xml.parsers import expat

from checker.codes import ILL_BATCH, NO_EFFECT
from checker.mission_table import HELD, is_held
from checker.written_mission import key_text
from nddl_lang.text.byte_places import BytePlaces
from nddl_lang.text.diagnostic import Diagnostic, Severity
from nddl_lang.text.nearest import nearest
from nddl_lang.text.source import Anchor, Source, Span
from runtime.executive.configuration import Bounds, Mode, ParameterConfiguration

_UPDATE = 10  # ticks, where the file does not say
_PARAMETER = "SampledParameter"
_PARTS = ("BatchSampler", "Sampler")
_VALUES = ("Seed", "Min", "Max", "Mean", "StdDev", "UpdateFrequency", "Value")
_OTHERS = ("name", "component", "value")
# Component: the distribution and whether values are whole, or how often they are drawn.
_SHAPES = {
    "UniformRandInt": ("uniform", True),
    "UniformRandDouble": ("uniform", False),
    "NormalRandDouble": ("normal", False),
    "Fixed": ("fixed", False),
}
_RHYTHMS: dict[str, tuple[Mode, str]] = {
    "UniformRandom": ("inter", "uniform"),
    "NormalRandom": ("inter", "normal"),
    "ReSeededUniformRandom": ("intra", "uniform"),
    "ReSeededNormalRandom": ("intra", "normal"),
    "Fixed": ("inter", "fixed"),
}


@dataclass(frozen=True, slots=True)
class BatchFile:
    """What a batch file says; `seed` is that of the first batch sampler that has one, `spans` are of the parameters."""

    parameters: tuple[ParameterConfiguration, ...]
    seed: int | None
    spans: tuple[Span, ...]


@dataclass(slots=True)
class _Node:
    tag: str
    attributes: dict[str, str]
    span: Span
    children: "list[_Node]" = field(default_factory=list)
    text: str = ""


class _DoctypeFoundError(Exception):
    """Entities could follow: nothing more is read."""


class _Reader:
    def __init__(self, source: Source) -> None:
        self.anchor = Anchor(source)
        body = source.text.removeprefix("\ufeff").lstrip()
        self.head = ""
        if body.startswith("<?xml") and "?>" in body:  # the root that is put around all must stand behind it
            self.head = body[: body.index("?>") + 2]
        skipped = source.text.index(body) + len(self.head) if body else 0
        self.encoded = b"<batch>" + source.text[skipped:].encode("utf-8", "surrogatepass") + b"</batch>"
        self.places = BytePlaces(self.encoded, len(b"<batch>"), skipped)
        self.parser = expat.ParserCreate("utf-8")
        self.parser.StartElementHandler = self.start
        self.parser.EndElementHandler = self.end
        self.parser.CharacterDataHandler = self.data
        self.parser.StartDoctypeDeclHandler = self.refuse
        self.stack: list[_Node] = []
        self.root: _Node | None = None

    def span(self, width: int = 1) -> Span:
        begin = min(self.places.place(self.parser.CurrentByteIndex), len(self.anchor.source.text))
        return Span(self.anchor, begin, min(begin + width, len(self.anchor.source.text)))

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        node = _Node(tag, attributes, self.span(len(tag) + 1))
        if self.stack:
            self.stack[-1].children.append(node)
        else:
            self.root = node
        self.stack.append(node)

    def end(self, _tag: str) -> None:
        self.stack.pop()

    def data(self, text: str) -> None:
        if self.stack:
            self.stack[-1].text += text

    def refuse(self, *_declaration: object) -> None:
        raise _DoctypeFoundError


def read_batch(source: Source) -> tuple[BatchFile | None, tuple[Diagnostic, ...]]:
    """The batch file in `source`, None where a complaint says that it is none."""
    reader = _Reader(source)
    try:
        reader.parser.Parse(reader.encoded, True)
    except expat.ExpatError as error:
        reason, open_ = expat.ErrorString(error.code), reader.stack[1:]
        help_ = None
        if open_:
            tag = open_[-1].tag
            close = nearest(tag, (_PARAMETER, *_PARTS, *_VALUES))
            help_ = f"`<{tag}>` is open: it ends with `</{tag}>`" + (
                f", or is meant to be `<{close}>`" if close else ""
            )
        return None, (ILL_BATCH.at(open_[-1].span if open_ else reader.span(), reason=reason, help=help_),)
    except _DoctypeFoundError:
        return None, (ILL_BATCH.at(reader.span(), reason="it declares a document type"),)
    assert reader.root is not None
    complaints: list[Diagnostic] = []
    nodes = _find(reader.root, _PARAMETER)
    if not nodes:
        complaints.append(ILL_BATCH.at(Span(reader.anchor, 0, 1), reason=f"it has no element `{_PARAMETER}`"))
    found = [_parameter(node, complaints) for node in nodes]
    names = [one.name for one, _ in found]
    for node, name in zip(nodes, names, strict=True):
        if names.count(name) > 1 and nodes[names.index(name)] is not node:
            complaints.append(ILL_BATCH.at(node.span, reason=f"the parameter `{name}` is there twice"))
    seeds = [seed for _, seed in found if seed is not None]
    for lone in _find(reader.root, "BatchSampler", _PARAMETER):  # it draws the seeds of all
        seed = _values(lone, complaints).get("Seed")
        seeds += [] if seed is None else [int(seed)]
    if any(one.severity is Severity.ERROR for one in complaints):
        return None, tuple(complaints)
    batch = BatchFile(tuple(one for one, _ in found), seeds[0] if seeds else None, tuple(node.span for node in nodes))
    return batch, tuple(complaints)


def _find(node: _Node, tag: str, closed: str = "") -> list[_Node]:
    """The outermost elements of a kind, in order; what is inside of a `closed` one is not looked at."""
    found, pending = [], [node]
    while pending:
        node = pending.pop()
        if node.tag == tag:
            found.append(node)
        elif node.tag != closed:
            pending += reversed(node.children)
    return found


def _parameter(node: _Node, complaints: list[Diagnostic]) -> tuple[ParameterConfiguration, int | None]:
    begun = len(complaints)
    name = node.attributes.get("name", "").strip()
    if not name:
        complaints.append(ILL_BATCH.at(node.span, reason=f"a `{_PARAMETER}` needs a `name`"))
    component = _component(node, _RHYTHMS, complaints) or "UniformRandom"
    mode, shape = _RHYTHMS[component]
    parts = {child.tag: child for child in node.children if child.tag in _PARTS}
    common = _values(node, complaints)  # of what has no place of its own
    batch = parts.get("BatchSampler")
    values: dict[str, dict[str, float]] = {tag: {} for tag in _PARTS}
    values |= {tag: _values(part, complaints) for tag, part in parts.items()}
    drawing = "Sampler" if mode == "intra" or "Min" in values["Sampler"] or "Mean" in values["Sampler"] else ""
    drawing = drawing or ("BatchSampler" if batch is not None else "Sampler")
    is_whole = False
    if component == "Fixed" and "Value" in values["Sampler"]:
        drawing = "Sampler"
    if drawing in parts:
        inner = _component(parts[drawing], _SHAPES, complaints, is_needed=False)
        if inner is not None:
            shape, is_whole = _SHAPES[inner]
    given = common | values[drawing]
    known = len(complaints)
    lower, upper, clip = _range(shape, given, parts.get(drawing, node), complaints)
    if begun < known:  # what stands there says why the range is none
        del complaints[known:]
    update = int(values["Sampler"].get("UpdateFrequency", common.get("UpdateFrequency", _UPDATE)))
    if update < 1:
        complaints.append(ILL_BATCH.at(node.span, reason="`UpdateFrequency` must be at least 1"))
    seed = values["BatchSampler"].get("Seed", common.get("Seed"))
    listed = (lower,) if shape == "fixed" else ()
    mean, deviation = (given.get("Mean"), given.get("StdDev")) if shape == "normal" else (None, None)
    made = ParameterConfiguration(
        name, lower, upper, shape, mode, max(update, 1), clip, is_whole, listed, mean=mean, deviation=deviation
    )
    return made, None if seed is None else int(seed)


def _range(
    shape: str, given: dict[str, float], node: _Node, complaints: list[Diagnostic]
) -> tuple[float, float, Bounds | None]:
    """The range of a distribution; that of a normal one has its mean and variance: μ = (a+b)/2, σ² = (b−a)²/12."""
    clip: Bounds | None = None
    if shape == "fixed":
        value = given.get("Value", given.get("Min", math.nan))
        if math.isnan(value):
            complaints.append(ILL_BATCH.at(node.span, reason="a `Fixed` one needs a `Value`"))
        return value, value, None
    if shape == "normal" and ("Mean" in given or "StdDev" in given):
        if not {"Mean", "StdDev"} <= given.keys() or given["StdDev"] <= 0.0:
            place = next((child.span for child in node.children if child.tag == "StdDev"), node.span)
            help_ = "one value in all draws is the component `Fixed`" if given.get("StdDev") == 0.0 else None
            reason = "a normal one needs `Mean` and a `StdDev` above 0"
            complaints.append(ILL_BATCH.at(place, reason=reason, help=help_))
            return 0.0, 0.0, None
        half = given["StdDev"] * math.sqrt(3.0)
        if "Min" in given or "Max" in given:
            clip = (given.get("Min", -math.inf), given.get("Max", math.inf))
        return given["Mean"] - half, given["Mean"] + half, clip
    if not {"Min", "Max"} <= given.keys():
        missing = " and ".join(f"`{key}`" for key in ("Min", "Max") if key not in given)
        complaints.append(ILL_BATCH.at(node.span, reason=f"{missing} {'are' if 'and' in missing else 'is'} missing"))
        return 0.0, 0.0, None
    if given["Min"] > given["Max"]:
        place = next((child.span for child in node.children if child.tag == "Min"), node.span)
        reason = f"`Min` {given['Min']:g} is above `Max` {given['Max']:g}"
        complaints.append(ILL_BATCH.at(place, reason=reason, help="exchange them"))
    return given["Min"], given["Max"], None


def _component(
    node: _Node, known: dict[str, tuple[Mode, str]] | dict[str, tuple[str, bool]], complaints: list[Diagnostic],
    *, is_needed: bool = True,
) -> str | None:  # fmt: skip
    """The component of an element: an attribute, or the name of the one element in it."""
    inner = next((child.tag for child in node.children if child.tag in known), None)
    name = node.attributes.get("component", inner)
    if name is None and not is_needed:
        return None
    if name is None or name not in known:
        close = nearest(name, known) if name else None
        advice = f"did you mean `{close}`?" if close else "there are: " + ", ".join(known)
        what = f"there is no component `{name}`" if name else f"`{node.tag}` needs a `component`"
        complaints.append(ILL_BATCH.at(node.span, reason=what, help=advice))
        return None
    return name


def _unknown(child: _Node, owner: str, known: tuple[str, ...]) -> Diagnostic:
    """An element that has no meaning where it stands."""
    close = nearest(child.tag, known)
    advice = f"did you mean `{close}`?" if close else "there are: " + ", ".join(known)
    return ILL_BATCH.at(child.span, reason=f"there is no element `{child.tag}` in a `{owner}`", help=advice)


def _values(node: _Node, complaints: list[Diagnostic]) -> dict[str, float]:
    """The numbers of an element: of its attributes, its elements, and those of a component written as an element."""
    texts = {key: (text, node.span) for key, text in node.attributes.items() if key in _VALUES}
    for child in node.children:
        if child.tag in _VALUES:
            texts[child.tag] = (child.attributes.get("value", child.text).strip(), child.span)
        elif child.tag in _SHAPES and node.tag != _PARAMETER:
            texts |= {key: (f"{value!r}", child.span) for key, value in _values(child, complaints).items()}
        elif child.tag not in _PARTS:
            complaints.append(_unknown(child, node.tag, _PARTS if node.tag == _PARAMETER else _VALUES))
    for key in node.attributes:
        if key not in (*_VALUES, *_OTHERS):
            close = nearest(key, _VALUES)
            advice = f"did you mean `{close}`?" if close else "there are: " + ", ".join(_VALUES)
            complaints.append(NO_EFFECT.at(node.span, what=key, help=advice))
    found: dict[str, float] = {}
    for key, (text, span) in texts.items():
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not is_held(value) or (key in ("Seed", "UpdateFrequency") and value != int(value)):
            wanted = "a whole number" if key in ("Seed", "UpdateFrequency") else "a number, such as 0.5"
            if not is_held(value) and math.isfinite(value):
                wanted = f"a number {HELD}"
            complaints.append(ILL_BATCH.at(span, reason=f"`{key}` is `{text}`", help=f"it is {wanted}"))
        else:
            found[key] = value
    return found


def batch_toml(batch: BatchFile) -> str:
    """A batch file as tables of a mission file."""
    lines = ["[check]", f"seed = {batch.seed}", ""] if batch.seed is not None else []
    for one in batch.parameters:
        lines.append(f"[parameters.{key_text(one.name)}]")
        if one.distribution == "fixed":
            lines += [f"value = {one.lower!r}", ""]
            continue
        if one.mean is None:
            lines.append(f"range = [{one.lower!r}, {one.upper!r}]")
        lines.append(f'distribution = "{one.distribution}"')
        if one.mean is not None:
            lines += [f"mean = {one.mean!r}", f"sigma = {one.deviation!r}"]
        if one.clip is not None:
            lines.append(f"clip = [{one.clip[0]!r}, {one.clip[1]!r}]")
        if one.is_whole:
            lines.append('kind = "int"')
        lines += ['mode = "intra"', f"update = {one.update}"] if one.mode == "intra" else ['mode = "inter"']
        lines.append("")
    return "\n".join(lines).rstrip("\n") + "\n"
