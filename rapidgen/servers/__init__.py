"""Who talks to a controller from outside: FTP and SFTP of its HOME, a control socket; loopback."""

from rapidgen.servers.ftp import serve_ftp
from rapidgen.servers.service import Service
from rapidgen.servers.sftp import serve_sftp

__all__ = ["Service", "serve_ftp", "serve_sftp"]
