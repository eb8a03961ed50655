"""A fit tells where it is and can be stopped anywhere, leaving nothing behind."""

from __future__ import annotations

import numpy as np
import pytest
from threadpoolctl import threadpool_info, threadpool_limits

from facemorph.errors import JobCancelledError
from facemorph.fit import example_based, transfer
from facemorph.fit.report import fit_report
from facemorph.fit.threads import one_thread
from tests.fit.faces import mixed, named, sheet_rig, styled

WEIGHTS = np.array([[1.0, 0.3], [0.0, 0.8]])


@pytest.fixture(scope="module")
def work():
    rig = sheet_rig(2, 6, 7)
    neutral, offsets = styled(rig)
    examples, weights = mixed(neutral, offsets, WEIGHTS), named(rig, WEIGHTS)
    return rig, {
        "transfer": lambda progress: transfer(rig, neutral, progress=progress),
        "fit": lambda progress: example_based(
            rig, neutral, examples, weights, iterations=3, progress=progress
        ),
        "report": lambda progress: fit_report(
            rig, neutral, examples, weights, alphas=(0.1,), noises=(0.1,), repeats=2, iterations=2,
            progress=progress,
        ),
    }  # fmt: skip


@pytest.mark.parametrize("kind", ["transfer", "fit", "report"])
def test_progress_only_grows_from_0_to_1_and_says_what_is_done(work, kind):
    told = []
    work[1][kind](lambda share, doing: told.append((share, doing)))
    shares = [share for share, _ in told]
    assert len(told) >= 3
    assert shares == sorted(shares) and shares[0] >= 0.0 and shares[-1] <= 1.0
    assert all(doing and not doing.endswith(".") for _, doing in told)
    if kind != "transfer":
        assert shares[-1] == 1.0


@pytest.mark.parametrize("kind", ["transfer", "fit", "report"])
def test_it_stops_at_every_stage_and_leaves_nothing(work, kind):
    rig, kinds = work
    told = []
    kinds[kind](lambda share, doing: told.append(doing))
    before, threads = rig.deltas.copy(), _threads()
    for stop in range(len(told)):
        with pytest.raises(JobCancelledError):
            kinds[kind](_stopping_at(stop))
        assert _threads() == threads
    np.testing.assert_array_equal(rig.deltas, before)
    if kind != "report":
        after = kinds[kind](lambda share, doing: None)
        np.testing.assert_array_equal(after.rig.deltas, kinds[kind](lambda share, doing: None).rig.deltas)


def test_overlapping_fits_share_the_limit_and_the_last_lifts_it():
    with threadpool_limits(limits=2, user_api="blas"):
        before = _threads()
        first, second = one_thread(), one_thread()
        first.__enter__()
        second.__enter__()
        first.__exit__(None, None, None)
        blas = [pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"]
        assert set(blas) == {1}
        second.__exit__(None, None, None)
        assert _threads() == before


def _threads() -> list[int]:
    return [pool["num_threads"] for pool in threadpool_info()]


def _stopping_at(turn: int):
    left = iter(range(turn + 1))

    def progress(share: float, doing: str) -> None:
        if next(left) == turn:
            raise JobCancelledError("stopped")

    return progress


def test_inputs_are_not_written_to():
    rig = sheet_rig(2, 6, 7)
    neutral, offsets = styled(rig)
    examples = mixed(neutral, offsets, WEIGHTS)
    for array in (neutral, *examples.values()):
        array.flags.writeable = False
    result = example_based(rig, neutral, examples)
    assert set(result.seconds) == {"transfer", "fit"}
    assert all(seconds > 0.0 for seconds in result.seconds.values())
