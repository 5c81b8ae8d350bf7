"""A virtual controller as it is viewed: one aspect a file."""
