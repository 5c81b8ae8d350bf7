"""RAPID and its clients in tests: pytest plugin, asyncio on the virtual clock."""
