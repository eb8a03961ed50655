"""The report's numbers against plain formulas, and its pictures."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from facemorph.core.correctives import CORRECTIVE, Corrective, Hat
from facemorph.fit import example_based
from facemorph.fit.baselines import components_percent, copied, principal, shapes_percent
from facemorph.fit.problem import FitProblem
from facemorph.fit.report import FitReport, fit_report
from facemorph.fit.report_plots import PLOTS, save_plot
from facemorph.fit.transferring import Transfer
from tests.fit.faces import mixed, named, sheet_rig, styled

WEIGHTS = np.array([[1.0, 0.3, 0.0], [0.0, 0.8, 0.5], [0.4, 0.0, 0.9]])
HELD = np.array([[0.5, 0.5, 0.0], [0.2, 0.0, 1.0]])


@pytest.fixture(scope="module")
def case():
    rig = sheet_rig(3)
    neutral, offsets = styled(rig)
    return rig, neutral, mixed(neutral, offsets, WEIGHTS), mixed(neutral, offsets, HELD)


@pytest.fixture(scope="module")
def report(case) -> FitReport:
    rig, neutral, examples, held = case
    return fit_report(rig, neutral, examples, named(rig, WEIGHTS), held, repeats=2)


def test_the_fits_row_is_what_the_fit_reaches(case, report):
    rig, neutral, examples, _ = case
    result = example_based(rig, neutral, examples, named(rig, WEIGHTS))
    row = report.rows[0]
    assert row.method == "example-based fit"
    assert row.training == pytest.approx(result.history[-1].rms_percent, rel=1e-6)
    assert report.over_noise[0].value == 0.0
    assert report.over_noise[0].training == pytest.approx(row.training, rel=1e-9)


def test_the_fit_is_better_than_every_baseline_where_it_should_be(report):
    fit, plain, copies, parts = report.rows
    assert fit.training < 0.5 * plain.training and fit.training < 0.5 * copies.training
    assert fit.held_out < 0.7 * plain.held_out and fit.held_out < 0.7 * copies.held_out
    assert parts.training < 1e-6


def test_large_alphas_end_at_plain_transfer_and_small_ones_fit_the_examples(report):
    errors = [point.training for point in report.over_alpha]
    assert errors == sorted(errors)
    assert errors[0] < 0.1 * errors[-1]
    assert report.over_alpha[0].value == 0.01


def test_a_report_is_the_same_every_time_and_ready_for_json(case, report):
    rig, neutral, examples, held = case
    again = fit_report(rig, neutral, examples, named(rig, WEIGHTS), held, repeats=2)
    assert again.over_noise == report.over_noise and again.over_alpha == report.over_alpha
    told = json.loads(json.dumps(report.as_dict()))
    assert told["examples"] == list(examples) and told["held_out"] == list(held)
    assert len(told["rows"]) == 4


def test_without_held_out_expressions_there_are_no_such_errors(case):
    rig, neutral, examples, _ = case
    report = fit_report(rig, neutral, examples, alphas=(0.1,), noises=(0.0,), repeats=1, iterations=2)
    assert all(row.held_out is None for row in report.rows)
    assert all(point.held_out is None for point in (*report.over_alpha, *report.over_noise))
    for plot in PLOTS.values():
        plot(report)


def test_copied_deltas_are_the_templates():
    rig = sheet_rig(3)
    np.testing.assert_array_equal(copied(rig).transpose(0, 2, 1), rig.deltas)


def test_principal_components_make_the_examples_and_are_orthogonal():
    moves = np.random.default_rng(0).normal(size=(3, 3, 20))
    parts = principal(moves).reshape(3, -1)
    gram = parts @ parts.T
    np.testing.assert_allclose(gram, np.diag(np.diag(gram)), atol=1e-9)
    assert (np.diff(np.diag(gram)) <= 0.0).all()
    assert components_percent(principal(moves), moves, 1.0) < 1e-9
    assert components_percent(principal(moves[:2]), moves, 1.0) > 1.0
    twice = principal(np.concatenate([moves, moves]))
    assert len(twice) == 3


def test_an_error_is_the_plain_formula_and_the_best_weights_are_no_worse(case):
    rig, neutral, examples, _ = case
    problem = FitProblem(Transfer(rig, neutral), list(examples.values()), rig.names, hold_still=False)
    planes, moves = problem.way.planes, problem.moves
    left = moves - np.tensordot(WEIGHTS, planes, 1)
    size = problem.way.way.scale * np.linalg.norm(np.ptp(neutral, axis=0))
    expected = 100.0 * np.sqrt(np.mean(np.linalg.norm(left, axis=1) ** 2)) / size
    assert shapes_percent(problem, planes, moves, WEIGHTS) == pytest.approx(expected)
    best = shapes_percent(problem, planes, moves)
    assert components_percent(planes, moves, size) <= best <= expected


def test_correctives_are_on_in_every_method_they_belong_to():
    rig = sheet_rig(3)
    rule = Corrective("puff", hats=(Hat("smile"),))
    shapes = (*rig.shapes[:2], replace(rig.shapes[2], set=CORRECTIVE))
    rig = replace(rig, shapes=shapes, correctives=(rule,))
    faces = {"half": rig.positions({"smile": 0.5})}
    report = fit_report(
        rig,
        rig.neutral,
        faces,
        [{"smile": 0.5}],
        {"other": rig.positions({"smile": 0.7})},
        alphas=(),
        noises=(),
    )
    for row in report.rows[:3]:
        assert row.training < 1e-3 and row.held_out < 1e-3


@pytest.mark.parametrize("name", PLOTS)
def test_a_plot_is_a_picture_with_something_on_it_and_the_same_every_time(report, tmp_path, name):
    for file in ("a.png", "b.png"):
        save_plot(PLOTS[name](report), tmp_path / file)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    pixels = np.asarray(Image.open(tmp_path / "a.png").convert("RGB")).astype(int)
    assert pixels.shape[0] > 500 and pixels.shape[1] > 900
    for colour in ((0x1F, 0x6F, 0xB4), (0xD9, 0x82, 0x2B)):
        assert (np.abs(pixels - colour).sum(axis=2) < 12).sum() > 500
    assert (pixels.min(axis=2) > 250).mean() > 0.4
