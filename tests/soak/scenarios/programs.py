"""Random programs (tests/random) with new seeds, in one random mode per round, against the model in that folder."""
import argparse
import contextlib
import io
import sys


def play(round_):
    sys.path.insert(0, str(round_.settings.source / "tests" / "random"))
    import random_programs  # pylint: disable=import-outside-toplevel

    mode = round_.choose("mode", round_.rng.choice(list(random_programs.MODES)))
    # Every fifth seed ends with a run-time error; the tiny ones are these.
    seed = round_.choose("seed", 1000 + 5 * round_.rng.randrange(10**8) + (0 if round_.quick else round_.rng.randrange(5)))
    options = argparse.Namespace(stride=round_.settings.product.stride, keep=round_.folder, modes=[mode], small=round_.rng.random() < 0.3)
    said = io.StringIO()
    with contextlib.redirect_stdout(said), round_.surroundings():
        programs = random_programs.check(options, seed)
    round_.note(said.getvalue())
    round_.expect(programs is not None, f"random programs, seed {seed}, {mode}: {said.getvalue()[:1500]}")
    round_.counts["programs"] += programs or 0
