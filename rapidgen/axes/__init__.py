"""Axis values: units, joint map, limits, timing and kinematics.

Pure functions, no I/O.

Three languages for one posture, and the map between them:

- URDF joint values, rad and m (`chain`, planners, users' trajectories),
- controller axis values, rad and m (the wire, limits, everything inside),
- RAPID values, deg and mm in `robax` and `extax` (only at the edge of RAPID).

Import the module that you need: `mapping` and `limits` are light, `timing` needs numpy.
"""
