"""Curves to few moves: dense curves as MoveL and MoveC whose predicted path stays in a tolerance.

`curve` reads and resamples, `placement` chooses the rotation about the tool axis and the place,
`prediction` runs moves through the planner of the virtual controller, `fitting` chooses waypoints,
zones and speed, `module` writes the result as RAPID.
"""
