"""Trial: ABB's StateMachine add-in, driven by abb_librws.

    python -m tools.interop.state_machine FOLDER (make interop PROGRAM=state_machine FOREIGN=FOLDER)

FOLDER has a checkout of abb_librws under that name, and the add-in's modules TRobMain, TRobRAPID,
TRobUtility and TRobEGM, of version 1.1. A copy may have another name for `main`, as that of
panin-anan/abb_SAMXL_Grinding_RAPID (main10). The module of the system, which each owner writes, is
written here. CMake and libpoco-dev are required.
"""

import sys
import tempfile
from dataclasses import replace
from pathlib import Path

from rapidgen.config import load_config
from rapidgen.controller.runner import ControllerRunner
from rapidgen.servers.rws.server import serve_rws
from rapidgen.system import read_files
from rapidgen.system.model import SignalSpec
from rapidgen.wire.rws.bodies import Generation
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
        with ControllerRunner(system, robots=groups, clock="real", autostart=True) as runner:
            runner.start()
            service = serve_rws(runner, Generation.ONE)
            program = built(folder / "abb_librws", "state_machine.cpp", scratch)
            for line in output_of(program, service.port):
                print(line, flush=True)
            service.close()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
