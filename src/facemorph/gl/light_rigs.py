"""The rigs of lights to choose from. A new one is a name in `core.picture.LightRig` and a line here."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from facemorph.core.picture import LightRig, checked_light
from facemorph.gl.lights import Lights

# A large key from the upper left, enough fill that the shadow side stays skin, a faint rim from behind.
STUDIO = Lights(
    key=(1.46, 1.38, 1.29),
    key_from=(-36.0, 32.0),
    fill=(0.38, 0.39, 0.42),
    fill_from=(46.0, 4.0),
    catch_from=(-27.0, 15.0),
    rim=(1.25, 1.28, 1.36),
    rim_from=(152.0, 35.0),
    sky=(0.27, 0.28, 0.30),
    floor=(0.18, 0.155, 0.145),
    key_softness=0.25,
)
# Daylight through a tall window beside the face; the room gives the other side a little of it back.
WINDOW = Lights(
    key=(1.72, 1.76, 1.84),
    key_from=(-74.0, 16.0),
    fill=(0.20, 0.185, 0.17),
    fill_from=(62.0, 0.0),
    catch_from=(-38.0, 10.0),
    rim=(0.35, 0.37, 0.40),
    rim_from=(-128.0, 20.0),
    sky=(0.19, 0.20, 0.215),
    floor=(0.12, 0.11, 0.10),
    key_softness=0.45,
)
# Wide and from the front, so that nothing shines and a turned head is as bright as a straight one; a little
# more from above, so that brows, nose and chin keep their form. Nothing comes from one side.
FLAT = Lights(
    key=(0.70, 0.70, 0.70),
    key_from=(0.0, 24.0),
    fill=(0.0, 0.0, 0.0),
    fill_from=(0.0, 0.0),
    catch_from=(0.0, 14.0),
    rim=(0.0, 0.0, 0.0),
    rim_from=(180.0, 0.0),
    sky=(0.74, 0.74, 0.74),
    floor=(0.44, 0.44, 0.44),
    key_softness=0.8,
    backdrop=0.0,
    lag_deg=0.0,
)

RIGS: Mapping[LightRig, Lights] = MappingProxyType({"studio": STUDIO, "window": WINDOW, "flat": FLAT})


def lights_of(name: str) -> Lights:
    """The rig of that name. Raises `UnknownNameError`."""
    return RIGS[checked_light(name)]
