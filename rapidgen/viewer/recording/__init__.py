"""Recordings: MCAP files of a virtual controller's complete state."""
