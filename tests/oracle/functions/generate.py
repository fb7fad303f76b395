#!/usr/bin/env python3
"""Writes the tables of this folder: calls of standard functions and the values that they must have.

usage: generate.py

Nothing here asks Stride, nor do the files beside this one that it includes. Integers are Python's, reals are exact
fractions or mpmath (Debian's python3-mpmath) with enough digits, dates are those of `datetime`, texts are lists of
characters. A table has the columns

  call       the call, $1, $2 … for the arguments, $r for an output
  types      of the arguments, separated by blanks
  result     type of the result
  arguments  ST literals, separated by " | "
  expected   an integer in the type's units; a real exactly (0x1.8p+0, nan, inf) or with 40 digits; a text as JSON
"""
import sys

sys.dont_write_bytecode = True
from characters import characters
from conversions import conversions, conversions_to
from dates import dates
from libraries import memory, motion, system_strings
from mathematics import mathematics
from numeric import bits, numeric, patterns
from selection import logic, measures, powers, selection, wide_strings
from strings import strings
from tables import Table
from texts import texts


def more(name, *functions):
    table = Table(name)
    for function in functions:
        function(table)
    table.write()


if __name__ == "__main__":
    for function in (mathematics, numeric, bits, conversions, texts, strings, dates):
        function()
    more("characters", characters)
    more("selection", selection, logic, powers, measures, wide_strings)
    more("libraries", memory, system_strings, motion)
    edition3 = Table("edition3")
    patterns(edition3)
    edition3.rows = Table.edition3
    edition3.write()
    more("conversions_to", conversions_to)
