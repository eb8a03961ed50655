"""facemorph: view, morph and export 3D facial expressions."""

__version__ = "0.1.0"
