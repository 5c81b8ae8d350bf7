"""A virtual controller that executes RAPID."""
