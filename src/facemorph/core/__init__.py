"""The nouns and the reference formulas: numpy only, no files, no drawing."""
