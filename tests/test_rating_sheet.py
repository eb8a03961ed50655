"""The rating study's tool: what is asked for is shown once, its order is the seed's, and scores are right."""

from __future__ import annotations

import csv
import json
import sys
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facemorph.errors import OptionError
from facemorph.io import write_obj

TOOLS = Path(__file__).parent.parent / "tools"
sys.path.insert(0, str(TOOLS))

import rating_scores  # noqa: E402
import rating_sheet  # noqa: E402

FACES, EMOTIONS, VIEWS = ["a", "b"], ["happy", "sad", "afraid"], ["front", "left"]


def study(seed: int, emotions: list[str] = EMOTIONS) -> list[rating_scores.Tile]:
    return rating_sheet.tiles_of(FACES, emotions, [1.0, 0.5], VIEWS, 5, seed)


def test_every_combination_is_shown_once_and_numbered_through() -> None:
    tiles = study(3)
    assert [tile.number for tile in tiles] == list(range(1, 25))
    assert [tile.page for tile in tiles] == [1 + k // 5 for k in range(24)]
    shown = [(tile.face, tile.emotion, tile.intensity, tile.view) for tile in tiles]
    assert sorted(shown) == sorted(product(FACES, EMOTIONS, [1.0, 0.5], VIEWS))


def test_the_seed_alone_makes_the_order() -> None:
    assert study(3) == study(3)
    orders = {tuple((tile.face, tile.emotion, tile.view) for tile in study(seed)) for seed in range(8)}
    assert len(orders) == 8


def test_neutral_has_no_intensities() -> None:
    neutral = [tile for tile in study(1, ["neutral", "happy"]) if tile.emotion == "neutral"]
    assert [tile.intensity for tile in neutral] == [0.0] * 4


def test_too_many_pictures_are_refused() -> None:
    with pytest.raises(OptionError, match="make 4000"):
        rating_sheet.tiles_of(["a"] * 1, ["happy"], [0.5] * 4000, ["front"], 20, 1)


@pytest.mark.parametrize("word", ["0", "1.1", "-0.5", "half", "nan"])
def test_intensities_are_shares(word: str) -> None:
    with pytest.raises(OptionError, match="above 0"):
        rating_sheet._intensity(word)


def key_at(folder: Path, tiles: list[rating_scores.Tile]) -> Path:
    rows = [(t.number, t.page, t.face, t.emotion, f"{t.intensity:g}", t.view) for t in tiles]
    path = folder / "key.csv"
    path.write_text(rating_sheet._table([rating_scores.KEY_COLUMNS, *rows]))
    return path


def test_a_key_comes_back_as_it_was_written(tmp_path: Path) -> None:
    assert rating_scores.read_key(key_at(tmp_path, study(4))) == study(4)


def test_words_of_any_case_and_noun_are_understood(tmp_path: Path) -> None:
    path = tmp_path / "answers.csv"
    path.write_text("number,label\n1,Happy\n2, SADNESS\n\n3,fear\n4,\n")
    answers = rating_scores.read_answers(path, study(1))
    assert answers == {1: "happy", 2: "sad", 3: "afraid"}


def test_neutral_may_be_answered_where_none_is_shown(tmp_path: Path) -> None:
    path = tmp_path / "answers.csv"
    path.write_text("number,label\n1,neutral\n2,happy\n")
    answers = rating_scores.read_answers(path, study(1))
    assert answers == {1: "neutral", 2: "happy"}
    lines = rating_scores.report(rating_scores.rated(study(1), answers))
    table = next(line for line in lines if line.startswith("shown / named"))
    assert table.split()[3:] == [*dict.fromkeys(t.emotion for t in study(1)), "neutral", "-"]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("1,happy\n1,sad\n", "answered before"),
        ("99,happy\n", "number of the key"),
        ("1,bored\n", "afraid, happy, neutral, sad"),
        ("number,label\nfirst,happy\n", "number,label"),
        ("1\n", "number,label"),
    ],
)
def test_answers_that_cannot_be_counted_are_told_with_their_line(
    tmp_path: Path, text: str, told: str
) -> None:
    path = tmp_path / "answers.csv"
    path.write_text(text)
    with pytest.raises(OptionError, match=told) as error:
        rating_scores.read_answers(path, study(1))
    assert f"{path}:" in str(error.value)


@pytest.mark.parametrize("text", ["", "a,b\n1,2\n", "number,page,face,emotion,intensity,view\nx,1,a,b,1,c\n"])
def test_what_is_no_key_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "key.csv"
    path.write_text(text)
    with pytest.raises(OptionError, match="key"):
        rating_scores.read_key(path)


def test_shares_and_confusions_are_counted() -> None:
    tiles = study(2)
    # Whoever is afraid at half intensity is called sad; one happy face gets no answer.
    answers = {t.number: "sad" if t.emotion == "afraid" and t.intensity == 0.5 else t.emotion for t in tiles}
    answers.pop(next(t.number for t in tiles if t.emotion == "happy" and t.intensity == 1.0))
    lines = rating_scores.report(rating_scores.rated(tiles, answers))
    share = {line.split("  ")[0]: line.split()[-5:-3] for line in lines if "/" in line and "%" in line}
    assert share["all"] == ["19/24", "79%"]
    assert share["intensity 1"] == ["11/12", "92%"]
    assert share["intensity 0.5"] == ["8/12", "67%"]
    table = {line.split()[0]: line.split()[1:] for line in lines[-3:]}
    columns = lines[-4].split()[3:]
    count = {shown: dict(zip(columns, map(int, row), strict=True)) for shown, row in table.items()}
    assert count["afraid"] == {**dict.fromkeys(columns, 0), "sad": 4, "afraid": 4}
    assert count["happy"] == {**dict.fromkeys(columns, 0), "happy": 7, "-": 1}
    assert count["sad"]["sad"] == 8


@pytest.mark.parametrize(("right", "of", "low", "high"), [(8, 10, 0.4902, 0.9433), (0, 10, 0.0, 0.2775)])
def test_the_interval_is_wilsons(right: int, of: int, low: float, high: float) -> None:
    assert rating_scores.interval(right, of) == pytest.approx((low, high), abs=1e-3)


def test_a_study_is_written_and_scored(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    from facemorph.errors import GraphicsError
    from facemorph.gl import create_context
    from tests.gl.heads import head_rig

    try:
        create_context().release()
    except GraphicsError as error:
        pytest.skip(str(error))
    rig = head_rig(rows=12, columns=16)
    face = tmp_path / "face"
    face.mkdir()
    write_obj(face / "neutral.obj", rig.neutral)
    for name in ("smile", "jaw"):
        write_obj(face / f"{name}.obj", rig.posed({name: 1.0}))
    monkeypatch.setattr(rating_sheet, "TILE", (60, 64))
    out = tmp_path / "study"
    wanted = ["make", "--out", str(out), "--faces", str(face), "--emotions", "smile,jaw", "--per-page", "5"]
    wanted += ["--intensities", "1,0.5", "--seed", "9"]
    assert rating_sheet.main(wanted) == 0
    told = capsys.readouterr().out
    for name in ("page-01.png", "page-02.png", "answers.csv", "key.csv", "study.json"):
        assert (out / name).is_file()
        assert str(out / name) in told
    with Image.open(out / "page-01.png") as page:
        pixels = np.asarray(page.convert("RGB")).astype(int)
    assert pixels.shape == (2 * (64 + rating_sheet.STRIP), 3 * 60, 3)
    assert len(np.unique(pixels[:64, :60].reshape(-1, 3), axis=0)) > 50, "a face"
    assert (pixels[-20:, 120:] == rating_sheet.PAPER).all(), "no sixth picture"
    assert json.loads((out / "study.json").read_text())["seed"] == 9
    key = rating_scores.read_key(out / "key.csv")
    with (out / "answers.csv").open() as file:
        assert [row[0] for row in csv.reader(file)][1:] == [str(tile.number) for tile in key]
    filled = tmp_path / "filled.csv"
    filled.write_text("".join(f"{tile.number},{tile.emotion}\n" for tile in key))
    assert rating_sheet.main(["score", str(out / "key.csv"), str(filled)]) == 0
    assert "8/8" in capsys.readouterr().out
    assert rating_sheet.main(wanted) == 2
    assert "is there already" in capsys.readouterr().err
