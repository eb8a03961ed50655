"""fit, transfer and register on files: what they make, tell and refuse, and that refusals come first."""

from __future__ import annotations

import contextlib
import csv
import json
import re
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import facemorph
from facemorph.cli import fitting, main
from facemorph.cli.fitting import told_progress
from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig
from facemorph.fit import example_based, transfer
from facemorph.io import load_rig, read_mesh, write_face, write_obj
from tests.conftest import bumpy_grid
from tests.ui.fit_case import EXAMPLES, head_rig, person_files, person_rig, scanned, shuffled

TEMPLATE = head_rig()
PERSON = person_rig(TEMPLATE)
WEIGHTS = {name: ",".join(f"{k}={v}" for k, v in weights.items()) for name, weights in EXAMPLES.items()}
STAGES = {"template", "read", "transfer", "write", "total"}


@pytest.fixture(scope="module")
def files(tmp_path_factory) -> Path:
    """A folder with the template, and a person's neutral and examples, also as scans with pairs."""
    folder = tmp_path_factory.mktemp("fit")
    write_face(TEMPLATE, folder / "template")
    person_files(PERSON, folder)
    write_obj(folder / "scan.obj", scanned(PERSON.neutral))
    for name, weights in EXAMPLES.items():
        write_obj(folder / f"scan-{name}.obj", scanned(PERSON.posed(weights)))
    write_obj(folder / "shuffled.obj", shuffled(PERSON.neutral))
    write_obj(folder / "grid.obj", bumpy_grid())
    pairs(folder / "pairs.csv", scanned(PERSON.neutral))
    return folder


def pairs(path: Path, scan: Mesh) -> Path:
    """The template's landmarks and more of its vertices, by places on a scan that begins with these."""
    vertices = {mark.vertex: mark.name for mark in TEMPLATE.info.landmarks}
    vertices |= {v: "" for v in range(0, TEMPLATE.neutral.vertex_count, 23) if v not in vertices}
    with path.open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(("name", "template", "x", "y", "z"))
        rows.writerows((name, v, *scan.positions[v].tolist()) for v, name in vertices.items())
    return path


def run(capsys, *words: object) -> str:
    """What a command prints that goes well, without a word of complaint."""
    status = main([str(word) for word in words])
    told = capsys.readouterr()
    assert (status, told.err) == (0, "")
    return told.out


def refused(capsys, *words: object) -> str:
    """The one line that a refused command leaves on standard error."""
    assert main([str(word) for word in words]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    (line,) = told.err.splitlines()
    assert line.startswith("facemorph: ")
    return line


def fit(files: Path, *more: object) -> list[object]:
    return ["fit", files / "template", "--neutral", files / "neutral.obj", *more]


@pytest.fixture
def idle(monkeypatch) -> None:
    """No fit and no registration may begin: what is refused is refused before."""

    def begun(*_: object, **__: object) -> None:
        raise AssertionError("the long work has begun")

    import facemorph.fit
    import facemorph.fit.registration
    import facemorph.fit.report

    monkeypatch.setattr(facemorph.fit, "example_based", begun)
    monkeypatch.setattr(facemorph.fit.registration, "register", begun)
    monkeypatch.setattr(facemorph.fit.registration, "followed", begun)
    monkeypatch.setattr(facemorph.fit.report, "fit_report", begun)


def same_shapes(found: Rig, rig: Rig, part: float = 2e-5) -> None:
    """The same shapes by name, to a part of the diagonal."""
    assert sorted(found.names) == sorted(rig.names)
    order = [found.names.index(name) for name in rig.names]
    np.testing.assert_allclose(found.deltas[order], rig.deltas, atol=part * rig.neutral.diagonal)


def meshes() -> dict[str, np.ndarray]:
    return {name: PERSON.positions(weights) for name, weights in EXAMPLES.items()}


def test_fit_writes_what_the_library_makes_and_weights_belong_to_the_example_before(capsys, files, tmp_path):
    words = [
        word for name in EXAMPLES for word in ("--example", files / f"{name}.obj", "--weights", WEIGHTS[name])
    ]
    run(capsys, *fit(files, *words, "--iterations", 3, "-o", tmp_path / "ann"))
    made = example_based(TEMPLATE, PERSON.neutral, meshes(), list(EXAMPLES.values()), iterations=3).rig
    found = load_rig(tmp_path / "ann")
    same_shapes(found, made)
    assert found.info.name == "ann"
    assert found.info.unit == "cm"
    assert "Template" in found.info.credit
    assert found.info.landmarks == TEMPLATE.info.landmarks
    assert [shape.set for shape in found.shapes] == [shape.set for shape in TEMPLATE.shapes]
    np.testing.assert_array_equal(found.neutral.positions, PERSON.neutral.positions)


def test_json_tells_errors_weights_times_and_memory(capsys, files, tmp_path):
    words = [word for name in EXAMPLES for word in ("--example", files / f"{name}.obj")]
    facts = json.loads(run(capsys, *fit(files, *words, "--iterations", 4, "--json", "-o", tmp_path / "ann")))
    result = example_based(TEMPLATE, PERSON.neutral, meshes(), iterations=4)
    assert [example["name"] for example in facts["examples"]] == list(EXAMPLES)
    for told, example in zip(facts["examples"], result.examples, strict=True):
        assert told.keys() == {
            "name", "rms", "rms_percent", "largest", "largest_percent", "unexplained", "weights",
        }  # fmt: skip
        for key in ("rms", "rms_percent", "largest", "largest_percent"):
            assert told[key] == pytest.approx(getattr(example, key), rel=1e-2, abs=1e-5)
        assert told["largest"] / facts["diagonal"] * 100 == pytest.approx(told["largest_percent"])
        assert told["weights"] == pytest.approx(dict(example.weights), abs=1e-3)
    assert [turn["rms_percent"] for turn in facts["history"]] == pytest.approx(
        [turn.rms_percent for turn in result.history], rel=1e-2
    )
    assert (facts["history"][0]["alpha"], facts["history"][-1]["lambda"]) == pytest.approx((0.5, 10.0))
    assert facts["seconds"].keys() == STAGES | {"fit"}
    assert facts["seconds"]["total"] >= sum(
        value for stage, value in facts["seconds"].items() if stage != "total"
    ) - 0.01  # fmt: skip
    assert facts["peak_memory_mb"] > 10
    assert (facts["vertices"], facts["shapes"], facts["unit"]) == (TEMPLATE.neutral.vertex_count, 6, "cm")
    assert facts["wrapped"] == {}
    assert facts["output"] == str(tmp_path / "ann")


def test_in_plain_words_each_example_has_a_line_and_the_folder_stands_last(capsys, files, tmp_path):
    words = [word for name in EXAMPLES for word in ("--example", files / f"{name}.obj")]
    *lines, made, folder = run(capsys, *fit(files, *words, "-o", tmp_path / "ann")).splitlines()
    assert [line.split(":")[0] for line in lines] == list(EXAMPLES)
    assert "happy" in lines[0]
    assert made.startswith("6 shapes in ")
    assert folder == str(tmp_path / "ann")


def test_a_folder_called_as_a_face_of_ours_is_told_so_that_it_opens(capsys, files, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    folder = run(capsys, *fit(files, "-o", "ben")).splitlines()[-1]
    assert load_rig(folder).names == TEMPLATE.names


def test_an_empty_folder_may_be_the_one_where_one_stands(capsys, files, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run(capsys, *fit(files, "-o", "."))
    assert (Path() / "face.toml").is_file()
    assert load_rig(tmp_path).info.name == tmp_path.name


def test_no_example_is_transfer(capsys, files, tmp_path):
    run(capsys, *fit(files, "-o", tmp_path / "fit"))
    facts = json.loads(
        run(
            capsys, "transfer", files / "template", "--neutral", files / "neutral.obj", "--json", "-o",
            tmp_path / "transfer",
        )
    )  # fmt: skip
    assert (facts["examples"], facts["history"], facts["seconds"].keys()) == ([], [], STAGES)
    made = transfer(TEMPLATE, PERSON.neutral).rig
    for name in ("fit", "transfer"):
        same_shapes(load_rig(tmp_path / name), made)


def test_only_the_named_shapes_and_sets_explain_the_examples_and_all_are_made(capsys, files, tmp_path):
    words = ["--example", files / "grimace.obj", "--shapes", "facs,jawOpen", "--json"]
    facts = json.loads(run(capsys, *fit(files, *words, "-o", tmp_path / "ann")))
    assert facts["examples"][0]["weights"].keys() <= {"AU1", "AU12", "jawOpen"}
    assert facts["shapes"] == 6


def test_an_expression_that_the_template_cannot_make_is_told(capsys, files, tmp_path):
    points = PERSON.neutral.positions.copy()
    points[150:154] += np.float32([0.0, 0.0, 3.0])
    write_obj(tmp_path / "horn.obj", PERSON.neutral.with_positions(points))
    words = ["--example", tmp_path / "horn.obj", "--example", files / "smile.obj"]
    assert "cannot make all of it" in run(capsys, *fit(files, *words, "-o", tmp_path / "1")).splitlines()[0]
    facts = json.loads(run(capsys, *fit(files, *words, "--json", "-o", tmp_path / "2")))
    assert [example["unexplained"] for example in facts["examples"]] == [True, False]


def test_examples_of_one_file_name_are_told_apart(capsys, files, tmp_path):
    for name in ("smile", "shout"):
        (tmp_path / name).mkdir()
        shutil.copy(files / f"{name}.obj", tmp_path / name / "neutral.obj")
    words = [w for name in ("smile", "shout") for w in ("--example", tmp_path / name / "neutral.obj")]
    facts = json.loads(run(capsys, *fit(files, *words, "--json", "-o", tmp_path / "ann")))
    assert [example["name"] for example in facts["examples"]] == ["neutral 2", "neutral 3"]
    assert facts["examples"][0]["weights"]["happy"] > 0.5
    assert facts["examples"][1]["weights"]["jawOpen"] > 0.5


def test_the_unit_follows_from_the_size(capsys, files, tmp_path):
    for name in ("neutral", "smile"):
        mesh = read_mesh(files / f"{name}.obj")
        write_obj(tmp_path / f"{name}.obj", mesh.with_positions(mesh.positions * np.float32(10)))
    words = [
        "fit",
        files / "template",
        "--neutral",
        tmp_path / "neutral.obj",
        "--example",
        tmp_path / "smile.obj",
    ]
    facts = json.loads(run(capsys, *words, "--json", "-o", tmp_path / "ann"))
    assert facts["unit"] == "mm"
    assert load_rig(tmp_path / "ann").info.unit == "mm"
    assert facts["examples"][0]["rms_percent"] < 0.1


def test_a_report_compares_methods_and_measures_what_no_fit_has_seen(capsys, files, tmp_path):
    words = ["--example", files / "smile.obj", "--example", files / "shout.obj", "--iterations", 2]
    more = ["--held-out", files / "grimace.obj", "--report", tmp_path / "ann" / "report"]
    out = run(capsys, *fit(files, *words, *more, "-o", tmp_path / "ann"))
    assert out.splitlines()[-1] == str(tmp_path / "ann" / "report")
    report = json.loads((tmp_path / "ann" / "report" / "report.json").read_text())
    assert (report["examples"], report["held_out"]) == (["smile", "shout"], ["grimace"])
    assert len(report["rows"]) >= 4
    pictures = list((tmp_path / "ann" / "report").glob("*.png"))
    assert len(pictures) == 3
    assert all(picture.read_bytes().startswith(b"\x89PNG") for picture in pictures)
    assert len(load_rig(tmp_path / "ann").shapes) == 6
    facts = json.loads(
        run(capsys, *fit(files, *words, "--report", tmp_path / "r", "--json", "-o", tmp_path / "b"))
    )
    assert facts["report"] == str(tmp_path / "r")
    assert facts["seconds"].keys() == STAGES | {"fit", "report"}


def test_register_lays_the_template_on_a_scan_in_the_scans_unit(capsys, files, tmp_path):
    words = ["register", files / "template", files / "scan.obj", "--landmarks", files / "pairs.csv"]
    facts = json.loads(run(capsys, *words, "--json", "-o", tmp_path / "new" / "wrapped.obj"))
    mesh = read_mesh(tmp_path / "new" / "wrapped.obj")
    np.testing.assert_array_equal(mesh.corner_vertices, TEMPLATE.neutral.corner_vertices)
    truth = scanned(PERSON.neutral).positions[: TEMPLATE.neutral.vertex_count]
    assert np.abs(mesh.positions - truth).max() < 0.02 * PERSON.neutral.diagonal * 10
    assert facts["mean_percent"] < 0.05
    assert facts["largest"] / facts["largest_percent"] == pytest.approx(facts["mean"] / facts["mean_percent"])
    assert {"p95", "p95_percent", "flipped", "crossed", "peak_memory_mb"} < facts.keys()
    assert (facts["vertices"], facts["triangles"]) == (420, 784)
    assert facts["seconds"].keys() == {"align", "wrap", "ride", "measure"}
    lines = run(capsys, *words, "-o", tmp_path / "new" / "wrapped.obj").splitlines()
    assert lines[-1] == str(tmp_path / "new" / "wrapped.obj")
    assert "% of the diagonal on average" in lines[0]


@pytest.mark.parametrize("last", [False, True])
def test_a_scan_is_wrapped_and_expressions_of_its_topology_follow_it(capsys, files, tmp_path, last):
    marks = ["--landmarks", files / "pairs.csv"]
    words = [word for name in EXAMPLES for word in ("--example", files / f"scan-{name}.obj")]
    words = [*words, *marks] if last else [*marks, *words]
    facts = json.loads(
        run(
            capsys, "fit", files / "template", "--neutral", files / "scan.obj", *words, "--json", "-o",
            tmp_path / "ann",
        )
    )  # fmt: skip
    assert facts["wrapped"].keys() == {"scan"}
    assert facts["seconds"].keys() == STAGES | {"fit", "register"}
    assert facts["unit"] == "mm"
    assert facts["wrapped"]["scan"]["mean_percent"] < 0.05
    assert all(example["rms_percent"] < 0.1 for example in facts["examples"])
    found = load_rig(tmp_path / "ann")
    for name, weights in EXAMPLES.items():
        (told,) = (e for e in facts["examples"] if e["name"] == f"scan-{name}")
        truth = scanned(PERSON.posed(weights)).positions[:420]
        off = np.abs(found.positions(told["weights"]) - truth).max()
        assert off < 0.02 * found.neutral.diagonal, name


def test_an_expression_of_a_third_topology_is_wrapped_by_its_own_landmarks(capsys, files, tmp_path):
    smile = scanned(PERSON.posed(EXAMPLES["smile"]))
    third = Mesh.from_triangles(smile.positions, smile.corner_vertices.reshape(-1, 3)[:-3].copy())
    write_obj(tmp_path / "third.obj", third)
    words = [
        "--landmarks", files / "pairs.csv", "--example", files / "scan-shout.obj", "--example",
        tmp_path / "third.obj", "--landmarks", pairs(tmp_path / "third.csv", third),
    ]  # fmt: skip
    scan = ["fit", files / "template", "--neutral", files / "scan.obj"]
    facts = json.loads(run(capsys, *scan, *words, "--json", "-o", tmp_path / "ann"))
    assert facts["wrapped"].keys() == {"scan", "third"}
    shout, third_told = facts["examples"]
    assert shout["weights"]["jawOpen"] > 0.6
    assert third_told["weights"]["happy"] > 0.5
    assert third_told["rms_percent"] < 0.2


def test_an_expression_of_another_topology_beside_a_neutral_of_the_templates(capsys, files, tmp_path):
    smile = scanned(PERSON.posed(EXAMPLES["smile"]), scale=1.0)
    write_obj(tmp_path / "smile.obj", smile)
    words = ["--example", tmp_path / "smile.obj", "--landmarks", pairs(tmp_path / "pairs.csv", smile)]
    facts = json.loads(run(capsys, *fit(files, *words, "--json", "-o", tmp_path / "ann")))
    assert facts["wrapped"].keys() == {"smile"}
    np.testing.assert_array_equal(load_rig(tmp_path / "ann").neutral.positions, PERSON.neutral.positions)


# What is refused.


def test_another_topology_without_landmarks_is_refused_at_once(capsys, files, tmp_path, idle):
    scan = files / "scan.obj"
    for verb in ("fit", "transfer"):
        line = refused(capsys, verb, files / "template", "--neutral", scan, "-o", tmp_path / "ann")
        assert f"{scan}: it has 812 vertices, the template 420." in line
        assert "--landmarks" in line
        assert "facemorph register" in line
    words = ["--example", files / "smile.obj", "--example", files / "grid.obj"]
    assert "grid.obj: it has 99 vertices" in refused(capsys, *fit(files, *words, "-o", tmp_path / "ann"))
    line = refused(
        capsys, "fit", files / "template", "--neutral", scan, "--landmarks", files / "pairs.csv", "--example",
        files / "grid.obj", "-o", tmp_path / "ann",
    )  # fmt: skip
    assert "grid.obj: it has 99 vertices" in line


def test_landmarks_given_once_are_not_taken_for_two_meshes(capsys, files, tmp_path, idle):
    words = ["fit", files / "template", "--neutral", files / "scan.obj", "--example", files / "grid.obj"]
    line = refused(capsys, *words, "--landmarks", files / "pairs.csv", "-o", tmp_path / "ann")
    assert "grid.obj: it has 99 vertices" in line


def test_vertices_in_another_order_are_told_and_what_helps(capsys, files, tmp_path, idle):
    words = ["transfer", files / "template", "--neutral", files / "shuffled.obj", "-o", tmp_path / "ann"]
    line = refused(capsys, *words)
    assert "vertices in another order" in line
    assert "--repair" in line


def broken(files: Path, folder: Path, kind: str) -> Path:
    """The person's neutral or an example, spoilt."""
    path = folder / f"{kind}.obj"
    mesh = PERSON.neutral
    points = mesh.positions.copy()
    if kind == "degenerate":
        points[mesh.corner_vertices[:4]] = points[0]
    if kind == "nan":
        text = (files / "smile.obj").read_text().splitlines()
        number = next(n for n, line in enumerate(text) if line.startswith("v "))
        text[number] = "v 1 nan 2"
        path.write_text("\n".join(text))
        return path
    if kind == "text":
        path.write_text("not a mesh at all\n")
        return path
    if kind == "empty":
        path.write_bytes(b"")
        return path
    if kind != "missing":
        write_obj(path, mesh.with_positions(points))
    return path


@pytest.mark.parametrize(
    ("kind", "told"),
    [
        ("degenerate", r"degenerate.obj: \d of 784 triangles are degenerate"),
        ("nan", "nan.obj"),
        ("text", "text.obj"),
        ("empty", "empty.obj"),
        ("missing", "missing.obj"),
    ],
)
def test_a_neutral_that_cannot_be_used_is_refused_at_once(capsys, files, tmp_path, idle, kind, told):
    path = broken(files, tmp_path, kind)
    line = refused(capsys, "transfer", files / "template", "--neutral", path, "-o", tmp_path / "ann")
    assert re.search(told, line)
    assert not (tmp_path / "ann").exists()


@pytest.mark.parametrize("option", ["--example", "--held-out"])
@pytest.mark.parametrize("kind", ["nan", "text", "empty", "missing"])
def test_other_files_that_cannot_be_read_are_refused_at_once(capsys, files, tmp_path, idle, kind, option):
    words = ["--example", files / "smile.obj", option, broken(files, tmp_path, kind)]
    line = refused(capsys, *fit(files, *words, "--report", tmp_path / "r", "-o", tmp_path / "ann"))
    assert f"{kind}.obj" in line
    assert not (tmp_path / "ann").exists()
    assert not (tmp_path / "r").exists()


def test_an_example_equal_to_the_neutral_is_refused_at_once(capsys, files, tmp_path, idle):
    line = refused(capsys, *fit(files, "--example", files / "neutral.obj", "-o", tmp_path / "ann"))
    assert "neutral.obj: it is equal to the neutral" in line
    words = ["--landmarks", files / "pairs.csv", "--example", files / "scan.obj", "-o", tmp_path / "ann"]
    line = refused(capsys, "fit", files / "template", "--neutral", files / "scan.obj", *words)
    assert "scan.obj: it is equal to the neutral" in line


@pytest.mark.parametrize(
    ("weights", "told"),
    [
        ("hapy=0.5", "no shape of the template is called 'hapy'. Did you mean 'happy'?"),
        ("happy=1.5", "a weight lies between 0 and 1; happy = 1.5 does not"),
        ("happy=-0.1", "a weight lies between 0 and 1"),
        ("happy=much", "--weights happy"),
        ("happy=nan", "--weights happy"),
        ("happy", "--weights takes NAME=VALUE"),
        ("=1", "--weights takes NAME=VALUE"),
        (" , ", "--weights takes names with commas"),
    ],
)
def test_weights_that_are_none_are_refused_at_once(capsys, files, tmp_path, idle, weights, told):
    words = ["--example", files / "smile.obj", f"--weights={weights}"]
    assert told in refused(capsys, *fit(files, *words, "-o", tmp_path / "ann"))


def test_weights_for_some_examples_only_are_refused_at_once(capsys, files, tmp_path, idle):
    words = ["--example", files / "smile.obj", "--weights", "happy=1", "--example", files / "shout.obj"]
    line = refused(capsys, *fit(files, *words, "-o", tmp_path / "ann"))
    assert "for every example, or for none" in line
    assert "shout.obj has none" in line


@pytest.mark.parametrize(
    "words",
    [
        ["--weights", "happy=1", "--example", "e.obj"],
        ["--example", "e.obj", "--weights", "happy=1", "--weights", "sad=1"],
        ["--landmarks", "a.csv", "--landmarks", "b.csv"],
        ["--example", "e.obj", "--landmarks", "a.csv", "--landmarks", "b.csv"],
    ],
)
def test_options_of_no_example_or_given_twice_are_refused(capsys, files, tmp_path, words):
    assert "belongs to the --example before it, once" in refused(
        capsys, *fit(files, *words, "-o", tmp_path / "a")
    )


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--shapes", "grinn"], "no shape is called 'grinn'"),
        (["--shapes", ","], "--shapes takes names"),
        (["--iterations", "0"], "--iterations takes a whole number from 1 to 1000, not '0'"),
        (["--iterations", "-1"], "--iterations"),
        (["--iterations", "ten"], "'ten'"),
        (["--iterations", "1e9"], "'1e9'"),
        (["--iterations", "99999999999999999999"], "from 1 to 1000"),
        (["--held-out", "h.obj"], "--held-out says what --report measures"),
        (["--report", "r"], "give at least one with --example"),
        (["--nonsense"], "--nonsense"),
    ],
)
def test_options_that_mean_nothing_are_refused_at_once(capsys, files, tmp_path, idle, words, told):
    assert told in refused(capsys, *fit(files, *words, "-o", tmp_path / "ann"))


@pytest.mark.parametrize("verb", ["fit", "transfer", "register"])
def test_what_is_needed_is_asked_for(capsys, files, verb):
    assert "required" in refused(capsys, verb, files / "template")


def test_a_template_without_shapes_is_refused(capsys, files, tmp_path, idle):
    words = ["transfer", files / "neutral.obj", "--neutral", files / "neutral.obj", "-o", tmp_path / "ann"]
    assert "has no shapes; a face folder is wanted" in refused(capsys, *words)


def test_a_template_that_is_not_there_is_refused(capsys, files, tmp_path, idle):
    line = refused(capsys, "transfer", "adda", "--neutral", files / "neutral.obj", "-o", tmp_path / "ann")
    assert "'adda'" in line


def test_a_template_with_degenerate_triangles_is_refused_at_once(capsys, files, tmp_path, idle):
    points = TEMPLATE.neutral.positions.copy()
    points[TEMPLATE.neutral.corner_vertices[:4]] = points[0]
    write_face(replace(TEMPLATE, neutral=TEMPLATE.neutral.with_positions(points)), tmp_path / "flat")
    line = refused(
        capsys, "transfer", tmp_path / "flat", "--neutral", files / "neutral.obj", "-o", tmp_path / "a"
    )
    assert "the template: " in line
    assert "degenerate" in line


def test_nothing_is_overwritten_and_that_is_told_at_once(capsys, files, tmp_path, idle):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("mine")
    (tmp_path / "file").write_text("mine")
    example = ["--example", files / "smile.obj"]
    assert "mine is not empty" in refused(capsys, *fit(files, "-o", tmp_path / "mine"))
    assert "file is a file" in refused(capsys, *fit(files, "-o", tmp_path / "file"))
    assert "file is no folder" in refused(capsys, *fit(files, "-o", tmp_path / "file" / "ann"))
    line = refused(capsys, *fit(files, *example, "--report", tmp_path / "mine", "-o", tmp_path / "ann"))
    assert "mine is not empty" in line
    for report in (tmp_path / "ann", tmp_path):
        (tmp_path / "ann").mkdir(exist_ok=True)
        assert refused(capsys, *fit(files, *example, "--report", report, "-o", tmp_path / "ann"))
    (tmp_path / "ann").rmdir()
    line = refused(
        capsys, *fit(files, *example, "--report", tmp_path / "new", "-o", tmp_path / "new" / "ann")
    )
    assert "a folder of its own" in line
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "mine"]


PAIRS = {
    "gone.csv": (None, "gone.csv does not exist"),
    "blank.csv": ("", "blank.csv is empty"),
    "head.csv": ("template,x,y,z\n", "head.csv holds no pairs"),
    "columns.csv": ("a,b\n1,2\n", "columns.csv:1: these columns cannot be read"),
    "vertex.csv": ("template,scan\n0,1\n420,2\n", "vertex.csv:3: `template` must be a vertex from 0 to 419"),
    "scan.csv": ("template,scan\n0,99999\n", "scan.csv:2: `scan` must be a vertex"),
    "name.csv": ("template,scan\nnosetip,5\n", "name.csv:2: the template has no landmark called 'nosetip'"),
    "place.csv": ("template,x,y,z\n0,1,nan,2\n", "place.csv:2: `y` must be a number, not 'nan'"),
}


@pytest.mark.parametrize("name", PAIRS)
def test_pairs_that_cannot_be_read_are_refused_with_their_line(capsys, files, tmp_path, idle, name):
    text, told = PAIRS[name]
    if text is not None:
        (tmp_path / name).write_text(text)
    marks = ["--landmarks", tmp_path / name]
    neutral = ["--neutral", files / "scan.obj", "-o", tmp_path / "ann"]
    for words in (
        ["register", files / "template", files / "scan.obj", *marks, "-o", tmp_path / "wrapped.obj"],
        ["transfer", files / "template", *neutral, *marks],
        ["fit", files / "template", *marks, *neutral],
        [*fit(files), "--example", files / "scan-smile.obj", *marks, "-o", tmp_path / "ann"],
    ):
        assert told in refused(capsys, *words)
    assert not (tmp_path / "ann").exists()
    assert not (tmp_path / "wrapped.obj").exists()


def test_too_few_pairs_or_pairs_off_the_surface_are_refused_and_nothing_is_written(capsys, files, tmp_path):
    (tmp_path / "few.csv").write_text("template,scan\n0,0\n100,100\n")
    (tmp_path / "off.csv").write_text("template,x,y,z\n0,1,2,3\n100,5,2,3\n200,1,9,3\n300,1,2,50\n")
    for name, told in (("few.csv", "at least 3 pairs"), ("off.csv", "")):
        words = ["register", files / "template", files / "scan.obj", "--landmarks", tmp_path / name]
        assert told in refused(capsys, *words, "-o", tmp_path / "wrapped.obj")
    assert not (tmp_path / "wrapped.obj").exists()


def test_register_refuses_other_suffixes_its_own_scan_and_places_that_are_none(capsys, files, tmp_path, idle):
    shutil.copy(files / "scan.obj", tmp_path / "scan.obj")
    words = ["register", files / "template", tmp_path / "scan.obj", "--landmarks", files / "pairs.csv", "-o"]
    assert "must end in .obj" in refused(capsys, *words, tmp_path / "wrapped.ply")
    assert "is the scan itself" in refused(capsys, *words, tmp_path / "scan.obj")
    assert "is no folder" in refused(capsys, *words, tmp_path / "scan.obj" / "wrapped.obj")
    (tmp_path / "folder.obj").mkdir()
    assert "is a folder" in refused(capsys, *words, tmp_path / "folder.obj")


def test_register_writes_neither_over_its_template_nor_beside_its_shapes(capsys, files, tmp_path, idle):
    shutil.copytree(files / "template", tmp_path / "template")
    mesh = shutil.copy(tmp_path / "template" / "neutral.obj", tmp_path / "alone.obj")
    before = {path: path.read_bytes() for path in (tmp_path / "template").iterdir()}
    words = [files / "scan.obj", "--landmarks", files / "pairs.csv", "-o"]
    assert "the template itself" in refused(capsys, "register", mesh, *words, mesh)
    for name in ("neutral.obj", "new.obj"):
        told = refused(capsys, "register", tmp_path / "template", *words, tmp_path / "template" / name)
        assert "in the template's folder" in told
    assert {path: path.read_bytes() for path in (tmp_path / "template").iterdir()} == before


@pytest.mark.parametrize(
    "when", ["reading", "factoring", "iteration 2", "writing happy", "alpha 1", "writing neutral"]
)
def test_an_interrupted_fit_leaves_nothing_and_a_clean_line(capsys, files, tmp_path, monkeypatch, when):
    def progress(part: float, doing: str) -> None:
        assert 0.0 <= part <= 1.0
        if when in doing:
            raise KeyboardInterrupt

    monkeypatch.setattr(fitting, "told_progress", lambda: contextlib.nullcontext(progress))
    words = ["--example", files / "smile.obj", "--iterations", 3, "--report", tmp_path / "r"]
    assert main([str(word) for word in fit(files, *words, "-o", tmp_path / "new" / "ann")]) == 130
    assert not list(tmp_path.iterdir())


def test_progress_of_a_whole_run_only_grows(capsys, files, tmp_path, monkeypatch):
    told: list[tuple[float, str]] = []
    monkeypatch.setattr(
        fitting,
        "told_progress",
        lambda: contextlib.nullcontext(lambda part, doing: told.append((part, doing))),
    )
    words = [
        "--landmarks",
        files / "pairs.csv",
        "--example",
        files / "scan-smile.obj",
        "--report",
        tmp_path / "r",
    ]
    run(capsys, "fit", files / "template", "--neutral", files / "scan.obj", *words, "-o", tmp_path / "ann")
    parts = [part for part, _ in told]
    assert parts == sorted(parts)
    assert parts[-1] == 1.0


class Terminal:
    """A standard error that is a terminal."""

    def __init__(self) -> None:
        self.text = ""

    def isatty(self) -> bool:
        return True

    def write(self, text: str) -> int:
        self.text += text
        return len(text)

    def flush(self) -> None:
        pass


def test_progress_keeps_to_one_line_of_the_terminal_and_clears_it_even_when_stopped(monkeypatch):
    terminal = Terminal()
    monkeypatch.setattr("sys.stderr", terminal)
    monkeypatch.setenv("COLUMNS", "40")

    def work() -> None:
        with told_progress() as progress:
            progress(0.25, "reading \x1b[2J" + "x" * 200)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        work()
    lines = terminal.text.split("\r\x1b[K")
    assert lines[0] == lines[-1] == ""
    assert lines[1].startswith(" 25% reading ")
    assert all(len(line) < 40 and "\x1b" not in line and "\n" not in line for line in lines)


def test_a_built_in_person_on_another_opens_like_any_face_and_keeps_its_skin(capsys, tmp_path):
    ben = facemorph.load("ben")
    write_obj(tmp_path / "ben.obj", ben.neutral)
    write_obj(tmp_path / "grin.obj", ben.posed({"happy": 0.8}))
    words = ["fit", "ada", "--neutral", tmp_path / "ben.obj", "--example", tmp_path / "grin.obj"]
    facts = json.loads(run(capsys, *words, "--iterations", 2, "--json", "-o", tmp_path / "person"))
    found, ada = load_rig(tmp_path / "person"), facemorph.load("ada")
    assert sorted(found.names) == sorted(ada.names)
    assert {material.texture.name for material in found.neutral.materials.values() if material.texture} == {
        material.texture.name for material in ben.neutral.materials.values() if material.texture
    }
    assert facts["examples"][0]["rms_percent"] < 0.1
    framed = replace(found, info=replace(found.info, frame=ben.info.frame))
    pictures = [facemorph.render(face, {"happy": 0.8}, size=(160, 160)).astype(int) for face in (framed, ben)]
    assert np.abs(pictures[0] - pictures[1]).mean() < 1.5


def test_help_says_how_a_table_of_pairs_looks(capsys):
    for verb in ("fit", "transfer", "register"):
        with pytest.raises(SystemExit):
            main([verb, "--help"])
        words = " ".join(capsys.readouterr().out.split())
        assert "template, which is a vertex of TEMPLATE counted from 0" in words
        assert '"ibug 30" for number 30, from 0, of the usual 68' in words
        assert "either scan, a vertex of the mesh counted from 0, or x, y and z" in words
