"""Arguments and options of several commands; each command declares the default."""

from pathlib import Path
from typing import Annotated

import typer

Config = Annotated[
    str, typer.Argument(help="Configuration file or shipped name.", metavar="CONFIG")
]
ConfigOrFolder = Annotated[
    str,
    typer.Argument(help="Configuration file, shipped name or generated folder.", metavar="CONFIG"),
]
ConfigOrHost = Annotated[
    str,
    typer.Argument(
        help="Configuration file, shipped name, HOST[:M,S,C], or `sim`.", metavar="CONFIG|HOST"
    ),
]
Overrides = Annotated[
    list[str] | None,
    typer.Option("--set", help="Override one key of the configuration.", metavar="KEY=VALUE"),
]
TargetBackup = Annotated[
    Path | None,
    typer.Option(help="Backup of the controller for a generated folder.", metavar="FOLDER"),
]
BuildBackup = Annotated[
    Path | None,
    typer.Option(help="Backup of the controller to build for.", metavar="FOLDER"),
]
Yes = Annotated[bool, typer.Option("--yes", "-y", help="Do not ask for confirmation.")]
LoadCheck = Annotated[
    bool,
    typer.Option(help="Reject programs that a controller would not load."),
]

# Of the commands that boot a virtual controller.
Tasks = Annotated[
    list[str] | None,
    typer.Option("--task", metavar="NAME=FILE,FILE", help="Separate task with these modules."),
]
Coverage = Annotated[
    list[Path] | None,
    typer.Option(
        "--coverage",
        metavar="FILE.lcov|FILE.html",
        help="Line and branch coverage, as LCOV or as HTML; repeatable.",
    ),
]
Plot = Annotated[
    list[Path] | None,
    typer.Option(
        "--plot", metavar="FILE", help="Plot of the robots' motion: .html, .png, .svg; repeatable."
    ),
]
Entry = Annotated[
    str,
    typer.Option("--entry", help="Entry procedure of the tasks, instead of main.", metavar="NAME"),
]
Release = Annotated[
    str,
    typer.Option(
        "--robotware", metavar="VERSION", help="RobotWare version, if no file states it: 7.6."
    ),
]
RobotModel = Annotated[
    str, typer.Option("--robot", metavar="NAME", help="Shipped robot or configuration.")
]
Cell = Annotated[
    str,
    typer.Option(
        "--cell",
        metavar="FILE|infer",
        help="Description of the cell; `infer`: from the names in the programs.",
    ),
]
Start = Annotated[
    str,
    typer.Option("--start", metavar="J1,J2,...", help="Initial joint values: deg, mm."),
]

# Of the commands that access the files of a controller.
Controllers = Annotated[
    list[str],
    typer.Option(
        help="Controller: dir://, ftp://, sftp:// [USER@]HOST/HOME-FOLDER, rws://HOST; or @FILE.",
        metavar="URL",
    ),
]
User = Annotated[str, typer.Option(help="User name, if the URL contains none.", metavar="NAME")]
Secrets = Annotated[
    Path | None, typer.Option(help="TOML file (mode 600) with passwords.", metavar="FILE")
]
Identity = Annotated[str, typer.Option(help="SSH key for sftp://.", metavar="FILE")]
KnownHosts = Annotated[
    str, typer.Option(help="Host keys for sftp://; default ~/.ssh.", metavar="FILE")
]
Parallel = Annotated[
    int, typer.Option(min=1, max=64, help="Number of controllers at a time.", metavar="N")
]
LoadedCfg = Annotated[
    Path | None,
    typer.Option(
        help="Backup of this controller; shows the loaded cfg where the URL does not.",
        metavar="FOLDER",
    ),
]
Overwrite = Annotated[
    bool,
    typer.Option("--overwrite", help="Replace files that were edited by hand or belong to others."),
]
Restart = Annotated[
    bool, typer.Option("--restart", help="Restart the controller (warm start) if necessary.")
]
OperatorWait = Annotated[
    float,
    typer.Option(
        "--wait",
        help="Waiting time for automatic mode, a program stop or mastership.",
        metavar="SECONDS",
    ),
]

# Of the commands that use a controller's Robot Web Services.
WebServices = Annotated[
    str,
    typer.Argument(
        help="Controller: HOST[:PORT], rws://HOST, rwss://HOST or `sim`; or use --to.",
        metavar="HOST",
    ),
]
ToController = Annotated[str, typer.Option("--to", help="The controller.", metavar="HOST|sim")]
Fingerprint = Annotated[
    str, typer.Option(help="SHA-256 of the controller's certificate.", metavar="HEX")
]

# Of the commands that connect to a driver.
RobotAddress = Annotated[
    str,
    typer.Option(
        help="Address of the robot, or `sim`: the running simulator; default 127.0.0.1.",
        metavar="HOST[:M,S,C]|sim",
    ),
]
Group = Annotated[str, typer.Option(help="Motion group, if the robot has several.", metavar="NAME")]
InRad = Annotated[bool, typer.Option("--rad", help="Values in rad and m, not in deg and mm.")]
YesOnLoopback = Annotated[
    bool, typer.Option("--yes", "-y", help="Do not ask for confirmation on this computer.")
]
RealRobot = Annotated[
    str,
    typer.Option(
        "--move-real-robot",
        help="The robot's host again, to confirm that its area is clear.",
        metavar="HOST",
    ),
]
Reconnect = Annotated[
    float,
    typer.Option(help="Time to retry a lost connection.", min=0, metavar="SECONDS"),
]
AsJson = Annotated[
    bool, typer.Option("--json", help="JSON on stdout, also for errors; joints in rad and m.")
]
