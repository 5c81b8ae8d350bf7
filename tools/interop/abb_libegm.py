"""Trial: robots of `rapidgen sim` that abb_libegm guides.

    python -m tools.interop.abb_libegm FOLDER (make interop PROGRAM=abb_libegm FOREIGN=FOLDER)

FOLDER has a checkout of ros-industrial/abb_libegm under that name, which is built as it is. It
guides joints and poses cycle by cycle (EGMControllerInterface) and follows a trajectory
(EGMTrajectoryInterface). Debian: cmake, g++, protobuf-compiler, libprotobuf-dev, libboost-dev,
libboost-regex-dev, libboost-system-dev and libboost-thread-dev.
"""

import socket
import subprocess
import sys
import tempfile
from pathlib import Path

JOINT = r"""MODULE guided
VAR egmident id;
PROC main()
MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
EGMGetId id;
EGMSetupUC ROB_1, id, "default", "PC" \Joint \CommTimeout:=60;
EGMActJoint id \Tool:=tool0 \LpFilter:=20 \MaxPosDeviation:=30 \MaxSpeedDeviation:=60;
EGMRunJoint id, EGM_STOP_HOLD \J1 \J2 \J3 \J4 \J5 \J6 \CondTime:=600 \RampInTime:=0.05;
ENDPROC
ENDMODULE
"""
POSE = r"""MODULE guided
VAR egmident id;
CONST pose base := [[0,0,0],[1,0,0,0]];
PROC main()
MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
EGMGetId id;
EGMSetupUC ROB_1, id, "default", "PC" \Pose \CommTimeout:=60;
EGMActPose id \Tool:=tool0 \WObj:=wobj0, base, EGM_FRAME_BASE, base, EGM_FRAME_BASE
 \LpFilter:=20 \MaxPosDeviation:=30 \MaxSpeedDeviation:=60;
EGMRunPose id, EGM_STOP_HOLD \x \y \z \rx \ry \rz \CondTime:=600 \RampInTime:=0.05;
ENDPROC
ENDMODULE
"""
PROGRAMS = {"joint": JOINT, "pose": POSE, "trajectory": JOINT}


def built(folder: Path, scratch: Path) -> Path:
    """Build the library and the program of this folder that uses it."""
    quiet = {"stdout": subprocess.DEVNULL, "check": True}
    subprocess.run(["cmake", "-S", folder, "-B", scratch, "-DCMAKE_BUILD_TYPE=Release"], **quiet)
    subprocess.run(["cmake", "--build", scratch], **quiet)
    program = scratch / "trial"
    where = [f"-I{folder}/include", f"-I{scratch}", f"-L{scratch}", f"-Wl,-rpath,{scratch}"]
    libraries = ["-labb_libegm", "-lboost_thread", "-lboost_system", "-lprotobuf", "-lpthread"]
    source = Path(__file__).with_suffix(".cpp")
    command = ["g++", "-std=c++14", "-o", program, source, *where, *libraries]
    subprocess.run(command, check=True)
    return program


def free_port() -> int:
    """Return a UDP port that nothing uses."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def trial(program: Path, mode: str, scratch: Path) -> list[str]:
    """Return the lines of the program while it guides a robot of `rapidgen sim`."""
    path, port = scratch / "guided.mod", free_port()
    path.write_text(PROGRAMS[mode])
    words = ["sim", str(path), "--robot", "irb120", "--egm", f"PC=127.0.0.1:{port}"]
    client = subprocess.Popen([program, mode, str(port)], stdout=subprocess.PIPE, text=True)
    sim = subprocess.Popen(
        [sys.executable, "-m", "rapidgen.cli", *words],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        return client.communicate(timeout=120)[0].splitlines()
    finally:
        client.kill()
        sim.terminate()
        sim.wait()


def main(folder: Path) -> bool:
    """Print the results of all modes; return True if a step failed."""
    with tempfile.TemporaryDirectory() as name:
        scratch = Path(name)
        program = built(folder / "abb_libegm", scratch)
        failed = False
        for mode in PROGRAMS:
            print(f"{mode}:")
            for line in trial(program, mode, scratch):
                failed |= line.startswith("FAILED")
                print(f"  {line}", flush=True)
    return failed


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
