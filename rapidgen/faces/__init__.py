"""Who talks to a controller from outside: FTP and SFTP of its HOME, a control socket; loopback."""

from rapidgen.faces.ftp import serve_ftp
from rapidgen.faces.service import Service
from rapidgen.faces.sftp import serve_sftp

__all__ = ["Service", "serve_ftp", "serve_sftp"]
