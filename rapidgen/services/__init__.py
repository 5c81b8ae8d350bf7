"""FTP and SFTP faces of a virtual controller's HOME: loopback only, nothing outside the folder."""

from rapidgen.services.ftp import serve_ftp
from rapidgen.services.service import Service
from rapidgen.services.sftp import serve_sftp

__all__ = ["Service", "serve_ftp", "serve_sftp"]
