"""The command line of the scripts that try random projects, one for each seed."""
import argparse
import pathlib
import tempfile


def try_seeds(check, seeds, what, add_options):
    """The exit status. `check(options, seed)` gives how many of `what` agreed, None where one did not; `seeds` is the default
    of its option, and `add_options` adds the script's own to a parser."""
    parser = argparse.ArgumentParser()
    parser.add_argument("stride", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--seeds", default=seeds)
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path(tempfile.gettempdir()))
    add_options(parser)
    options = parser.parse_args()
    first, last = map(int, options.seeds.split(".."))
    results = [check(options, seed) for seed in range(first, last + 1)]
    print(f"{len(results) - results.count(None)} of {len(results)} projects agree, {sum(filter(None, results))} {what}")
    return 1 if None in results else 0


def agree_in_both_modes(options, name, cases, text, run):
    """How many cases agree with checks and, those that do not stop, without them; None where one does not. `text(cases)` gives the
    lines of a project, of which the files that fail are kept; `run(options, source, cases, arguments)` says whether it agrees."""
    good = True
    for arguments, chosen in (([], cases), (["--unchecked"], [case for case in cases if case.stop is None])):
        source = options.keep / f"{name}{'u' if arguments else ''}.st"
        source.write_text("\n".join(text(chosen)), encoding="utf-8")
        if run(options, source, chosen, arguments):
            source.unlink()
        else:
            good = False
    return len(cases) if good else None
