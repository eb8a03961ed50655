"""A template's topology wrapped on a raw scan, or on a head of another topology.

wrapped = register(template.neutral, scan, pairs)
wrapped.mesh, wrapped.quality.mean_percent, wrapped.quality.flipped
"""

from facemorph.core.landmark_pair import LandmarkPair
from facemorph.fit.registration.following import followed
from facemorph.fit.registration.pairs import shared_landmarks
from facemorph.fit.registration.partners import Partners
from facemorph.fit.registration.quality import Quality
from facemorph.fit.registration.register import Registered, register

__all__ = ["LandmarkPair", "Partners", "Quality", "Registered", "followed", "register", "shared_landmarks"]
