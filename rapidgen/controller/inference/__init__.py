"""Inference of a cell from undeclared names of a foreign program.

`names` determines types and missing routines, `robot` a robot model and its start, `peers` socket
messages, `answers` dialogs, signals and data that programs poll, and `cell` combines them. Only the
boot of a controller imports this package.
"""
