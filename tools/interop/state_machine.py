"""Trial: ABB's StateMachine add-in, driven by abb_librws.

    python -m tools.interop.state_machine FOLDER (make interop PROGRAM=state_machine FOREIGN=FOLDER)

FOLDER has a checkout of abb_librws under that name, and the add-in's modules TRobMain, TRobRAPID,
TRobUtility and TRobEGM, of version 1.1. A copy may have another name for `main`, as that of
panin-anan/abb_SAMXL_Grinding_RAPID (main10). The module of the system, which each owner writes, is
written here. CMake and libpoco-dev are required.

With a checkout of abb_libegm, too, the add-in starts EGM, abb_libegm guides the robot, and the
add-in stops it; what that library needs is listed in `abb_libegm.py`.
"""

import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

from rapidgen.config import load_config
from rapidgen.controller.runner import ControllerRunner
from rapidgen.servers.egm import serve_egm
from rapidgen.servers.rws.server import serve_rws
from rapidgen.system import read_files
from rapidgen.system.model import SignalSpec
from rapidgen.wire.rws.bodies import Generation
from tools.interop import abb_libegm
from tools.interop.rws_suites import built, output_of

MODULES = ("TRobMain.mod", "TRobRAPID.mod", "TRobUtility.mod", "TRobEGM.mod")
SIGNALS = (
    "RUN_RAPID_ROUTINE",
    "EGM_START_JOINT",
    "EGM_START_POSE",
    "EGM_START_STREAM",
    "EGM_STOP",
    "EGM_STOP_STREAM",
)
SYSTEM = """MODULE TRobSystem
    PROC initializeSystemModule()
    ENDPROC
    FUNC bool attemptSystemRoutine(string name)
        IF name = "wave" THEN
            MoveAbsJ [[10,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
            RETURN TRUE;
        ENDIF
        RETURN FALSE;
    ENDFUNC
    FUNC bool attemptNonBlockingSystemRoutine(string name)
        RETURN FALSE;
    ENDFUNC
ENDMODULE
"""


def main(folder: Path) -> None:
    """Print each call of abb_librws and its result."""
    with tempfile.TemporaryDirectory() as scratch:
        own = Path(scratch) / "TRobSystem.mod"
        own.write_text(SYSTEM)
        main_module = (folder / MODULES[0]).read_text(encoding="latin-1")
        entry = "main10" if "PROC main10()" in main_module else "main"
        system = read_files([*(folder / name for name in MODULES), own], entry=entry)
        signals = tuple(SignalSpec(name, "DI", access="All") for name in SIGNALS)
        system = replace(system, robotware=(6, 13), signals=signals)
        groups = load_config("irb1200").groups
        program = built(folder / "abb_librws", "state_machine.cpp", scratch)
        with ControllerRunner(system, robots=groups, clock="real", autostart=True) as runner:
            runner.start()
            service = serve_rws(runner, Generation.ONE)
            for line in output_of(program, service.port):
                print(line, flush=True)
            service.close()
        if not (folder / "abb_libegm").is_dir():
            return
        program = with_egm(folder, Path(scratch))
        with ControllerRunner(system, robots=groups, clock="real", autostart=True) as runner:
            port = abb_libegm.free_port()
            # The add-in names device and external motion data as the robot.
            serve_egm(runner.controller, {"rob_1": ("127.0.0.1", port)})
            runner.start()
            service = serve_rws(runner, Generation.ONE)
            words = [program, "127.0.0.1", str(service.port), str(port)]
            ran = subprocess.run(words, capture_output=True, text=True, check=False)
            print(ran.stdout, end="", flush=True)
            service.close()


def with_egm(folder: Path, scratch: Path) -> Path:
    """Build the program that uses abb_librws, which is built, and abb_libegm."""
    library, program = scratch / "egm", scratch / "trial_egm"
    quiet = {"stdout": subprocess.DEVNULL, "check": True}
    subprocess.run(["cmake", "-S", folder / "abb_libegm", "-B", library], **quiet)
    subprocess.run(["cmake", "--build", library], **quiet)
    places = [scratch, library]
    where = [f"-I{folder}/abb_librws/include", f"-I{folder}/abb_libegm/include"]
    where += [word for p in places for word in (f"-I{p}", f"-L{p}", f"-Wl,-rpath,{p}")]
    names = ["abb_librws", "abb_libegm", "PocoNet", "PocoXML", "PocoUtil", "PocoFoundation"]
    names += ["boost_thread", "boost_system", "protobuf", "pthread"]
    source = Path(__file__).with_name("state_machine_egm.cpp")
    command = ["g++", "-std=c++14", "-o", program, source, *where, *(f"-l{n}" for n in names)]
    subprocess.run(command, check=True)
    return program


if __name__ == "__main__":
    main(Path(sys.argv[1]))
