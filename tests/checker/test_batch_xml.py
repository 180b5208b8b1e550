"""The paper's batch file is read, and converted to tables of a mission file that mean the same."""

import tomllib
from pathlib import Path

import pytest

from checker.batch_xml import batch_toml, read_batch
from checker.mission import parse_mission
from nddl_lang.text.source import Source
from nddlc.main import run
from runtime.executive.configuration import ParameterConfiguration

FIGURE = """\
<SampledParameter name="errorRateX" component="ReSeededUniformRandom">
  <BatchSampler component="UniformRandInt">
    <Seed>7234</Seed>
    <Min>0</Min>
    <Max>2147483647</Max>
  </BatchSampler>
  <Sampler component="UniformRandDouble">
    <!-- <Seed>1</Seed> set for each mission -->
    <Min>-0.7</Min>
    <Max>0.7</Max>
    <UpdateFrequency>10</UpdateFrequency>
  </Sampler>
</SampledParameter>
"""
OTHERS = """\
<?xml version="1.0"?>
<!-- all kinds -->
<Batch>
  <SampledParameter name="a" component="UniformRandom">
    <BatchSampler component="UniformRandInt" Min="0" Max="38" Seed="5"/>
  </SampledParameter>
  <SampledParameter name="b" component="ReSeededNormalRandom">
    <Sampler component="NormalRandDouble"><Mean value="2.0"/><StdDev value="1.5"/><Min>0.5</Min></Sampler>
  </SampledParameter>
  <SampledParameter name="c.d" component="Fixed"><Sampler><Value>2.5</Value></Sampler></SampledParameter>
  <SampledParameter name="e" component="NormalRandom">
    <BatchSampler><NormalRandDouble Min="1" Max="3"/></BatchSampler>
  </SampledParameter>
</Batch>
"""


def test_figure_10_as_printed_is_read() -> None:
    batch, complaints = read_batch(Source("b.xml", FIGURE))
    assert not complaints
    assert batch is not None
    assert batch.seed == 7234
    assert batch.parameters == (ParameterConfiguration("errorRateX", -0.7, 0.7, "uniform", "intra", 10),)


def test_every_component_is_converted() -> None:
    batch, complaints = read_batch(Source("b.xml", OTHERS))
    assert not complaints
    assert batch is not None
    assert batch.seed == 5
    half = 1.5 * 3.0**0.5
    assert batch.parameters == (
        ParameterConfiguration("a", 0.0, 38.0, "uniform", is_whole=True),
        ParameterConfiguration(
            "b", 2.0 - half, 2.0 + half, "normal", "intra", clip=(0.5, float("inf")), mean=2.0, deviation=1.5
        ),
        ParameterConfiguration("c.d", 2.5, 2.5, "fixed", values=(2.5,)),
        ParameterConfiguration("e", 1.0, 3.0, "normal"),
    )
    tables = tomllib.loads(batch_toml(batch))
    assert tables["check"] == {"seed": 5}
    assert tables["parameters"]["a"] == {"range": [0, 38], "distribution": "uniform", "kind": "int", "mode": "inter"}
    assert tables["parameters"]["c.d"] == {"value": 2.5}
    normal = {"distribution": "normal", "mean": 2.0, "sigma": 1.5, "clip": [0.5, float("inf")]}
    assert tables["parameters"]["b"] == {**normal, "mode": "intra", "update": 10}
    assert tables["parameters"]["e"] == {"range": [1.0, 3.0], "distribution": "normal", "mode": "inter"}


@pytest.mark.parametrize(
    ("old", "new", "line", "reason"),
    [
        ("<Min>-0.7</Min>", "<Min>low</Min>", 9, "`Min` is `low`"),
        ("<Max>0.7</Max>", "", 7, "`Max` is missing"),
        ("ReSeededUniformRandom", "ReSeedUniformRandom", 1, "there is no component `ReSeedUniformRandom`"),
        ("<Sampler component", "<Smapler component", 7, "mismatched tag"),
        ('name="errorRateX" ', "", 1, "a `SampledParameter` needs a `name`"),
        ("<Max>0.7</Max>", "<Max>-0.9</Max>", 9, "`Min` -0.7 is above `Max` -0.9"),
    ],
)
def test_a_mistake_is_named_where_it_stands(old: str, new: str, line: int, reason: str) -> None:
    batch, complaints = read_batch(Source("b.xml", FIGURE.replace(old, new)))
    assert batch is None
    assert (complaints[0].span.line, complaints[0].message) == (line, f"this is no batch file: {reason}")


@pytest.mark.parametrize(("value", "help_"), [("0", "one value in all draws is the component `Fixed`"), ("-1", None)])
def test_a_normal_distribution_without_width_is_told(value: str, help_: str | None) -> None:
    """In `sigma` of a mission file it is a mistake as well."""
    text = OTHERS.replace('<StdDev value="1.5"/>', f'<StdDev value="{value}"/>')
    batch, complaints = read_batch(Source("b.xml", text))
    assert batch is None
    (one,) = complaints
    assert one.message.endswith("a normal one needs `Mean` and a `StdDev` above 0")
    assert one.span.text.startswith("<StdDev")
    assert one.help == help_


def test_what_is_no_batch_file_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for text in ("", "<a/>", "no xml", '<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "c">]><a>&b;</a>'):
        assert read_batch(Source("b.xml", text))[0] is None
    (tmp_path / "b.xml").write_text(FIGURE)
    assert run(["convert", str(tmp_path / "b.xml")]) == 0
    assert tomllib.loads(capsys.readouterr().out)["parameters"]["errorRateX"]["update"] == 10
    (tmp_path / "c.xml").write_text("<a/>")
    assert run(["convert", str(tmp_path / "c.xml")]) == 2
    assert "it has no element `SampledParameter`" in capsys.readouterr().err


def test_a_mission_file_may_name_a_batch_file(tmp_path: Path) -> None:
    (tmp_path / "b.xml").write_text(FIGURE)
    (tmp_path / "m.nddl").write_text("")
    text = '[mission]\nname = "m"\nfinal_tick = 9\nbatch = "b.xml"\n[[reactor]]\nname = "r"\nmodel = "m.nddl"\n'
    mission, found = parse_mission(Source("m.toml", text), tmp_path)
    assert not found
    assert mission is not None
    assert mission.check.seed == 7234
    assert [one.name for one in mission.agent.parameters] == ["errorRateX"]
    more = text + "[parameters.errorRateX]\nvalue = 0.5\n[check]\nseed = 3\n"
    mission, _ = parse_mission(Source("m.toml", more), tmp_path)
    assert mission is not None
    assert mission.check.seed == 3
    assert [one.distribution for one in mission.agent.parameters] == ["fixed"]
    mission, found = parse_mission(Source("m.toml", text.replace("b.xml", "c.xml")), tmp_path)
    assert mission is None
    assert [(one.code.id, one.span.line) for one in found] == [("NDDL708", 4)]


def test_a_parameter_that_no_model_samples_is_told_where_the_batch_file_has_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "b.xml").write_text(f"<Batch>\n{FIGURE}</Batch>\n")
    (tmp_path / "m.nddl").write_text("")
    text = '[mission]\nname = "m"\nfinal_tick = 9\nbatch = "b.xml"\n[[reactor]]\nname = "r"\nmodel = "m.nddl"\n'
    (tmp_path / "m.toml").write_text(text)
    assert run(["check", str(tmp_path / "m.toml"), "--dry-run"]) == 2
    told = "".join(capsys.readouterr())
    assert "NDDL714" in told and "b.xml:2:" in told and '<SampledParameter name="errorRateX"' in told


def test_what_stands_beside_the_samplers_counts(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """Attributes of a parameter, and a batch sampler for all; what has no effect is told."""
    text = """<Batch>
  <BatchSampler component="UniformRandInt" Seed="7" Missions="50"/>
  <SampledParameter name="PACE" component="ReSeededUniformRandom" UpdateFrequency="25" Min="9" Max="13"/>
  <SampledParameter name="LIGHT" component="ReSeededUniformRandom" updateFrequncy="30" Max="4">
    <Sampler><Min>0.5</Min></Sampler>
  </SampledParameter>
</Batch>"""
    batch, complaints = read_batch(Source("b.xml", text))
    assert batch is not None and batch.seed == 7
    assert [(one.name, one.lower, one.upper, one.update) for one in batch.parameters] == [
        ("PACE", 9.0, 13.0, 25),
        ("LIGHT", 0.5, 4.0, 10),
    ]
    told = [(one.span.line, one.message, one.help) for one in complaints]
    assert [(message, advice) for _, message, advice in told] == [
        ("`updateFrequncy` has no effect here", "did you mean `UpdateFrequency`?"),
        ("`Missions` has no effect here", "there are: Seed, Min, Max, Mean, StdDev, UpdateFrequency, Value"),
    ]
    (tmp_path / "b.xml").write_text(text)
    assert run(["convert", str(tmp_path / "b.xml")]) == 0
    printed = capsys.readouterr()
    assert "update = 25" in printed.out and "seed = 7" in printed.out
    assert "`Missions` has no effect here" in printed.err
