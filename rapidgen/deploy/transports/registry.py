"""Registry of transports.

A new one is a file in this folder and an entry in `SCHEMES`.
"""

import logging
from dataclasses import dataclass
from importlib import import_module

from rapidgen.deploy.secrets import Credentials
from rapidgen.deploy.transports.transport import Transport

_LOG = logging.getLogger("rapidgen.deploy")


@dataclass(frozen=True, slots=True)
class Scheme:
    """One transport.

    `opener` is `file:callable` of this folder, imported on use.
    """

    opener: str
    port: int = 0
    """Default TCP port; 0: a local folder, without host and login."""
    takes_keys: bool = False
    """True if an SSH key can replace a password."""


SCHEMES = {
    "dir": Scheme("folder:open_folder"),
    "ftp": Scheme("ftp:FtpTransport", 21),
    "rws": Scheme("rws:open_services", 443),
    "rwss": Scheme("rws:open_services", 443),
    "sftp": Scheme("sftp:SftpTransport", 22, takes_keys=True),
}


@dataclass(frozen=True, slots=True)
class Target:
    """A deployment target.

    `path` is absolute, or '' for the folder of the login.
    """

    scheme: str
    host: str
    port: int
    path: str
    user: str = ""

    @property
    def way(self) -> Scheme:
        """Return the transport of the scheme."""
        return SCHEMES[self.scheme]

    @property
    def shown(self) -> str:
        """The URL without the user, for plans and tables."""
        port = "" if self.port == self.way.port else f":{self.port}"
        host = f"[{self.host}]" if ":" in self.host else self.host
        return f"{self.scheme}://{host}{port}{self.path}"

    def open(self, login: Credentials, timeout: float) -> Transport:
        """Open a logged-in transport; s for each answer.

        Raises TransportFault RG501..RG506.
        """
        module, _, name = self.way.opener.partition(":")
        opened: Transport = getattr(import_module(f"{__package__}.{module}"), name)(
            self, login, timeout
        )
        _LOG.info("%s: logged in", self.shown)
        return opened
