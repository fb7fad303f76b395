"""One module per scenario; each has `play(round)`, which makes its choices with round.rng."""
