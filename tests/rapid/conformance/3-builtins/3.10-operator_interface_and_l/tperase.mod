! rule: arguments of TPErase
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        TPErase;
        TPErase 1;  ! -> RG311
        TPErase \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
