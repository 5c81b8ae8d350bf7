"""Servers of a controller: FTP, SFTP, RWS and a control socket.

FTP and SFTP serve its HOME. All listen on loopback by default.
"""

from rapidgen.servers.ftp import serve_ftp
from rapidgen.servers.service import Service
from rapidgen.servers.sftp import serve_sftp

__all__ = ["Service", "serve_ftp", "serve_sftp"]
