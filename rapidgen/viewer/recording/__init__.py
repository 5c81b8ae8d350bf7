"""Recordings: MCAP files of everything that a virtual controller did, and what was at a moment."""
