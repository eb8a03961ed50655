"""What is fast, measured: facemorph beside its peers in one run. `make bench` prints it."""
