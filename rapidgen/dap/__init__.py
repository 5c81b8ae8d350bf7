"""Debug adapter: RAPID on the virtual controller, for editors that speak DAP."""
