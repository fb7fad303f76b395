#!/usr/bin/env python3
"""Plants faults that a fixed seed has drawn, and sees whether the tests find them: see docs/developers/contributing.md, "Mutants"."""

import argparse

import campaign
import draw


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--areas", default=",".join(area.name for area in draw.AREAS), help="a list with commas (all of them)")
    parser.add_argument("--jobs", type=int, default=1, help="how many tests and compilers run at once (1)")
    parser.add_argument("--list", action="store_true", help="only say what is drawn")
    parser.add_argument("--report", action="store_true", help="only say what is known")
    parser.add_argument("--again", action="store_true", help="run those again that have survived: after tests were written")
    parser.add_argument("--golden", type=int, default=40, help="so many of the golden programs that differ with a mutant or reach it, the quickest (40; 0: all)")
    parser.add_argument("--longest", type=float, default=600, help="no tests that take longer than so many seconds (600): for a first look")
    parser.add_argument("--built", action="store_true", help="the mutated copy is there: do not look whether sources have changed")
    parser.add_argument("--file", default="", help="only mutants of files with this in their name")
    options = parser.parse_args()
    areas = [area for area in draw.AREAS if area.name in options.areas.split(",")]
    state = campaign.State()
    if options.list or options.report:
        numbered = campaign.of_areas(campaign.drawn(state, draw.AREAS), areas)
        if options.report:
            campaign.report(state, numbered)
        else:
            for number, mutant in numbered.items():
                print(f"{number:4} {mutant.area:12} {mutant.file}:{mutant.line}  {mutant.key}")
        return
    campaign.whole(state, areas, options)


main()
