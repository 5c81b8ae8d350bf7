! rule: arguments of CheckProgRef
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        CheckProgRef;
        CheckProgRef 1;  ! -> RG311
        CheckProgRef \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
