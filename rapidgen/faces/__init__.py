"""FTP and SFTP faces of a virtual controller's HOME: loopback only, nothing outside the folder."""

from rapidgen.faces.ftp import serve_ftp
from rapidgen.faces.service import Service
from rapidgen.faces.sftp import serve_sftp

__all__ = ["Service", "serve_ftp", "serve_sftp"]
