! rule: arguments of EraseModule
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        EraseModule "x";
        EraseModule;  ! -> RG311?
        EraseModule "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
