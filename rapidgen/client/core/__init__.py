"""Decisions of the client: bytes and times in, decisions out.

No I/O, no thread, no loop.
"""
