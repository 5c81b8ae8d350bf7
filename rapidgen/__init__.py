"""RAPID drivers for ABB robots: generated, run on a virtual controller, deployed and driven."""

__version__ = "0.1.0"
