! rule: arguments of EGMRunPose
! source: [code] abb_motion_program_exec
MODULE Demo
    VAR egmident v_egmident;
    VAR pose v_pose;
    PROC main()
        EGMRunPose v_egmident, 1;
        EGMRunPose v_egmident, 1 \NoWaitCond \x \y \z \rx \ry \rz \CondTime:=1 \RampInTime:=1 \RampOutTime:=1 \Offset:=v_pose \PosCorrGain:=1;
        EGMRunPose v_egmident;  ! -> RG311
        EGMRunPose v_egmident, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
