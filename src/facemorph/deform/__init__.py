"""Deformers: each a map from what the user moves to coefficients over a rig's shapes, or to offsets."""
