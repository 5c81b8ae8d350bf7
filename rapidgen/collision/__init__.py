"""Collision checks: shapes of robots and cells, proofs between samples, clearance."""
