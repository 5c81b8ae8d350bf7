"""View of a real robot: its states, without any control."""
