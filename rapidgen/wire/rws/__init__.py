"""Robot Web Services as data: operations, bodies, forms, codes, events.

No I/O.
"""
