"""A real robot as it is viewed: its states, and nothing that moves it."""
