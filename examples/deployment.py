"""Plan, deploy, change, roll back: into a folder that plays the controller's disk.

With a robot, TO is sftp://, ftp:// or rws://, and everything else is the same.
"""

import subprocess
import sys
import tempfile

TO = sys.argv[1] if sys.argv[1:] else f"dir://{tempfile.mkdtemp()}"


def rapidgen(*text: str) -> None:
    print("$ rapidgen", *text, flush=True)
    done = subprocess.run([sys.executable, "-m", "rapidgen.cli", *text], check=False)
    # 2 of `plan --detailed-exitcode`: there is something to do.
    if done.returncode not in ((0, 2) if text[0] == "plan" else (0,)):
        sys.exit(done.returncode)


rapidgen("plan", "irb120", "--to", TO, "--detailed-exitcode")
rapidgen("deploy", "irb120", "--to", TO, "--yes")
rapidgen("deploy", "irb120", "--to", TO, "--set", "trajectory.capacity=500", "--yes")
rapidgen("rollback", "irb120", "--to", TO, "--yes")
