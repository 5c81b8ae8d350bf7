"""Robot Web Services of a virtual controller."""
