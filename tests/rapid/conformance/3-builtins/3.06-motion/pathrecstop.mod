! rule: arguments of PathRecStop
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        PathRecStop;
        PathRecStop \Clear;
        PathRecStop 1;  ! -> RG311
        PathRecStop \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
