"""RAPID drivers for ABB robots.

Generates drivers, runs them on a virtual controller, deploys them and controls robots with them.
"""

__version__ = "0.1.0"
