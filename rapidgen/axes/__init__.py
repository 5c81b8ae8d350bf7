"""Axis values: units, joint map, limits, timing and kinematics.

Pure functions, no I/O.

A posture has three forms, and the map between them:

- URDF joint values, rad and m (`chain`, planners, users' trajectories),
- controller axis values, rad and m (the wire, limits, everything inside),
- RAPID values, deg and mm in `robax` and `extax` (only in RAPID code).

Import the module that you need: `mapping` and `limits` load fast, `timing` needs numpy.
"""
