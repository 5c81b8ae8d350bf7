"""View of a virtual controller: one provider a file."""
