"""Rules in a face.toml become a rig's correctives; what is no rule is told with its place."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from facemorph.core.correctives import Corrective, Hat
from facemorph.errors import FaceFolderError
from facemorph.io import load_rig
from tests.io.texts import SQUARE, written

EXPRESSIONS = "".join(
    f'[[expressions]]\nname = "{name}"\nfile = "{name}.obj"\n' for name in ("smile", "jaw", "mend")
)


def face(folder: Path, rules: str) -> Path:
    """A square with three shapes and these rules."""
    written(folder, SQUARE, "neutral.obj")
    for k, name in enumerate(("smile", "jaw", "mend")):
        written(folder, SQUARE.replace("v 0 0 0", f"v 0 0 {k + 1}", 1), f"{name}.obj")
    written(folder, EXPRESSIONS + rules, "face.toml")
    return folder


def test_rules_of_both_kinds_are_read(tmp_path: Path) -> None:
    rules = (
        '[[correctives]]\nshape = "mend"\nproduct = ["smile", "jaw"]\n'
        '[[correctives]]\nshape = "mend"\nhat = "jaw"\n'
        '[[correctives]]\nshape = "mend"\nproduct = ["smile"]\nhat = "jaw"\nover = [0, 0.25, 2]\n'
    )
    rig = load_rig(face(tmp_path, rules))
    assert rig.correctives == (
        Corrective("mend", ("smile", "jaw")),
        Corrective("mend", hats=(Hat("jaw", 0.0, 0.5, 1.0),)),
        Corrective("mend", ("smile",), (Hat("jaw", 0.0, 0.25, 2.0),)),
    )
    lifted = rig.positions({"smile": 1.0, "jaw": 0.5})[0, 2]
    hat = 0.25 / 1.75
    assert lifted == pytest.approx(1.0 + 1.0 + 3.0 * (0.5 + 1.0 + (1 - (hat) ** 2)), abs=1e-5)
    assert np.isclose(rig.linear().positions({"smile": 1.0, "jaw": 0.5})[0, 2], 2.0)


@pytest.mark.parametrize(
    ("rule", "told"),
    [
        ('shape = "mend"', "follows no shape"),
        ('product = ["jaw"]', "shape is missing"),
        ('shape = "mend"\nproduct = ["grin"]', "'grin', which is no shape"),
        ('shape = "mend"\nproduct = "jaw"', "must be an array"),
        ('shape = "mend"\nproduct = [1]', "must be an array of texts"),
        (
            'shape = "mend"\nproduct = ["jaw", "jaw", "jaw", "jaw", "jaw", "jaw", "jaw", "jaw", "jaw"]',
            "at most",
        ),
        ('shape = "mend"\nhat = "jaw"\nover = [0, 1]', "needs three numbers"),
        ('shape = "mend"\nhat = "jaw"\nover = [0, inf, 1]', "must be an array of numbers"),
        ('shape = "mend"\nhat = "jaw"\nover = [1, 0.5, 0]', "must grow"),
    ],
)
def test_what_is_no_rule_is_refused_with_its_file(tmp_path: Path, rule: str, told: str) -> None:
    with pytest.raises(FaceFolderError, match=told) as caught:
        load_rig(face(tmp_path, f"[[correctives]]\n{rule}\n"))
    assert str(tmp_path) in str(caught.value)
