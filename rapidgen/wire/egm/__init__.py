"""Externally guided motion as data: protobuf messages over UDP, no I/O.

Field numbers and types are those of ABB's egm.proto (package abb.egm, proto2).
"""
