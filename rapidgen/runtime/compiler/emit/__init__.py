"""Emission of Python source for RAPID routines.

`access` compiles references to data, `expressions` values and calls, `statements` statement lists.
`writer` collects the lines and accounts for costs, `routine` assembles the function.
"""
