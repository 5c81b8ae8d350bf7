"""FTP server: pyftpdlib with the behaviour reported of an IRC5 controller.

pyftpdlib is the reference for FTP in Python (maintained since 2007, RFC 959 to 3659); it checks
every path against the resolved root, links included. Facts about ABB's own server are scarce
([mem]): a user name with a space, no MLSD, HOME as an ordinary folder; so MLSD and MLST are off by
default.
"""

import logging
import threading
from pathlib import Path

from rapidgen.servers.service import Service, in_use, loopback

_TICK = 0.2
"""s between two checks of the stop flag; requests are served at once."""


_NOT_A_CONTROLLERS = ("SITE CHMOD", "MFMT")
"""Commands for rights and times, which a controller's disk does not have."""


def serve_ftp(
    home: Path | str,
    host: str = "127.0.0.1",
    port: int = 0,
    user: str = "Default User",
    password: str = "",
    *,
    without: tuple[str, ...] = ("MLSD", "MLST", *_NOT_A_CONTROLLERS),
) -> Service:
    """Serve the folder `home` over FTP, read and write, in a thread.

    It supports passive and active mode. An empty `password` is replaced by a random one (see the
    handle). `without` names commands that this server rejects as unknown. Raises DiagnosticError
    RG560 (not loopback), RG561 (port).
    """
    import secrets
    import warnings

    with warnings.catch_warnings():
        # asyncore and asynchat, which pyftpdlib builds on, are deprecated in Python 3.11.
        warnings.simplefilter("ignore", DeprecationWarning)
        from pyftpdlib.authorizers import DummyAuthorizer
        from pyftpdlib.handlers import FTPHandler
        from pyftpdlib.ioloop import IOLoop
        from pyftpdlib.servers import FTPServer

    address = loopback(host)
    password = password or secrets.token_urlsafe(12)
    authorizer = DummyAuthorizer()
    authorizer.add_user(user, password, str(Path(home).resolve()), perm="elradfmw")
    commands = {k: v for k, v in FTPHandler.proto_cmds.items() if k not in without}
    handler = type(
        "Handler",
        (FTPHandler,),
        {
            "authorizer": authorizer,
            "proto_cmds": commands,
            "banner": "virtual controller ready.",
            "auth_failed_timeout": 0.5,
            "use_sendfile": False,
        },
    )
    # Without a handler pyftpdlib would set up the root logger and print to the user.
    logger = logging.getLogger("pyftpdlib")
    logger.addHandler(logging.NullHandler())
    logger.setLevel(logging.CRITICAL)
    loop = IOLoop()
    try:
        server = FTPServer((address, port), handler, ioloop=loop)
    except OSError as error:
        loop.close()
        raise in_use(address, port, error) from error
    stopping = threading.Event()

    def serve() -> None:
        while not stopping.is_set():
            loop.loop(timeout=_TICK, blocking=False)
        server.close_all()

    thread = threading.Thread(target=serve, name=f"ftp:{server.address[1]}", daemon=True)

    def stop() -> None:
        stopping.set()
        thread.join()

    thread.start()
    return Service(address, server.address[1], user, password, "", stop)
