! rule: arguments of EGMActMove
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident v_egmident;
    VAR pose v_pose;
    PROC main()
        EGMActMove v_egmident, v_pose;
        EGMActMove v_egmident, v_pose \SampleRate:=1;
        EGMActMove v_egmident;  ! -> RG311
        EGMActMove v_egmident, v_pose \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
