"""Arguments and options that several verbs have, declared once; each verb says its default."""

from pathlib import Path
from typing import Annotated

import typer

Config = Annotated[str, typer.Argument(help="Configuration file or shipped name.")]
ConfigOrFolder = Annotated[
    str, typer.Argument(help="Configuration file, shipped name or generated folder.")
]
ConfigOrHost = Annotated[
    str, typer.Argument(help="Configuration file, shipped name, HOST[:M,S,C], or `sim`.")
]
Overrides = Annotated[
    list[str] | None,
    typer.Option("--set", help="Override one key of the configuration.", metavar="KEY=VALUE"),
]
Backup = Annotated[
    Path | None,
    typer.Option(help="Backup of the controller that a generated folder is for.", metavar="FOLDER"),
]
VeryBackup = Annotated[
    Path | None,
    typer.Option(
        help="Backup of the very controller: what it has is used, what it lacks is written.",
        metavar="FOLDER",
    ),
]
Yes = Annotated[
    bool, typer.Option("--yes", "-y", help="Answer the question with yes; nothing more.")
]
LoadCheck = Annotated[
    bool,
    typer.Option(help="Refuse programs that a controller would not load."),
]

# Of the verbs that boot a virtual controller.
Tasks = Annotated[
    list[str] | None,
    typer.Option("--task", metavar="NAME=FILE,FILE", help="A task of its own with these modules."),
]
Coverage = Annotated[
    list[Path] | None,
    typer.Option(
        "--coverage",
        metavar="F.lcov|F.html",
        help="Lines and branches, or the source with hits; may be repeated.",
    ),
]
Plot = Annotated[
    list[Path] | None,
    typer.Option(
        "--plot", metavar="F", help="What the robots did: .html, .png, .svg; may be repeated."
    ),
]
Entry = Annotated[str, typer.Option("--entry", help="Procedure that tasks start in, not main.")]
Release = Annotated[
    str,
    typer.Option(
        "--robotware", metavar="V", help="Release of a controller of which no file tells it: 7.6."
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
        help="What stands around the controller; `infer`: whatever the programs name.",
    ),
]
Start = Annotated[
    str,
    typer.Option("--start", metavar="J1,J2,...", help="Where the robot stands at first: deg, mm."),
]

# Of the verbs that reach a controller's files.
Controllers = Annotated[
    list[str],
    typer.Option(
        help="Controller: dir://, ftp://, sftp:// [USER@]HOST/HOME-FOLDER, rws://HOST; or @FILE.",
        metavar="URL",
    ),
]
User = Annotated[str, typer.Option(help="User name where the URL has none.")]
Secrets = Annotated[
    Path | None, typer.Option(help="TOML file (mode 600) with passwords.", metavar="FILE")
]
Identity = Annotated[str, typer.Option(help="SSH key for sftp://.", metavar="FILE")]
KnownHosts = Annotated[
    str, typer.Option(help="Host keys for sftp://; default ~/.ssh.", metavar="FILE")
]
Parallel = Annotated[int, typer.Option(min=1, max=64, help="Controllers at a time.")]
LoadedCfg = Annotated[
    Path | None,
    typer.Option(
        help="A backup of this controller: says what is loaded, where that is not seen.",
        metavar="FOLDER",
    ),
]
Overwrite = Annotated[
    bool, typer.Option("--overwrite", help="Replace hand edits and strangers' files.")
]

Restart = Annotated[
    bool, typer.Option("--restart", help="Restart the controller (warm) where that is needed.")
]
WaitForPeople = Annotated[
    float,
    typer.Option("--wait", help="Seconds for automatic mode, a stop, a mastership.", metavar="S"),
]

# Of the verbs that talk to a controller's Robot Web Services.
WebServices = Annotated[
    str,
    typer.Argument(help="Controller: HOST[:PORT], rws:// or rwss:// before it.", metavar="HOST"),
]
Fingerprint = Annotated[
    str, typer.Option(help="SHA-256 of the controller's certificate.", metavar="HEX")
]

# Of the verbs that talk to a driver.
RobotAddress = Annotated[
    str,
    typer.Option(
        help="Where the robot is: an address, or `sim`, the simulator that runs; default this "
        "machine.",
        metavar="HOST[:M,S,C]|sim",
    ),
]
Group = Annotated[str, typer.Option(help="Motion group, where there are several.")]
InRad = Annotated[bool, typer.Option("--rad", help="Figures in rad and m, not in deg and mm.")]
YesHere = Annotated[
    bool, typer.Option("--yes", "-y", help="Do not ask; answers on this machine only.")
]
RealRobot = Annotated[
    str,
    typer.Option(
        "--move-real-robot", help="The host once more: its area is clear.", metavar="HOST"
    ),
]
AsJson = Annotated[
    bool, typer.Option("--json", help="JSON on stdout, errors too; joints are rad and m.")
]
