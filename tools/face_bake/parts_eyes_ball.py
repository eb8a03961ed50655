"""Where a person's eyeballs are and where they look, for any shape; and lids kept outside of them."""

import numpy as np

from .source import Source

# MakeHuman's helper vertices of the left and the right eyeball.
EYE_VERTICES = (np.arange(14598, 14670), np.arange(14670, 14742))
# The helper is a little too large for its lids.
SCALE = 0.985
# Where the clear cornea begins, in degrees from the line of sight; at a radius of 14.7 mm that makes an
# iris of 11.7 mm, as people have. The cornea is a smaller sphere, in radii of the eye.
LIMBUS = 23.5
CORNEA = 0.645
# How far each look unit turns an eye at weight 1, degrees. MakeHuman's own turn half as far.
GAZE_DEGREES = {"In": 25.0, "Out": 25.0, "Up": 18.0, "Down": 22.0}
# Whom a neutral face looks at, in decimetres in front of the eyes: the default view's camera.
VIEWER_BELOW, VIEWER_AWAY = 0.33, 7.8
# Thickness in decimetres of what lies over the ball: tears, the lid on them, and both over the cornea.
FILM, LID, STRETCHED = 0.005, 0.014, 0.006


def cornea_height(degrees: np.ndarray) -> np.ndarray:
    """Distance of the surface from the eye's centre, in radii, so many degrees from the line of sight."""
    polar = np.radians(np.minimum(degrees, LIMBUS))
    edge = np.radians(LIMBUS)
    centre = np.cos(edge) - np.sqrt(CORNEA**2 - np.sin(edge) ** 2)
    return centre * np.cos(polar) + np.sqrt(CORNEA**2 - (centre * np.sin(polar)) ** 2)


def fit_sphere(points: np.ndarray) -> tuple[np.ndarray, float]:
    """Least-squares centre and radius."""
    system = np.c_[2 * points, np.ones(len(points))]
    solution = np.linalg.lstsq(system, (points**2).sum(1), rcond=None)[0]
    centre = solution[:3]
    return centre, float(np.sqrt(solution[3] + (centre**2).sum()))


def rotation_between(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Best rotation (3, 3) taking one cloud to the other (Kabsch)."""
    u, _, vt = np.linalg.svd((before - before.mean(0)).T @ (after - after.mean(0)))
    handed = np.sign(np.linalg.det(vt.T @ u.T))
    return vt.T @ np.diag([1, 1, handed]) @ u.T


def turned(yaw: float, pitch: float) -> np.ndarray:
    """Rotation (3, 3): `pitch` degrees up, then `yaw` degrees towards +X."""
    a, b = np.radians(yaw), np.radians(pitch)
    upward = np.array([[1, 0, 0], [0, np.cos(b), np.sin(b)], [0, -np.sin(b), np.cos(b)]])
    aside = np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])
    return aside @ upward


class LookUnits:
    """Finds in the helper's offsets how much of each look unit they hold: a linear question."""

    def __init__(self, source: Source):
        self._fields, self._solve = [], []
        for side, name in enumerate(("Left", "Right")):
            fields = [source.arkit(f"eyeLook{way}{name}")[EYE_VERTICES[side]] for way in GAZE_DEGREES]
            self._fields.append(np.stack(fields))
            self._solve.append(np.linalg.pinv(self._fields[side].reshape(len(fields), -1).T))

    def of(self, side: int, offsets: np.ndarray) -> tuple[dict[str, float], np.ndarray]:
        """Weights of the look units in the helper's offsets (72, 3), and what else moves it (3,)."""
        weights = self._solve[side] @ offsets.ravel()
        rest = offsets - np.tensordot(weights, self._fields[side], 1)
        return dict(zip(GAZE_DEGREES, weights.tolist(), strict=True)), rest.mean(0)


class Eyeballs:
    """Both eyeballs of a person: side 0 is the left, 1 the right. They keep their size and turn in place."""

    def __init__(self, units: LookUnits, neutral: np.ndarray):
        self._units, self._neutral = units, neutral
        self._rest = [fit_sphere(neutral[helper]) for helper in EYE_VERTICES]

    def radius(self, side: int) -> float:
        return self._rest[side][1] * SCALE

    def placed(self, side: int, shape: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Centre (3,) and rotation (3, 3) from an eye that looks along +Z, in a shape (19158, 3)."""
        helper, (centre, _) = EYE_VERTICES[side], self._rest[side]
        look, moved = self._units.of(side, shape[helper] - self._neutral[helper])
        outwards = 1 if side == 0 else -1
        yaw = outwards * (look["Out"] * GAZE_DEGREES["Out"] - look["In"] * GAZE_DEGREES["In"])
        pitch = look["Up"] * GAZE_DEGREES["Up"] - look["Down"] * GAZE_DEGREES["Down"]
        rest_yaw, rest_pitch = np.degrees(np.arctan2([-centre[0], -VIEWER_BELOW], VIEWER_AWAY))
        return centre + moved, turned(yaw + rest_yaw, pitch + rest_pitch)

    def points(self, side: int, unit: np.ndarray, shape: np.ndarray) -> np.ndarray:
        """Points (n, 3) of a unit eye along +Z, put where the eye is and looks."""
        centre, rotation = self.placed(side, shape)
        return centre + self.radius(side) * unit @ rotation.T

    def surface(self, side: int, points: np.ndarray, shape: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Distances (n,) of points from the centre, and of the ball's surface below them."""
        centre, rotation = self.placed(side, shape)
        ray = points - centre
        distance = np.maximum(np.linalg.norm(ray, axis=1), 1e-9)
        degrees = np.degrees(np.arccos(np.clip(ray @ rotation[:, 2] / distance, -1, 1)))
        return distance, self.radius(side) * cornea_height(degrees)

    def push_out(self, points: np.ndarray, rest: np.ndarray, on_head: np.ndarray | bool, shape) -> np.ndarray:
        """Keep skin (n, 3) outside the balls; `rest` is where it is in the neutral, `on_head` its outside.

        What lies within the ball at rest, the lids' inner side, goes no deeper; what lies outside stays
        there, the outside of the head by a lid's thickness, as far as it had that at rest.
        """
        points = points.copy()
        for side in (0, 1):
            rest_distance, rest_surface = self.surface(side, rest, self._neutral)
            thickness = np.where(on_head, FILM + LID, FILM)
            above = np.minimum(rest_distance - rest_surface, thickness)
            self._lift(side, points, shape, above)
            # Shapes are blended along straight lines, which half way cut into the ball.
            middle = (points + rest) / 2
            lifted = middle.copy()
            self._lift(side, lifted, (shape + self._neutral) / 2, np.where(above > 0, above, -np.inf))
            points += 2 * (lifted - middle)
        return points

    def _lift(self, side: int, points: np.ndarray, shape: np.ndarray, above: np.ndarray):
        """Move those points (n, 3) outwards, in place, that are not so far (n,) above the ball's surface."""
        distance, surface = self.surface(side, points, shape)
        # Over the cornea's bulge a lid is stretched thin, or it would bulge as much.
        limit = np.maximum(self.radius(side) + above, surface + np.minimum(above, STRETCHED))
        deep = distance < limit
        centre = self.placed(side, shape)[0]
        points[deep] = centre + (points[deep] - centre) * (limit / distance)[deep][:, None]
