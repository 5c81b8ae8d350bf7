"""Modules for controllers without rapidgen: description, writer, sources, reader."""
