"""Transports to the files of a controller, selected by a URL's scheme.

`registry` lists them.
"""
