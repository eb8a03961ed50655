"""`python -m facemorph` is the command line."""

from facemorph.cli import main

raise SystemExit(main())
