"""The driver's own test suite, on the virtual controller."""
