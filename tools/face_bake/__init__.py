"""Bake the six bundled faces from CC0 MakeHuman data; see README.md beside this file."""
