"""A run that was recorded, once more in virtual time."""
import invariants


def replays(round_, app, run, recording, printed, traced=None):
    """The replay ends as the run did, and prints the same values; with `traced`, the columns and file of the run's trace, it has
    the same rows at the same times."""
    again = round_.folder / "replay.csv"
    trace = ["--trace", ",".join(traced[0]), "--out", again] if traced else []
    replay = round_.host("sim", app, "--replay", recording, "--quiet", "--print", printed, *trace)
    round_.expect(replay.code == run.code, f"the replay of a run with exit code {run.code} ends with {replay.code}: {replay.err[-800:]}")
    wrong = [(a, b) for a, b in zip(replay.out.splitlines(), run.out.splitlines()) if a != b]
    round_.expect(replay.out == run.out, f"the replay prints other values than the run: {wrong[:5]}")
    round_.counts["replays"] += 1
    if not traced or "lacks" in run.err:  # rows that could not be written as fast as they came
        return
    rows, expected = invariants.read_trace(again)[1], invariants.read_trace(traced[1])[1]
    first = next(((a, b) for a, b in zip(rows, expected) if a != b), None)
    round_.expect(rows == expected, f"the replay's trace has {len(rows)} rows, the run's {len(expected)}; the first that differs: {first}")
