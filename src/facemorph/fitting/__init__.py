"""From files to a person's rig: read, wrap what has a topology of its own, fit, and say how it went.

The functions behind `facemorph fit`, `transfer` and `register`; `facemorph.fit` is the same without files.
"""

from facemorph.fitting.person import Person, fit_person, read_person, register_file, report_on
from facemorph.fitting.surfaces import ExampleFile

__all__ = ["ExampleFile", "Person", "fit_person", "read_person", "register_file", "report_on"]
